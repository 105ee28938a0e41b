// What the Pops panel shows: jumps at changes of level.
#pragma once

#include <string>

#include "planet/measure/pop_meter.h"
#include "ui/model/commands.h"

namespace ui {

struct PopsView {
    const planet::PopMeter* meter = nullptr;  // null where there is no planet
    bool measuring = true;
    const planet::PopEvent* shown = nullptr;  // last gone back to
    PopSide side = PopSide::Live;             // that the viewport draws
    std::string problem;                      // why it cannot
};

}  // namespace ui
