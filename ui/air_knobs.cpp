#include "ui/air_knobs.h"

#include <fmt/format.h>
#include <imgui.h>

#include "ui/feature_knob.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

void amounts(planet::AirSettings& air) {
    const planet::AirSettings defaults;
    slider("Rayleigh", air.rayleigh, defaults.rayleigh, 0, 5, "%.2f x",
           "Molecules, in units of the Earth's. They scatter blue most: more of them make the sky bluer, the "
           "horizon paler, the sunset redder and what is far away fainter.");
    slider(
        "Haze", air.haze, defaults.haze, 0, 20, "%.2f x",
        "Dust and droplets (Mie scattering), in units of a clear day's. They scatter all colours alike and "
        "mostly forward: more of them whiten the horizon and swallow what is far away.",
        ImGuiSliderFlags_Logarithmic);
    slider("Ozone", air.ozone, defaults.ozone, 0, 5, "%.2f x",
           "In units of the Earth's. It swallows green and red high up, which keeps the zenith blue at dusk. "
           "None: the sky turns yellowish there.");
    slider("Forward", air.forward, defaults.forward, 0, 0.95, "%.2f",
           "How far forward haze scatters: Mie's asymmetry g, 0 evenly. Larger: a smaller and brighter glow "
           "around the sun.");
    slider("Thickness", air.thickness, defaults.thickness, 0.25, 4, "%.2f x",
           "Heights over which the air thins out, in units of the Earth's: 8 km for molecules, 1.2 km for "
           "haze. Larger: a broader limb, and more air in all.");
}

void figures(const EditorView& view) {
    const planet::gl::AirFigures& air = view.light.air;
    if (!beginValues("air")) return;
    valueRow("Tables made in", air.tablesMs > 0 ? millisecondsText(air.tablesMs) : std::string("not yet"),
             "Of transmittance, light scattered more than once, and the sky. They are made anew when a knob "
             "above is turned, but for exposure and steps, on all cores beside the drawing; until then the "
             "last ones are drawn with. What a frame costs is in the Frame panel: the sky's stage, and the "
             "chunks'.");
    valueRow("Tables' size", bytesText(static_cast<double>(air.tableBytes)), "On the GPU.");
    endValues();
    if (air.working) wrappedText("New tables are on their way.", palette().accent);
}

}  // namespace

void airKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    const SurfaceSettings defaults;
    planet::gl::AirDrawing& air = surface.light.air;
    checkbox("Atmosphere", surface.atmosphere, defaults.atmosphere,
             "Haze and sky. Off: none, as on the Moon.");
    ImGui::BeginDisabled(!surface.atmosphere);
    featureKnob("Physical air", CostlyPart::Air, view, surface, commands,
                "Light is scattered and swallowed by molecules, haze and ozone as in the Earth's air, also "
                "more than once. Off: a thin air in closed form, which costs next to nothing and leaves the "
                "ground more contrast. Automatic: on, but off where the CPU draws.",
                "it costs");
    ImGui::BeginDisabled(!planet::gl::isUsed(air.use, view.light.software));
    amounts(air.settings);
    slider("Exposure", air.exposure, defaults.light.air.exposure, 0.1, 10, "%.2f x",
           "Of all light. At 1 the ground by day is as bright as in the thin air. Larger: dusk shows more, "
           "and bright ground bleaches.",
           ImGuiSliderFlags_Logarithmic);
    slider("Steps", air.steps, defaults.light.air.steps, 8, 64, "%d",
           "In which light is summed along a ray through all of the air; half as many before ground, fewer "
           "where it is near. Fewer: a cheaper frame, and a rougher limb and dusk.");
    figures(view);
    ImGui::EndDisabled();
    ImGui::EndDisabled();
}

}  // namespace ui
