#include "ui/panels/lod/budget_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/base/glossary.h"
#include "app/scene/governing.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/history.h"

namespace worldy::ui {

namespace {

using planet::GovernorBudget;

constexpr std::array<const char*, planet::governorBudgetCount> costMeanings = {
    "CPU time of a frame, median of three frames, and its budget.",
    "GPU time of a frame, median of three frames, and its budget. Some frames old.",
    "Triangles of the last frame, and their budget.",
    "Memory of the chunks that the picture needs, resident or not, and its budget.",
    "Bytes read in a second, mean of half a second, and their budget."};

template <class Value>
void budgetControl(const SettingControls& control, Value& value) {
    control(value, value == 0 ? ControlChange{.format = "off"} : ControlChange{});
}

void budgetControls(const SettingControls& control, BudgetSettings& budget) {
    budgetControl(control, budget.cpuMs);
    budgetControl(control, budget.gpuMs);
    budgetControl(control, budget.triangles);
    budgetControl(control, budget.memoryMB);
    budgetControl(control, budget.readMBs);
    beginGrey(!budget.isOn(), "Set a budget first.");
    control(budget.leastTauPx);
    control(budget.mostTauPx);
    control(budget.hysteresis);
    endGrey();
}

void costRows(const BudgetUse& use, const BudgetSettings& budget) {
    if (!beginValues("costs and budgets")) return;
    for (std::size_t b = 0; b < use.uses.size(); ++b) {
        if (use.uses[b] == 0) continue;
        valueRow(budgetNames[b].data(), costText(static_cast<GovernorBudget>(b), use, budget),
                 costMeanings[b], use.uses[b] > 1 ? &palette().bad : nullptr);
    }
    endValues();
}

void governedPlots(const EditorView& view) {
    const std::vector<float> times = historyTimes(view.frames.history);
    const std::string tau = fmt::format("tolerance {}", tauSymbol());
    const std::array taus = {
        Series{tau.c_str(), seriesColour(0),
               historyValues(view.frames.history, [](const FrameStats& s) { return s.tauPx; })}};
    linePlot("tolerance", times, taus, "px", 0, 3);
    tooltip("Tolerance that each frame was selected with.");
    const std::array uses = {
        Series{"use of the budget that binds", seriesColour(1),
               historyValues(view.frames.history, [](const FrameStats& s) { return 100 * s.budget.use; })}};
    const auto most = std::max_element(uses[0].values.begin(), uses[0].values.end());
    constexpr double usualTop = 125;  // so that the budget is in sight
    const bool isUsual = most == uses[0].values.end() || *most < 120;
    linePlot("budget use", times, uses, "%", isUsual ? usualTop : 0, 3, false, 100);
    tooltip(terms::budgetUse.meaning);
}

}  // namespace

const char* whyTauIsGoverned(const ViewSettings& settings) {
    return settings.budget.isOn() ? "A budget chooses it; turn all budgets off to set it by hand." : nullptr;
}

void budgetSection(const EditorView& view, const SettingControls& control, ViewSettings& settings) {
    budgetControls(control, settings.budget);
    if (!settings.budget.isOn()) return;
    if (view.recording.replay)
        return wrappedText("A replay uses the tolerances that were recorded.", palette().dim);
    const BudgetUse& use = view.frames.stats.budget;
    const bool isOver = use.isMeasured && use.use > 1;
    wrappedText(bindsText(use, tauSymbol()), isOver ? palette().bad : palette().text);
    tooltip(terms::budgetBinds.meaning);
    if (!use.isMeasured) return;
    usageBar(use.use, fmt::format("{:.0f} % of the budget", 100 * use.use));
    tooltip(terms::budgetUse.meaning);
    costRows(use, settings.budget);
    governedPlots(view);
}

}  // namespace worldy::ui
