#include "ui/panels/light/air_knobs.h"

#include <fmt/format.h>
#include <imgui.h>

#include "app/base/text.h"
#include "ui/kit/feature_knob.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

void amounts(planet::AirSettings& air) {
    const planet::AirSettings defaults;
    slider("Rayleigh", air.rayleigh, defaults.rayleigh, 0, 5, "%.2f x",
           "Rayleigh scattering by air molecules, relative to the Earth. It scatters blue most. Larger: a "
           "bluer sky, a paler horizon, a redder sunset and fainter distant ground.");
    slider("Haze", air.haze, defaults.haze, 0, 20, "%.2f x",
           "Mie scattering by dust and droplets, relative to a clear day. It scatters all colours alike and "
           "mostly forward. Larger: a whiter horizon, and distant ground fades.",
           ImGuiSliderFlags_Logarithmic);
    slider("Ozone", air.ozone, defaults.ozone, 0, 5, "%.2f x",
           "Ozone absorption relative to the Earth. Ozone absorbs green and red light at high altitude, "
           "which keeps the zenith blue at dusk. At 0 the zenith turns yellowish.");
    slider("Mie asymmetry g", air.forward, defaults.forward, 0, 0.95, "%.2f",
           "How strongly haze scatters forward; 0 scatters evenly. Larger: a smaller and brighter glow "
           "around the sun.");
    slider("Scale height", air.thickness, defaults.thickness, 0.25, 4, "%.2f x",
           "Scale heights relative to the Earth: 8 km for molecules, 1.2 km for haze. Larger: a broader limb "
           "and more air in total.");
}

void figures(const EditorView& view) {
    const planet::gl::AirFigures& air = view.light.air;
    if (!beginValues("air")) return;
    valueRow("Table build time",
             air.tablesMs > 0 ? millisecondsText(air.tablesMs) : std::string("not built yet"),
             "Time to build the lookup tables for transmittance, multiple scattering and the sky. Changing a "
             "setting above, except exposure and steps, rebuilds them on all cores in the background; the "
             "previous tables are used until then. The Frame panel shows the cost per frame in its sky and "
             "chunks stages.");
    valueRow("Table memory", bytesText(static_cast<double>(air.tableBytes)),
             "GPU memory of the lookup tables.");
    endValues();
    if (air.working) wrappedText("Rebuilding the tables.", palette().accent);
}

}  // namespace

void airKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    const SurfaceSettings defaults;
    planet::gl::AirDrawing& air = surface.light.air;
    checkbox("Atmosphere", surface.atmosphere, defaults.atmosphere,
             "Draws haze and the sky. Off: no atmosphere, as on the Moon.");
    beginGrey(!surface.atmosphere, "Turn on Atmosphere first.");
    featureKnob("Physical model", CostlyPart::Air, view, surface, commands,
                "Molecules, haze and ozone scatter and absorb light as in the Earth's atmosphere, with "
                "multiple scattering. Off: an analytic model, which costs almost nothing and leaves the "
                "ground more contrast. Automatic: on, but off with software rendering.");
    beginGrey(!planet::gl::isUsed(air.use, view.light.software), "The physical model is off.");
    amounts(air.settings);
    slider("Exposure", air.exposure, defaults.light.air.exposure, 0.1, 10, "%.2f x",
           "Multiplies all light. At 1 the ground by day is as bright as with the analytic model. Larger: "
           "dusk is easier to see, and bright ground saturates.",
           ImGuiSliderFlags_Logarithmic);
    slider("Steps", air.steps, defaults.light.air.steps, 8, 64, "%d",
           "Ray-march steps through the whole atmosphere; half as many in front of ground, fewer where it is "
           "near. Fewer: a cheaper frame, and a rougher limb and dusk.");
    figures(view);
    endGrey();
    endGrey();
}

}  // namespace worldy::ui
