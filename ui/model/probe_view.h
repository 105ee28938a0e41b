// The state of the Precision panel.
#pragma once

#include <optional>

#include "app/measure/probed_vertex.h"

namespace worldy::ui {

struct ProbeView {
    bool overGround = false;               // the pointer, now
    std::optional<ProbedVertex> vertex;    // under it, or where it was last
    std::optional<ProbedVertex> selected;  // the selected chunk's worst vertex; none where it is not drawn
};

}  // namespace worldy::ui
