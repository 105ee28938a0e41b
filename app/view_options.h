// Options of the command line that shot and fly share, and what they turn into.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/settings.h"
#include "planet/result.h"
#include "planet/view.h"

namespace worldy {

struct PictureSize {
    int widthPx = 1280;
    int heightPx = 720;
};

// "1280x720"; [16, 16384] a side.
planet::Result<PictureSize> pictureSizeFromText(const std::string& text);

// "LAT,LON,ALT,HEADING,PITCH", trailing ones may be left out: heading 0, pitch -90.
planet::Result<planet::CameraPose> poseFromText(const std::string& text);

}  // namespace worldy
