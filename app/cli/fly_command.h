// The command worldy fly: flies a path without a display, as fast as possible, and reports each frame.
#pragma once

#include <filesystem>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct FlyOptions {
    std::filesystem::path file;
    std::filesystem::path flight;  // .toml or .flight
    FlightSampling sampling;
    ReportTo report;
    std::filesystem::path trace;  // of the frames (planet/trace/lod_trace.h); empty: none
    std::filesystem::path shaderFolder;
    PictureSize size;
    ViewSettings view;
};

planet::Result<void> flyPath(const FlyOptions& options);

}  // namespace worldy
