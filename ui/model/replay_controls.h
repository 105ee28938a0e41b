// The user's choices for replaying a recorded flight.
#pragma once

namespace worldy::ui {

struct ReplayControls {
    bool playing = true;
    bool loop = false;
    bool simulated = false;  // block arrival is simulated from the recorded I/O faults and seed, not replayed
    double speed = 1;        // recorded seconds per second, [0.1, 10]

    bool operator==(const ReplayControls&) const = default;
};

}  // namespace worldy::ui
