// Remembers what was filled lately in a renderer's clipmap of colours, for the overlay and the figures.
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

// Of one renderer.
struct ClipmapTrace {
    struct Filled {
        planet::ClipmapUpdate update;
        double atS = 0;  // LastStep::nowS
    };

    std::optional<int> sizePx{};    // of the clipmap that was filled; none: there is none
    std::int64_t filledTexels = 0;  // in this frame
    std::deque<Filled> filled{};    // lately, oldest first
};

// Adds what the last draw filled, at nowS.
void traceClipmap(const planet::gl::ChunkRenderer& renderer, double nowS, ClipmapTrace& trace);

ClipmapStats clipmapStatsOf(const planet::gl::PlanetRenderer& renderer, const ClipmapTrace& trace);

// The windows' outlines on the ground in the colours of their levels, and what was filled in the last
// seconds, fading: magenta came in by moving, cyan because tiles came or went.
void appendClipmapLines(const planet::gl::ChunkRenderer& renderer, const ClipmapTrace& trace,
                        const planet::ChunkTree& tree, const planet::View& renderView, double nowS,
                        planet::Lines& lines);

}  // namespace worldy
