// Quadtree: the six faces as an unfolded cube net, every node a square, and the same as a tree list.
#pragma once

#include <optional>
#include <vector>

#include "ui/model/editor_view.h"
#include "ui/panels/lod/quadtree_net.h"

namespace worldy::ui {

struct QuadtreePanelState {
    int colourBy = 0;                         // NetColour: state, level, eps / tau, delta_c, age, tight
    NetFocus focus;                           // what part of the net is seen
    bool showTree = true;                     // the list beside the net
    OpenChunks open;                          // in the list
    bool dragging = false;                    // the net is being moved, so that letting go selects nothing
    std::optional<planet::ChunkId> followed;  // the selection that the list has scrolled to
    Rect area{0, 0, 300, 225};                // where the net was last drawn
    std::vector<NetRect> rects;               // kept from frame to frame for their memory alone
};

// Fills the current window.
void quadtreePanel(const EditorView& view, QuadtreePanelState& state, ViewSettings& settings,
                   Commands& commands);

}  // namespace worldy::ui
