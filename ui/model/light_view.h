// What the panels know of light and of what the parts of the picture cost.
#pragma once

#include <string>
#include <vector>

#include "app/scene/costly_parts.h"
#include "planet/surface/light_drawing.h"

namespace worldy::ui {

struct LightView {
    bool software = false;  // the CPU draws: what is Automatic is turned down
    TurnedDown turnedDown;  // where the GPU draws
    planet::gl::AirFigures air;
    std::vector<PartCost> costs;  // as last measured
    double measured = 1;          // share of a measurement that is under way, [0, 1]; 1: none is
};

}  // namespace worldy::ui
