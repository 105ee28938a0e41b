// What the Precision panel shows: what floats and the depth buffer make of a point.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "planet/measure/precision_probe.h"

namespace ui {

// What two surfaces must be apart to be told apart by depth, metres; infinity where depth tells nothing.
struct DepthSteps {
    double aheadM = 0;  // along the view direction
    double reversedFloatM = 0;
    double fallbackM = 0;  // near plane by the height above the ground
    bool reversedInUse = true;
};

struct ProbedVertex {
    planet::VertexPrecision precision;
    DepthSteps depth;
};

struct ProbeView {
    bool overGround = false;               // the pointer, now
    std::optional<ProbedVertex> vertex;    // under it, or where it was last
    std::optional<ProbedVertex> selected;  // the selected chunk's worst vertex; none where it is not drawn
};

}  // namespace ui
