#include "ui/feature_knob.h"

#include <fmt/format.h>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

void featureKnob(const char* label, planet::gl::FeatureUse& use, const EditorView& view,
                 const char* explanation, const char* costs) {
    using planet::gl::FeatureUse;
    choice(label, use, FeatureUse::Automatic, "automatic\0on\0off\0", explanation);
    if (use != FeatureUse::Automatic || !view.light.software) return;
    wrappedText(
        fmt::format("Turned down: the CPU draws here, and {} more than 20 frames a second leave.", costs),
        palette().warning);
}

}  // namespace ui
