// The state of the Precision panel.
#pragma once

#include <optional>

#include "app/measure/probed_vertex.h"

namespace worldy::ui {

struct ProbeView {
    bool overGround = false;               // the pointer is over the ground now
    std::optional<ProbedVertex> vertex;    // below the pointer, or at its last position over the ground
    std::optional<ProbedVertex> selected;  // the worst vertex of the selected chunk; none if it is not drawn
};

}  // namespace worldy::ui
