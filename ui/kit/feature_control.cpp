#include "ui/kit/feature_control.h"

#include <fmt/format.h>

#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

void featureControl(const SettingControls& control, CostlyPart part, const EditorView& view,
                    SurfaceSettings& surface, Commands& commands) {
    using planet::gl::FeatureUse;
    FeatureUse& use = useOf(part, surface);
    control(use);
    if (use != FeatureUse::Automatic) return;
    if (view.instruments.light.software) {
        wrappedText("Off: software rendering; exceeds the 50 ms budget.", palette().warning);
    } else if (view.instruments.light.turnedDown.has(part)) {
        wrappedText(
            fmt::format("Off: GPU frame time {:.0f} ms exceeds the {:.0f} ms budget.",
                        view.instruments.light.turnedDown.tookMs[static_cast<std::size_t>(part)], affordedMs),
            palette().warning);
        ImGui::PushID(static_cast<int>(part));
        if (button("Try again",
                   "Turns the disabled features on again until the GPU frame time exceeds the budget."))
            commands.emplace_back(TryCostlyParts{});
        ImGui::PopID();
    }
}

}  // namespace worldy::ui
