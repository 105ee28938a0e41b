// The command worldy pops: flies a path with all loads on time, and measures how far the surface jumps at
// each level change. Draws nothing.
#pragma once

#include <filesystem>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct PopsOptions {
    std::filesystem::path file;
    std::filesystem::path flight;  // camera keys
    ReportTo report;
    int worst = 20;  // level changes to print, >= 0; the report contains all
    FlightSampling sampling;
    PictureSize size;
    ViewSettings view;
};

planet::Result<void> runPops(const PopsOptions& options);

}  // namespace worldy
