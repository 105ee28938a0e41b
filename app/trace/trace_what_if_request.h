// The request of the What if panel. planet/trace/trace_what_if.h selects again.
#pragma once

#include <optional>
#include <vector>

#include "planet/trace/trace_what_if.h"

namespace worldy {

struct TraceWhatIfRequest {
    std::vector<planet::TraceSelectorSettings> settings{};  // a row each
    // Searches for a τ that meets these limits, with the other settings of the first row.
    std::optional<planet::TraceTauGoal> goal{};
};

}  // namespace worldy
