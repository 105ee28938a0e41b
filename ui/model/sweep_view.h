// The state of the Sweep panel.
#pragma once

#include <span>
#include <string>

#include "app/measure/sweep_table.h"

namespace worldy::ui {

struct SweepView {
    const SweepTable* table = nullptr;             // null before the first sweep
    std::span<const SweepSuggestion> suggestions;  // to what was asked last, one a metric
    bool running = false;
    bool suggesting = false;  // what runs looks for a tau
    bool cancelling = false;  // but not yet at its end
    SweepProgress progress;
    std::string problem;  // why what ran last came to nothing, or ended early
};

}  // namespace worldy::ui
