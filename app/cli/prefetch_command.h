// The command worldy prefetch: flies a path over simulated disks with each way of prefetching, and says how much
// less data is late, and how much more is read. Draws nothing.
#pragma once

#include <filesystem>
#include <vector>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"

namespace worldy {

struct PrefetchOptions {
    std::filesystem::path file;
    std::filesystem::path flight;  // .toml or .flight
    FlightSampling sampling;
    std::vector<planet::PrefetchMode> modes = {planet::PrefetchMode::Off, planet::PrefetchMode::Motion,
                                               planet::PrefetchMode::Announced};
    std::vector<double> disksMBs = {2, 8, 32};
    std::vector<double> latenciesMs{};  // empty: that of the settings
    std::vector<double> speeds = {0.5, 1, 2};
    std::vector<double> horizonsS{};  // empty: that of the settings
    ReportTo report;                  // JSON, or CSV if the file ends in .csv
    PictureSize size;
    ViewSettings view;
};

planet::Result<void> runPrefetch(const PrefetchOptions& options);

}  // namespace worldy
