#include "ui/panels/measure/ruler_panel.h"

#include <imgui.h>

#include "ui/kit/figure_rows.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/measure/ruler_profile.h"

namespace worldy::ui {

namespace {

void controls(const RulerView& ruler, Commands& commands) {
    bool takesClicks = ruler.takesClicks;
    if (ImGui::Checkbox("Click places", &takesClicks)) commands.push_back(TakeRulerClicks{takesClicks});
    noteItem("Click places");
    tooltip(
        "Clicks on the ground in the viewport place the two ends, A and B, instead of selecting chunks. A "
        "third click "
        "begins again with A.");
    beginGrey(ruler.ends.size() < 2, "There are no two ends yet.");
    sameLineForButton("Swap");
    if (button("Swap", "Measures from B to A.")) commands.push_back(SwapRulerEnds{});
    endGrey();
    beginGrey(ruler.ends.empty(), "There is no end yet.");
    sameLineForButton("Clear");
    if (button("Clear", "Removes both ends.")) commands.push_back(ClearRuler{});
    endGrey();
}

const char* hintOf(const RulerView& ruler) {
    if (!ruler.takesClicks) return "Turn on \"Click places\", then click two places on the ground.";
    return ruler.ends.empty() ? "Click the first place, A, on the ground." : "Click the second place, B.";
}

}  // namespace

void rulerPanel(const EditorView& view, Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to measure its ground.");
    const RulerView& ruler = view.instruments.ruler;
    controls(ruler, commands);
    if (!ruler.problem.empty()) wrappedText(ruler.problem, palette().bad);
    if (ruler.ends.size() < 2) wrappedText(hintOf(ruler), palette().dim);
    if (beginValues("ruler")) {
        figureRows(rulerFigures(ruler));
        endValues();
    }
    if (ruler.ends.size() == 2 && !ruler.current && ruler.problem.empty()) {
        wrappedText(
            ruler.measured
                ? "The drawn chunks have changed; the profile is measured again when they have loaded."
                : "Measuring the ground...",
            palette().dim);
    }
    if (!ruler.measured) return;
    if (const auto point = rulerProfile(ruler.measured->profile, ruler.measured->summary, 9))
        commands.push_back(HoverProfile{*point});
}

}  // namespace worldy::ui
