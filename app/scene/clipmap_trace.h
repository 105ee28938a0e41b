// Keeps a renderer's clipmap of colours in step with the settings, and remembers what was filled lately, for
// the overlay. Wants a current GL context.
#pragma once

#include <deque>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "planet/gl/draw/chunk_renderer.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"
#include "ui/model/frame_stats.h"

namespace worldy {

// Of one renderer.
struct ClipmapTrace {
    struct Filled {
        planet::ClipmapUpdate update;
        double atS = 0;  // Planet::seconds()
    };

    std::optional<int> sizePx{};    // last asked for; none: no clipmap
    std::string problem{};          // why there is none though it was asked for
    std::int64_t filledTexels = 0;  // in this frame
    std::deque<Filled> filled{};    // lately, oldest first
};

// Makes, moves or ends it, between ChunkRenderer::followColours and draw. A size that cannot be had is tried
// again only when it changes.
void moveClipmap(planet::gl::ChunkRenderer& renderer, std::optional<int> sizePx, const glm::dvec3& eyeM,
                 int finestLevel, double nowS, ClipmapTrace& trace);

ui::ClipmapStats clipmapStatsOf(const planet::gl::ChunkRenderer& renderer, const ClipmapTrace& trace);

// The windows' outlines on the ground in the colours of their levels, and what was filled in the last
// seconds, fading: magenta came in by moving, cyan because tiles came or went.
void appendClipmapLines(const planet::gl::ChunkRenderer& renderer, const ClipmapTrace& trace,
                        const planet::ChunkTree& tree, const planet::View& renderView, double nowS,
                        planet::Lines& lines);

}  // namespace worldy
