// Lighting and the cost of rendering features, for the panels.
#pragma once

#include <string>
#include <vector>

#include "app/scene/costly_parts.h"
#include "planet/surface/light_drawing.h"

namespace worldy::ui {

struct LightView {
    bool software = false;  // software rendering, for which Automatic turns features off
    TurnedDown turnedDown;  // with a GPU: the features that were too slow
    planet::gl::AirFigures air;
    std::vector<PartCost> costs;  // of the last measurement
    double measured = 1;          // progress of a measurement, [0, 1]; 1: none is running
};

}  // namespace worldy::ui
