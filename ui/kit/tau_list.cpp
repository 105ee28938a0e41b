#include "ui/kit/tau_list.h"

#include <fmt/format.h>
#include <imgui.h>

#include "app/settings/view_settings.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

TauList tauListControl(std::span<char> text, const char* use) {
    const std::string explanation =
        fmt::format("Tolerances in pixels, in [{}, {}], separated by spaces or commas. {}", smallestTauPx,
                    largestTauPx, use);
    labelledControl(fmt::format("{}, px", tauSymbol()).c_str(), explanation.c_str());
    ImGui::InputText("##taus", text.data(), text.size());
    noteItem("Tolerances");
    tooltip(explanation.c_str());
    TauList taus = tausFromText(text.data());
    if (!taus.problem.empty()) wrappedText(taus.problem, palette().bad);
    return taus;
}

}  // namespace worldy::ui
