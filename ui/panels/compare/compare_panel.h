// The Compare panel: compares A, the planet that the window shows, with B, a second planet with its own
// settings or bake.
#pragma once

#include <filesystem>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct ComparePanelState {
    std::filesystem::path flight;  // the flight to measure; empty: the first available
    int moments = 12;              // sample frames of the flight
};

void comparePanel(const EditorView& view, ComparePanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace worldy::ui
