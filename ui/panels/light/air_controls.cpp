#include "ui/panels/light/air_controls.h"

#include <fmt/format.h>

#include "app/base/text.h"
#include "ui/kit/feature_control.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

void figures(const EditorView& view) {
    const planet::gl::AirFigures& air = view.instruments.light.air;
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

void airControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface,
                 Commands& commands) {
    planet::gl::AirDrawing& air = surface.light.air;
    control(surface.atmosphere);
    beginGrey(!surface.atmosphere, "Turn on Atmosphere first.");
    featureControl(control, CostlyPart::Air, view, surface, commands);
    beginGrey(!planet::gl::isUsed(air.use, view.instruments.light.software), "The physical model is off.");
    control(air.settings.rayleigh);
    control(air.settings.haze);
    control(air.settings.ozone);
    control(air.settings.forward);
    control(air.settings.thickness);
    control(air.exposure);
    control(air.steps);
    figures(view);
    endGrey();
    endGrey();
}

}  // namespace worldy::ui
