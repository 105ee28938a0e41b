// The Bake panel: the open file's parameters, the estimated cost of a bake with other settings, and the bake
// itself.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "ui/model/editor_view.h"
#include "ui/panels/bake/colour_controls.h"
#include "ui/panels/bake/source_controls.h"
#include "ui/panels/bake/source_preview_box.h"

namespace worldy::ui {

struct BakePanelState {
    std::optional<BakeRequest> edited;  // the user's bake settings; none: those of the open file
    std::filesystem::path editedOf;     // the chunk file that was open when they were edited
    SourceEdit source;                  // the source of those settings
    ColourEdit colour;
    PreviewBoxState preview;
    std::optional<double> estimateAtS;  // when to request an estimate; none: already requested
    std::array<char, 512> launcher{};   // the command that starts bakes on several ranks; empty: none
};

// Fills the current window.
void bakePanel(const EditorView& view, BakePanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
