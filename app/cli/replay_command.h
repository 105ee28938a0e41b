// worldy replay: makes a recorded flight again, without a window, and tells whether it is the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/report.h"
#include "app/flight/flight_replay.h"

namespace worldy {

struct ReplayOptions {
    std::filesystem::path flight;
    std::filesystem::path file;  // chunk file; empty: the one it was recorded over, where that lay
    ReportTo report;
    ReplayPaging paging = ReplayPaging::AsRecorded;
    std::vector<std::string> assignments;  // settings held at other values: then a difference is no failure
};

// True if it was exact, or was not meant to be. The report is printed, and written where that is asked for.
planet::Result<bool> replayFlight(const ReplayOptions& options);

}  // namespace worldy
