// The state of the True error panel.
#pragma once

#include <cstdint>
#include <string>

#include "app/scene/error_measurement.h"

namespace worldy::ui {

struct ErrorsView {
    const ErrorMeasurement* last = nullptr;  // null while there is none of this planet
    bool current = false;                    // the view and what is drawn are still those of last
    std::uint64_t frame = 0;                 // now
    bool running = false;
    double progress = 0;  // of the one that runs, [0, 1]
    bool keepMeasuring = false;
    std::string problem;  // why the last one came to nothing
};

}  // namespace worldy::ui
