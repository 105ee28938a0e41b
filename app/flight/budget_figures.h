// How well a flight kept to its budgets. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "planet/select/governor.h"

namespace worldy {

// A frame of a governed flight.
struct BudgetedFrame {
    double timeS = 0;  // since the first frame
    double use = 0;    // of the budget that binds
    planet::GovernorLimit limit = planet::GovernorLimit::None;
};

// Figures over the frames apart from the first second and the half second after a step, in which τ may still move towards
// the budget.
struct BudgetFigures {
    int frames = 0;
    int over = 0;          // use > 1
    int atLowerLimit = 0;  // of τ
    int atUpperLimit = 0;
    double mostUse = 0;
    double medianUse = 0;  // of the frames in which τ is above its lower limit; 0 if there are none
};

// stepS: time of a step in cost, if there is one.
BudgetFigures budgetFiguresOf(std::span<const BudgetedFrame> frames, std::optional<double> stepS = {});

}  // namespace worldy
