// The state of the True error panel.
#pragma once

#include <cstdint>
#include <string>

#include "app/scene/error_measurement.h"

namespace worldy::ui {

struct ErrorsView {
    const ErrorMeasurement* last = nullptr;  // null: none of this planet yet
    bool current = false;                    // the view and the drawn chunks are still those of last
    std::uint64_t frame = 0;                 // the current frame
    bool running = false;
    double progress = 0;  // of the running measurement, [0, 1]
    bool keepMeasuring = false;
    std::string problem;  // why the last measurement failed
};

}  // namespace worldy::ui
