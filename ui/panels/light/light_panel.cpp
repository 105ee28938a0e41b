#include "ui/panels/light/light_panel.h"

#include "ui/kit/feature_control.h"
#include "ui/kit/widgets.h"
#include "ui/panels/light/air_controls.h"
#include "ui/panels/light/normal_controls.h"
#include "ui/panels/light/sun_controls.h"

namespace worldy::ui {

namespace {

void lightControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface,
                   Commands& commands) {
    control(surface.lighting);
    control(surface.light.fill);
    featureControl(control, CostlyPart::Detail, view, surface, commands);
}

void seaControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface,
                 Commands& commands) {
    featureControl(control, CostlyPart::Sea, view, surface, commands);
    control(surface.light.sea.windMps);
    control(surface.light.sea.waves);
    control(surface.light.sea.clarityM);
}

void shadowControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface,
                    Commands& commands) {
    featureControl(control, CostlyPart::Shadows, view, surface, commands);
    control(surface.light.shadows.mapSizePx);
    control(surface.light.shadows.reachM);
    control(surface.light.shadows.softness);
}

}  // namespace

void lightPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    const SettingControls control(settings);
    SurfaceSettings& surface = settings.surface;
    if (section("Sun")) sunControls(view, control, surface);
    if (section("Light")) lightControls(view, control, surface, commands);
    if (section("Normals")) normalControls(view, control, settings, commands);
    if (section("Atmosphere")) airControls(view, control, surface, commands);
    if (section("Water")) seaControls(view, control, surface, commands);
    if (section("Shadows")) shadowControls(view, control, surface, commands);
}

}  // namespace worldy::ui
