// The state of the Pops panel: jumps of the surface at level changes.
#pragma once

#include <string>

#include "app/measure/pop_side.h"
#include "planet/measure/pop_meter.h"

namespace worldy::ui {

struct PopsView {
    const planet::PopMeter* meter = nullptr;  // null if no planet is open
    bool measuring = true;
    const planet::PopEvent* shown = nullptr;  // the event inspected last
    PopSide side = PopSide::Live;             // the side that the viewport draws
    std::string problem;                      // why the event cannot be shown
};

}  // namespace worldy::ui
