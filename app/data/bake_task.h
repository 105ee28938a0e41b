// The task of a bake in the background (bake_job.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planet/bake/bake_settings.h"
#include "planet/source/height_source.h"

namespace worldy {

// The image for the colour tiles of a bake.
struct JobColour {
    std::filesystem::path image{};  // empty: no colours
    bool mayFail = false;           // true: if the image cannot be read, the bake continues without colours
};

// A coarse bake of a source, which is there long before the whole one.
struct FirstLook {
    planet::BakeSettings settings;
    std::filesystem::path output;
};

struct BakeTask {
    std::filesystem::path source;
    planet::HeightSourceSettings sourceSettings{};
    planet::BakeSettings settings{};
    std::filesystem::path output;
    JobColour colour{};
    // Baked first. It is left out if the whole bake has so few samples that it is there as soon.
    std::optional<FirstLook> firstLook{};
    std::optional<planet::HeightSource>
        opened{};            // the source if it is open already; otherwise the bake reads it
    std::string launcher{};  // starts the bake on several ranks (launched_bake.h); empty: it runs here
};

}  // namespace worldy
