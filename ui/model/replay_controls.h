// How a recorded flight is replayed.
#pragma once

namespace worldy::ui {

struct ReplayControls {
    bool playing = true;
    bool loop = false;
    bool simulated = false;  // blocks arrive by the recorded bad disk and seed, not in their recorded frames
    double speed = 1;        // recorded seconds a second, [0.1, 10]

    bool operator==(const ReplayControls&) const = default;
};

}  // namespace worldy::ui
