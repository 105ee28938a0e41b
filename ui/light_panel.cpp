#include "ui/light_panel.h"

#include "ui/air_knobs.h"
#include "ui/feature_knob.h"
#include "ui/sun_knobs.h"
#include "ui/widgets.h"

namespace ui {

namespace {

void lightKnobs(SurfaceSettings& surface) {
    const SurfaceSettings defaults;
    checkbox("Lighting", surface.lighting, defaults.lighting,
             "Off: flat colour, no sun and no air before it.");
    secondColumn();
    checkbox(
        "Detail", surface.detail, defaults.detail,
        "Roughens the ground between the samples. Invented: light and colour only, nothing measured moves.");
}

}  // namespace

void lightPanel(const EditorView& view, ViewSettings& settings, Commands&) {
    SurfaceSettings& surface = settings.surface;
    if (section("Sun")) sunKnobs(view, surface);
    if (section("Light")) lightKnobs(surface);
    if (section("Air")) airKnobs(view, surface);
}

}  // namespace ui
