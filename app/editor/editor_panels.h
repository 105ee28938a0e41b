// Draws the panels around the planet's pictures.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "app/editor/viewport.h"
#include "app/editor/window_controller.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/settings/settings.h"
#include "planet/tree/region.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/layout.h"
#include "ui/panels/lod/regions_panel.h"
#include "ui/shell/open_dialog.h"

namespace worldy {

// The state that the panels show and edit.
struct PanelContext {
    const Session& session;
    const ui::EditorView& view;
    const ui::Layout& layout;
    Settings& settings;
    Viewport& viewport;
    ui::OpenDialogState& openDialog;
    Notices& notices;
};

// Returns a region with what the brush of the Regions panel would add at the ground under the pointer, if there is any; none
// if the brush is off.
std::optional<planet::Region> regionDraft(const ui::RegionsPanelState& state, const Settings& settings,
                                          const std::optional<glm::dvec3>& groundM);

void drawPanels(WindowController& window, const PanelContext& context, ui::Commands& commands);

}  // namespace worldy
