// The Suggest panel: finds settings that meet a budget on flights or on the whole planet, shows the candidates, and applies
// or saves the result.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_vary.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// The text of a budget while it is edited, and as long as it cannot be read.
struct SuggestBudgetEdit {
    std::array<char, 48> text{};
    bool isOpen = false;    // the text is shown instead of the budget
    std::string problem{};  // why the text cannot be read
};

struct SuggestPanelState {
    // In the order of suggestLimits; memory in MiB. A limit has an effect if it is on.
    std::array<bool, suggestLimitCount> on{false, true, true, true};
    std::array<double, suggestLimitCount> limits{16.6, 200'000, 64, 1.5};
    std::array<SuggestBudgetEdit, suggestLimitCount> edits{};
    std::set<std::string> flights;  // files
    bool hasChosen = false;         // false: the first flight is chosen as soon as there is one
    bool surveys = false;
    SuggestVary vary{};
    bool variesChunkSize = false;
    std::optional<std::size_t> selected;  // index of a trial
};

void suggestPanel(const EditorView& view, SuggestPanelState& state, Commands& commands);

}  // namespace worldy::ui
