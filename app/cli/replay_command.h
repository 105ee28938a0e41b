// The command worldy replay: replays a recorded flight without a window and checks that it is the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/report.h"
#include "app/flight/flight_replay.h"

namespace worldy {

struct ReplayOptions {
    std::filesystem::path flight;
    std::filesystem::path file;  // chunk file; empty: the recorded path
    ReportTo report;
    ReplayPaging paging = ReplayPaging::AsRecorded;
    std::vector<std::string>
        assignments;  // settings that override the recording; differences then do not fail
};

// Returns true if the replay was exact, or settings were overridden. Prints the report, and writes it if
// requested.
planet::Result<bool> replayFlight(const ReplayOptions& options);

}  // namespace worldy
