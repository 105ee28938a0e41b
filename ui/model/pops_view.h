// What the Pops panel shows: jumps at changes of level.
#pragma once

#include <string>

#include "app/measure/pop_side.h"
#include "planet/measure/pop_meter.h"

namespace worldy::ui {

struct PopsView {
    const planet::PopMeter* meter = nullptr;  // null where there is no planet
    bool measuring = true;
    const planet::PopEvent* shown = nullptr;  // last gone back to
    PopSide side = PopSide::Live;             // that the viewport draws
    std::string problem;                      // why it cannot
};

}  // namespace worldy::ui
