// The Sweep panel: measures many tolerances over one flight, shows cost and true error, and suggests a
// tolerance.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "planet/bake/bake.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct SweepPanelState {
    std::string flight;  // a file; empty: the first available
    std::array<char, 192> taus{"0.5 1 2 4 8"};
    // Flags for planet::chunkSizes. None until a planet is open; then only its own size is set.
    std::optional<std::array<bool, planet::chunkSizes.size()>> chunks;
    bool additive = true;
    bool tight = true;
    int frames = 12;      // sample frames, [1, 100]
    int pictureSize = 0;  // 0: the viewport's; otherwise an index into a list
    SweepCost cost = SweepCost::Triangles;
    int goal = 0;                                      // limit kept: error, triangles, frame time, memory
    std::array<double, 4> limits{1, 200'000, 16, 64};  // px, triangles, ms, MiB
    std::optional<std::size_t> selected;               // index of a point of the table
};

void sweepPanel(const EditorView& view, SweepPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
