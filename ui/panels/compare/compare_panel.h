// Compare: A, which the window shows anyway, beside B, a second planet with settings or a bake of its own.
#pragma once

#include <filesystem>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct ComparePanelState {
    std::filesystem::path flight;  // to measure over; empty: the first there is
    int moments = 12;              // of it
};

void comparePanel(const EditorView& view, ComparePanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace worldy::ui
