// The Quadtree panel: every node is a square on the six faces of an unfolded cube, and a row of a tree list.
#pragma once

#include <optional>
#include <vector>

#include "app/scene/region_lines.h"
#include "ui/model/editor_view.h"
#include "ui/panels/lod/quadtree_net.h"

namespace worldy::ui {

struct QuadtreePanelState {
    int colourBy = 0;       // NetColour: state, level, eps / tau, delta_c, age, tight, region
    NetFocus focus;         // the part of the net in view
    bool showTree = true;   // the list beside the net
    OpenChunks open;        // the chunks opened in the list
    bool dragging = false;  // the net is being moved; releasing the button selects nothing
    std::optional<planet::ChunkId> followed;  // the selection that the list has scrolled to
    Rect area{0, 0, 300, 225};                // where the net was last drawn
    RegionOutlines regionOutlines;            // as last drawn
    std::vector<NetRect> rects;               // kept between frames only to reuse the memory
};

// Fills the current window.
void quadtreePanel(const EditorView& view, QuadtreePanelState& state, ViewSettings& settings,
                   Commands& commands);

}  // namespace worldy::ui
