// Picture sizes and camera poses as the command line writes them. Pure functions, any thread.
#pragma once

#include <string>

#include "planet/base/result.h"
#include "planet/sphere/view.h"

namespace worldy {

struct PictureSize {
    int widthPx = 1280;
    int heightPx = 720;
};

// Reads "1280x720"; each side is in [16, 16384].
planet::Result<PictureSize> pictureSizeFromText(const std::string& text);

// Reads "LAT,LON,ALT,HEADING,PITCH" in degrees and metres. Trailing numbers may be left out: heading 0, pitch
// -90.
planet::Result<planet::CameraPose> poseFromText(const std::string& text);

// Returns "LAT,LON,ALT,HEADING,PITCH" for --camera, with enough digits to read back the same numbers.
std::string cameraText(const planet::CameraPose& pose);

// Returns the pose rounded to 1e-9 degrees and 1e-6 m, for reports: smaller digits are rounding errors of the
// eye's position.
planet::CameraPose roundedPose(const planet::CameraPose& pose);

}  // namespace worldy
