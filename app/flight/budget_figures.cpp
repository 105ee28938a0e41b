#include "app/flight/budget_figures.h"

#include <algorithm>
#include <vector>

#include "planet/base/percentile.h"

namespace worldy {

BudgetFigures budgetFiguresOf(std::span<const BudgetedFrame> frames, std::optional<double> stepS) {
    constexpr double firstS = 1, afterStepS = 0.5;
    BudgetFigures figures;
    std::vector<double> uses;
    for (const BudgetedFrame& frame : frames) {
        const bool settles = stepS && frame.timeS >= *stepS && frame.timeS < *stepS + afterStepS;
        if (frame.timeS < firstS || settles) continue;
        ++figures.frames;
        figures.over += frame.use > 1;
        figures.atUpperLimit += frame.limit == planet::GovernorLimit::MostTau;
        figures.mostUse = std::max(figures.mostUse, frame.use);
        if (frame.limit == planet::GovernorLimit::LeastTau)
            ++figures.atLowerLimit;
        else
            uses.push_back(frame.use);
    }
    if (!uses.empty()) figures.medianUse = planet::percentileOf(uses, 0.5);
    return figures;
}

}  // namespace worldy
