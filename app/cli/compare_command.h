// The command worldy compare: flies the same flight with two settings or two bakes, without a display, and
// prints their figures side by side.
#pragma once

#include <array>
#include <filesystem>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct CompareOptions {
    std::filesystem::path file;
    std::filesystem::path fileOfB;  // empty: the same file
    std::filesystem::path flight;   // .toml or .flight
    FlightSampling sampling;
    PictureSize size;
    std::array<ViewSettings, 2> settings;  // A and B
    ReportTo report;
    std::filesystem::path pictures;  // folder; empty: none
};

planet::Result<void> runCompare(const CompareOptions& options);

}  // namespace worldy
