// The result of the precision probe.
#pragma once

#include "planet/measure/precision_probe.h"

namespace worldy {

// The smallest distance of two surfaces that the depth buffer can separate, in metres; infinity if it cannot
// separate any.
struct DepthSteps {
    double aheadM = 0;  // distance along the view direction
    double reversedFloatM = 0;
    double fallbackM = 0;  // non-reversed Z, with the near plane chosen by the height above the ground
    bool reversedInUse = true;
};

// The precision of one vertex and of the depth buffer there.
struct ProbedVertex {
    planet::VertexPrecision precision;
    DepthSteps depth;
};

}  // namespace worldy
