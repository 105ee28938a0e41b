// worldy fly: flies a recorded path without a display, as fast as the frames come, and reports what each did.
#pragma once

#include <filesystem>

#include "app/view_options.h"
#include "ui/view_settings.h"

namespace worldy {

struct FlyOptions {
    std::filesystem::path file;
    std::filesystem::path path;  // of the flight's keys
    std::filesystem::path jsonOutput;
    std::filesystem::path shaderFolder;
    int frames = 300;
    PictureSize size;
    ui::ViewSettings view;
};

planet::Result<void> flyPath(const FlyOptions& options);

}  // namespace worldy
