#include "ui/light_panel.h"

#include "ui/feature_knob.h"
#include "ui/normal_knobs.h"
#include "ui/sun_knobs.h"
#include "ui/widgets.h"

namespace ui {

namespace {

void lightKnobs(SurfaceSettings& surface) {
    const SurfaceSettings defaults;
    checkbox("Lighting", surface.lighting, defaults.lighting,
             "Off: flat colour, no sun and no air before it.");
    secondColumn();
    checkbox("Atmosphere", surface.atmosphere, defaults.atmosphere, "Haze and sky.");
    checkbox(
        "Detail", surface.detail, defaults.detail,
        "Roughens the ground between the samples. Invented: light and colour only, nothing measured moves.");
}

}  // namespace

void lightPanel(const EditorView& view, ViewSettings& settings, Commands&) {
    SurfaceSettings& surface = settings.surface;
    if (section("Sun")) sunKnobs(view, surface);
    if (section("Light and air")) lightKnobs(surface);
    if (section("Normals")) normalKnobs(view, settings);
}

}  // namespace ui
