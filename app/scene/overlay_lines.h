// The lines that are drawn over the planet: bounding volumes, the chunk under the pointer and the one that is
// selected, and the edges where levels meet. Pure functions, any thread.
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
    std::optional<planet::ChunkId> hovered;  // under the pointer in the viewport or the net, one frame ago
};

// Of what a selection draws. Eye: to lift outlines off the ground by about a pixel.
planet::Lines overlayLines(const planet::ChunkTree& tree, const planet::Selection& selection,
                           const planet::View& renderView, const ViewSettings& settings);

// Of the chunks that are pointed at and selected; drawn or not, as long as they are resident.
planet::Lines focusLines(const planet::ChunkTree& tree, const ChunkFocus& focus,
                         const planet::View& renderView);

}  // namespace worldy
