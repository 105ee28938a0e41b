// Requests to bake a source and to preview it.
#pragma once

#include <filesystem>
#include <string>

#include "planet/bake/bake.h"
#include "planet/source/height_source.h"

namespace worldy {

// Names a source and the settings to bake it with.
struct BakeRequest {
    std::filesystem::path source;
    planet::HeightSourceSettings sourceSettings;
    planet::BakeSettings settings;
    std::filesystem::path colour{};  // image for the colour tiles; empty: no colours
    std::string launcher{};          // the command that starts the bake on several ranks; empty: it runs here
};

// Selects a square of a face of a source that is not baked yet.
struct PreviewRequest {
    std::filesystem::path source;
    planet::HeightSourceSettings sourceSettings;
    double radiusM = 6'371'000;
    planet::Face face = planet::Face::PosX;
    int zoomLog2 = 0;  // [0, 14]; 0: the whole face; each step halves the side of the square
    double u = 0;      // centre of the square, [-1, 1]; moved so that the square lies on the face
    double v = 0;
};

}  // namespace worldy
