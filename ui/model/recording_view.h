// What the Flight panel shows: recording and replaying.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "ui/model/replay_controls.h"

namespace worldy::ui {

struct RecordedFlight {
    std::string name;
    std::filesystem::path file;
    double bytes = 0;
};

struct RecordingNow {
    std::string name;
    double seconds = 0;
    std::size_t frames = 0;
    double bytes = 0;  // before compression
    bool simulated = false;
};

// A frame in which chunks were split or merged.
struct FlightTick {
    double timeS = 0;  // from the recording's start
    int splits = 0;
    int merges = 0;
};

struct ReplayNow {
    std::string name;
    std::filesystem::path file;
    std::size_t frame = 0;   // frames made so far
    std::size_t frames = 0;  // in all
    double timeS = 0;        // of the frame made last
    double durationS = 0;
    bool seeking = false;  // on its way to another frame
    ReplayControls controls;
    std::size_t framesDifferent = 0;
    std::string difference;  // the first frame that was not as recorded; empty: none so far
    std::span<const FlightTick> ticks;
};

struct RecordingView {
    std::span<const RecordedFlight> flights;  // by name
    std::string saved;                        // name of the recording saved last; empty: none
    std::optional<RecordingNow> recording;
    std::optional<ReplayNow> replay;
};

}  // namespace worldy::ui
