#include "ui/feature_knob.h"

#include <fmt/format.h>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

void featureKnob(const char* label, CostlyPart part, const EditorView& view, SurfaceSettings& surface,
                 Commands& commands, const char* explanation, const char* costs) {
    using planet::gl::FeatureUse;
    FeatureUse& use = useOf(part, surface);
    choice(label, use, FeatureUse::Automatic, "automatic\0on\0off\0", explanation);
    if (use != FeatureUse::Automatic) return;
    if (view.light.software) {
        wrappedText(
            fmt::format("Turned down: the CPU draws here, and {} more than 20 frames a second leave.", costs),
            palette().warning);
    } else if (view.light.turnedDown.has(part)) {
        wrappedText(
            fmt::format("Turned down: with it a picture took {:.0f} ms of the GPU; 20 frames a second "
                        "leave {:.0f}.",
                        view.light.turnedDown.tookMs[static_cast<std::size_t>(part)], affordedMs),
            palette().warning);
        ImGui::PushID(label);
        if (button("Try again",
                   "Everything that was turned down is drawn again, until pictures are too slow."))
            commands.emplace_back(TryCostlyParts{});
        ImGui::PopID();
    }
}

}  // namespace ui
