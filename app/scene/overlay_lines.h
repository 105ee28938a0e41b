// The lines drawn over the planet: bounding volumes, outlines of the hovered and the selected chunk, and LOD
// seams. Pure functions, any thread.
#pragma once

#include <optional>

#include "app/settings/view_settings.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/planet.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

// Names the chunks that the user has selected and points at.
struct ChunkFocus {
    std::optional<planet::ChunkId> selected;
    std::optional<planet::ChunkId>
        hovered;  // the chunk under the pointer in the viewport or the net, one frame ago
};

// Returns the lines of a selection. Outlines are lifted off the ground by about two pixels of renderView.
planet::Lines overlayLines(const planet::ChunkTree& tree, const planet::Selection& selection,
                           const planet::View& renderView, const ViewSettings& settings);

// Returns the outlines of the hovered and the selected chunk if they are resident, whether drawn or not.
planet::Lines focusLines(const planet::ChunkTree& tree, const ChunkFocus& focus,
                         const planet::View& renderView);

}  // namespace worldy
