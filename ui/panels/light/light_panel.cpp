#include "ui/panels/light/light_panel.h"

#include <imgui.h>

#include "ui/kit/feature_knob.h"
#include "ui/kit/widgets.h"
#include "ui/panels/light/air_knobs.h"
#include "ui/panels/light/normal_knobs.h"
#include "ui/panels/light/sun_knobs.h"

namespace worldy::ui {

namespace {

void lightKnobs(SurfaceSettings& surface) {
    const SurfaceSettings defaults;
    checkbox("Lighting", surface.lighting, defaults.lighting,
             "Shades the ground by the sun. Off: flat colour, without sun and atmosphere.");
    secondColumn("Detail");
    checkbox(
        "Detail", surface.detail, defaults.detail,
        "Adds procedural roughness between the samples, to light and colour only; no measurement changes.");
    slider(
        "Fill light", surface.light.fill, defaults.light.fill, 0, 1, "%.2f",
        "Strength of a debug light on the night side, from the upper left of the view; 0 is off. It is left "
        "out of pictures that measure: tinted chunks, compared pictures and sweeps.");
}

void seaKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    planet::gl::SeaDrawing& sea = surface.light.sea;
    const planet::gl::SeaDrawing defaults;
    featureKnob("Sea surface", CostlyPart::Sea, view, surface, commands,
                "Draws water at the sea level: waves, reflections of the sky and the sun, and a colour that "
                "depends on the depth. Off: flat colours on the sea bed. Measurements always use the bed.");
    slider("Wind", sea.windMps, defaults.windMps, 0, 30, "%.1f m/s",
           "Wind speed 12.5 m above the water, in m/s. The variance of the wave slopes is 0.003 + 0.00512 "
           "wind (Cox and Munk). Larger: the sun's glint is wider and dimmer.");
    slider("Waves", sea.waves, defaults.waves, 0, 2, "%.2f",
           "Strength of the resolved waves, 1.3 to 110 m long. They stand still so that pictures can be "
           "compared.");
    slider("Clarity", sea.clarityM, defaults.clarityM, 0.5, 100, "%.1f m",
           "Depth of water, in metres, that reduces green light to 1/e; red is absorbed five times as fast. "
           "Larger: the bed shows at greater depth.",
           ImGuiSliderFlags_Logarithmic);
}

void shadowKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    planet::gl::ShadowDrawing& shadows = surface.light.shadows;
    const planet::gl::ShadowDrawing defaults;
    featureKnob("Shadows", CostlyPart::Shadows, view, surface, commands,
                "Shadows of the ground on itself, from the drawn mesh, in three shadow map cascades. They "
                "show how level of detail affects shadows.");
    slider(
        "Map size", shadows.mapSizePx, defaults.mapSizePx, 256, 8192, "%d px",
        "Side of each of the three maps, in pixels; 12 bytes per pixel in total. Larger: sharper and slower.",
        ImGuiSliderFlags_Logarithmic);
    slider("Shadow distance", shadows.reachM, defaults.reachM, 1000, 1e7, "%.0f m",
           "Distance from the camera, in metres, where shadows end. Larger: shadows are coarser everywhere, "
           "and more chunks beside the view are drawn for them.",
           ImGuiSliderFlags_Logarithmic);
    slider("Softness", shadows.softness, defaults.softness, 0, 4, "%.1f texels",
           "Filter radius at shadow edges, in texels of the map. Larger: softer, and thin shadows fade.");
}

}  // namespace

void lightPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    SurfaceSettings& surface = settings.surface;
    if (section("Sun")) sunKnobs(view, surface);
    if (section("Light")) lightKnobs(surface);
    if (section("Normals")) normalKnobs(view, settings, commands);
    if (section("Atmosphere")) airKnobs(view, surface, commands);
    if (section("Water")) seaKnobs(view, surface, commands);
    if (section("Shadows")) shadowKnobs(view, surface, commands);
}

}  // namespace worldy::ui
