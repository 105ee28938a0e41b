// The command worldy schedule: predicts how long a bake takes on more ranks, from the report of one.
#pragma once

#include <filesystem>
#include <vector>

#include "app/base/report.h"

namespace worldy {

struct ScheduleOptions {
    std::filesystem::path file;  // of a bake with units: worldy bake --resume --json, or on several ranks
    std::vector<int> ranks = {1, 8, 64, 512};
    int threads = 1;              // of a rank
    double megabytesPerS = 1000;  // of the file system, which all ranks share
    ReportTo report;
};

// Prints a table, and writes JSON if requested.
planet::Result<void> runSchedule(const ScheduleOptions& options);

}  // namespace worldy
