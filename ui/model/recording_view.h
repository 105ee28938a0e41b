// The state of the Flight panel: recording and replaying.
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
    double timeS = 0;        // of the last frame made
    double durationS = 0;
    bool seeking = false;  // moving to another frame
    ReplayControls controls;
    std::size_t framesDifferent = 0;
    std::string difference;  // the first frame that differs from the recording; empty: none so far
    std::span<const FlightTick> ticks;
};

struct RecordingView {
    std::span<const RecordedFlight> flights;  // sorted by name
    std::string saved;                        // name of the last saved recording; empty: none
    std::optional<RecordingNow> recording;
    std::optional<ReplayNow> replay;
};

}  // namespace worldy::ui
