#include "ui/light_panel.h"

#include <imgui.h>

#include "ui/air_knobs.h"
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
    checkbox(
        "Detail", surface.detail, defaults.detail,
        "Roughens the ground between the samples. Invented: light and colour only, nothing measured moves.");
}

void seaKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    planet::gl::SeaDrawing& sea = surface.light.sea;
    const planet::gl::SeaDrawing defaults;
    featureKnob(
        "Sea surface", CostlyPart::Sea, view, surface, commands,
        "Draws the sea at its level, as water: waves, the mirrored sky and sun, and the bed's depth in "
        "its colour. Off: flat colours on the sea's bed. What instruments measure is the bed.",
        "waves cost");
    slider(
        "Wind", sea.windMps, defaults.windMps, 0, 30, "%.1f m/s",
        "Metres a second, 12.5 m above the water: variance of the waves' slopes = 0.003 + 0.00512 wind (Cox "
        "and Munk). More: the sun's glint is wider and dimmer.");
    slider("Waves", sea.waves, defaults.waves, 0, 2, "%.2f",
           "Strength of the waves that are seen one by one, 1.3 to 110 m long. They stand still, so that "
           "pictures can be compared.");
    slider(
        "Clarity", sea.clarityM, defaults.clarityM, 0.5, 100, "%.1f m",
        "Depth of water, metres, that takes away all but 1 / e of green light; red goes five times as fast. "
        "More: the bed shows deeper.",
        ImGuiSliderFlags_Logarithmic);
}

void shadowKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    planet::gl::ShadowDrawing& shadows = surface.light.shadows;
    const planet::gl::ShadowDrawing defaults;
    featureKnob(
        "Shadows", CostlyPart::Shadows, view, surface, commands,
        "The ground's shadows on itself: the drawn mesh as the sun sees it, in three maps one behind the "
        "other. They show what the level of detail does to them.",
        "drawing the ground three times more costs");
    slider("Map size", shadows.mapSizePx, defaults.mapSizePx, 256, 8192, "%d px",
           "Side of each of the three maps, pixels. Larger: sharper, 12 bytes a pixel in all, and slower.",
           ImGuiSliderFlags_Logarithmic);
    slider(
        "Reach", shadows.reachM, defaults.reachM, 1000, 1e7, "%.0f m",
        "Metres from the eye where shadows end. Larger: they reach farther and are coarser everywhere, and "
        "more chunks beside the view are drawn for them.",
        ImGuiSliderFlags_Logarithmic);
    slider("Softness", shadows.softness, defaults.softness, 0, 4, "%.1f texels",
           "Radius of the filter over their edges, texels of the map. More: softer, and thin shadows fade.");
}

}  // namespace

void lightPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    SurfaceSettings& surface = settings.surface;
    if (section("Sun")) sunKnobs(view, surface);
    if (section("Light")) lightKnobs(surface);
    if (section("Normals")) normalKnobs(view, settings, commands);
    if (section("Air")) airKnobs(view, surface, commands);
    if (section("Water")) seaKnobs(view, surface, commands);
    if (section("Shadows")) shadowKnobs(view, surface, commands);
}

}  // namespace ui
