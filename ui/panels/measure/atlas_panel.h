// The Atlas panel: a survey of the whole planet as a map, its distribution and its worst viewpoints.
#pragma once

#include <cstddef>
#include <optional>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct AtlasPanelState {
    int viewpoints = 1000;               // of the next survey
    bool measuresError = false;          // of the next survey
    bool withCurrentSettings = false;    // surveys again with them
    std::optional<std::size_t> shown{};  // the viewpoint that was looked from
};

void atlasPanel(const EditorView& view, AtlasPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
