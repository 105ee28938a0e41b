// Bake: the open file's parameters, what a bake with others would cost, and the bake itself.
#pragma once

#include <filesystem>
#include <optional>

#include "ui/model/editor_view.h"
#include "ui/panels/bake/colour_controls.h"
#include "ui/panels/bake/source_controls.h"
#include "ui/panels/bake/source_preview_box.h"

namespace worldy::ui {

struct BakePanelState {
    std::optional<BakeRequest> edited;  // what the user has chosen; none: as the open file
    std::filesystem::path editedOf;     // the chunk file that was open then
    SourceEdit source;                  // of what was chosen
    ColourEdit colour;
    PreviewBoxState preview;
    std::optional<double> estimateAtS;  // when to ask; none: has been asked
};

// Fills the current window.
void bakePanel(const EditorView& view, BakePanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
