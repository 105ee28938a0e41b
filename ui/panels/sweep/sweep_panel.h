// Sweep: many tolerances over one flight, what each costs beside its true error, and which one to take.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "planet/bake/bake.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct SweepPanelState {
    std::string flight;  // a file; empty: the first that there is
    std::array<char, 192> taus{"0.5 1 2 4 8"};
    // Of planet::chunkSizes; none before a planet was seen, and then its own.
    std::optional<std::array<bool, planet::chunkSizes.size()>> chunks;
    bool additive = true;
    bool tight = true;
    int frames = 12;      // moments, [1, 100]
    int pictureSize = 0;  // the viewport's, or one of a list
    SweepCost cost = SweepCost::Triangles;
    int goal = 0;                                      // the error, triangles, frame time, memory
    std::array<double, 4> limits{1, 200'000, 16, 64};  // px, triangles, ms, MiB
    std::optional<std::size_t> selected;               // of the table's points
};

void sweepPanel(const EditorView& view, SweepPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
