// The lines that are drawn over the planet: bounding volumes, the chunk under the pointer and the one that is
// selected, and the edges where levels meet. Pure functions, any thread.
#pragma once

#include "planet/gl/draw/debug_shapes.h"
#include "planet/planet.h"
#include "ui/model/editor_view.h"

namespace worldy {

// Of what a selection draws. Eye: to lift outlines off the ground by about a pixel.
planet::Lines overlayLines(const planet::ChunkTree& tree, const planet::Selection& selection,
                           const planet::View& renderView, const ui::ViewSettings& settings);

// Of the chunks that are pointed at and selected; drawn or not, as long as they are resident.
planet::Lines focusLines(const planet::ChunkTree& tree, const ui::ChunkFocus& focus,
                         const planet::View& renderView);

}  // namespace worldy
