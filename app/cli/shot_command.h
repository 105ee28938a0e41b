// worldy shot: one picture of a planet, without a display.
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
    std::filesystem::path colourImage;  // empty: colour.jpg or colour.png beside the file, if there is one
    std::optional<planet::CameraPose> camera;
    planet::CameraPose start{.altitudeM = 0};  // where no camera is given; altitude 0: the whole planet
    PictureSize size;
    int samples = 4;  // of the multisampling, [1, 16]
    bool json = false;
    ViewSettings view;
};

// A .png keeps the settings and the camera as a screenshot does. Labels on chunks and the observer are the
// window's alone.
planet::Result<void> takeShot(const ShotOptions& options);

}  // namespace worldy
