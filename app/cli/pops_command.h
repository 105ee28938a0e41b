// worldy pops: flies a path with all loads on time, and tells how far the surface jumps at each change of
// level. Draws nothing.
#pragma once

#include <filesystem>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct PopsOptions {
    std::filesystem::path file;
    std::filesystem::path flight;  // its keys
    ReportTo report;
    int worst = 20;  // switches that are printed, >= 0; the report holds all
    FlightSampling sampling;
    PictureSize size;
    ViewSettings view;
};

planet::Result<void> runPops(const PopsOptions& options);

}  // namespace worldy
