// Records the recent updates of the colour clipmap, for the overlay and the figures.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "app/scene/frame_stats.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/gl/draw/planet_renderer.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace worldy {

// The recent updates of one renderer's clipmap.
struct ClipmapTrace {
    struct Filled {
        planet::ClipmapUpdate update;
        double atS = 0;  // LastStep::nowS
    };

    std::optional<int> sizePx{};    // window size of the clipmap; unset while there is no clipmap
    std::int64_t filledTexels = 0;  // texels filled in this frame
    std::deque<Filled> filled{};    // recently filled rectangles, oldest first
};

// Adds the updates of the last draw.
void traceClipmap(const planet::gl::ChunkRenderer& renderer, double nowS, ClipmapTrace& trace);

ClipmapStats clipmapStatsOf(const planet::gl::PlanetRenderer& renderer, const ClipmapTrace& trace);

// Appends the outlines of the windows in the colours of their levels, and the recently filled rectangles,
// which fade out: magenta ones were filled because the view moved, cyan ones because tiles were loaded or
// evicted.
void appendClipmapLines(const planet::gl::ChunkRenderer& renderer, const ClipmapTrace& trace,
                        const planet::ChunkTree& tree, const planet::View& renderView, double nowS,
                        planet::Lines& lines);

}  // namespace worldy
