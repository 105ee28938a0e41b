// worldy shot: one picture of a planet, without a display.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/view_options.h"
#include "ui/view_settings.h"

namespace worldy {

struct ShotOptions {
    std::filesystem::path file;
    std::filesystem::path output;
    std::filesystem::path shaderFolder;
    std::filesystem::path colourImage;  // empty: colour.jpg or colour.png beside the file, if there is one
    std::optional<planet::CameraPose> camera;  // the whole planet where not given
    PictureSize size;
    int samples = 4;  // of the multisampling, [1, 16]
    bool json = false;
    ui::ViewSettings view;
};

planet::Result<void> takeShot(const ShotOptions& options);

}  // namespace worldy
