// The command worldy shot: draws one picture of a planet, without a display.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct ShotOptions {
    std::filesystem::path file;
    std::filesystem::path output;
    std::filesystem::path shaderFolder;
    std::filesystem::path colourImage;  // empty: colour.jpg or colour.png beside the file, if it exists
    std::filesystem::path source;       // of FILE, for settings that show its layers; empty: not known
    std::optional<planet::CameraPose> camera;
    planet::CameraPose start{.altitudeM = 0};  // used without a camera; altitude 0: the whole planet
    PictureSize size;
    int samples = 4;  // samples per pixel, [1, 16]
    bool json = false;
    ViewSettings view;
};

// Draws and writes the picture. A .png contains the settings and the camera like a screenshot. Chunk labels
// and the observer are drawn only in the window.
planet::Result<void> takeShot(const ShotOptions& options);

}  // namespace worldy
