// The state of the Sweep panel.
#pragma once

#include <span>
#include <string>

#include "app/measure/sweep_table.h"

namespace worldy::ui {

struct SweepView {
    const SweepTable* table = nullptr;             // null before the first sweep
    std::span<const SweepSuggestion> suggestions;  // for the last goal, one per metric
    bool running = false;
    bool suggesting = false;  // the running sweep searches for a tau
    bool cancelling = false;  // not finished yet
    SweepProgress progress;
    std::string problem;  // why the last sweep failed or ended early
};

}  // namespace worldy::ui
