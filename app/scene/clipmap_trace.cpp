#include "app/scene/clipmap_trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/scene/overlay_colours.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/surface/colour_clipmap.h"

namespace worldy {

namespace {

constexpr double shownS = 2;            // time for which a filled rectangle is shown
constexpr std::size_t mostShown = 400;  // rectangles shown at once; the oldest are dropped first
constexpr int sideSegments = 48;        // segments per side of a window, so that it follows the ground

using planet::TexelRect;

// Draws lines between texels of a face on the ground, lifted by 3 px so that the ground does not hide them.
struct GroundLines {
    const planet::ChunkTree& tree;
    const planet::View& view;
    planet::Face face;
    int level;
    planet::Lines& lines;

    glm::dvec3 pointM(double x, double y) const {
        const double cells = planet::colourTileCells << level;
        const auto coordinate = [&](double texel) { return 2 * std::clamp(texel / cells, 0.0, 1.0) - 1; };
        const glm::dvec3 direction =
            planet::sphereFromCube(planet::cubePoint(face, coordinate(x), coordinate(y)));
        const double heightM = planet::residentHeightM(tree, direction);
        const glm::dvec3 groundM = planet::positionM(tree.shape, direction, heightM);
        const double awayM = glm::length(groundM - view.eyeM);
        return groundM + 3 * awayM / planet::screenScalePx(view) * direction;
    }

    void append(const glm::dvec2& from, const glm::dvec2& to, const planet::LineColour& colour) const {
        const double cells = planet::colourTileCells << level;
        const double share = glm::length(to - from) / cells;  // of a face
        const int segments =
            std::clamp(static_cast<int>(std::ceil(share * 4 * sideSegments)), 4, sideSegments);
        glm::dvec3 before = pointM(from.x, from.y);
        for (int i = 1; i <= segments; ++i) {
            const glm::dvec2 at = from + (to - from) * (static_cast<double>(i) / segments);
            const glm::dvec3 now = pointM(at.x, at.y);
            lines.push_back({before, colour});
            lines.push_back({now, colour});
            before = now;
        }
    }
};

// Omits sides on the edge of a face, because the window continues on the next face.
void appendOutline(const GroundLines& ground, const TexelRect& texels, const planet::LineColour& colour) {
    const int cells = planet::colourTileCells << ground.level;
    const double left = texels.x;
    const double right = texels.x + texels.width - 1;
    const double bottom = texels.y;
    const double top = texels.y + texels.height - 1;
    if (left > 0) ground.append({left, bottom}, {left, top}, colour);
    if (right < cells) ground.append({right, bottom}, {right, top}, colour);
    if (bottom > 0) ground.append({left, bottom}, {right, bottom}, colour);
    if (top < cells) ground.append({left, top}, {right, top}, colour);
}

// Hatches a long strip with bars across its shorter side.
void appendBars(const GroundLines& ground, const TexelRect& texels, const planet::LineColour& colour) {
    const double right = texels.x + texels.width - 1;
    const double top = texels.y + texels.height - 1;
    const int longest = std::max(texels.width, texels.height);
    const int shortest = std::min(texels.width, texels.height);
    if (4 * shortest > longest) return;
    const int apart = std::max({shortest, longest / 32, 1});
    for (int along = apart; along < longest; along += apart) {
        if (texels.width >= texels.height)
            ground.append({texels.x + along, texels.y}, {texels.x + along, top}, colour);
        else
            ground.append({texels.x, texels.y + along}, {right, texels.y + along}, colour);
    }
}

planet::LineColour filledColour(const planet::ClipmapUpdate& update, double ageS) {
    const double strength = std::clamp(1 - ageS / shownS, 0.0, 1.0);
    const auto opacity = static_cast<std::uint8_t>(std::lround(220 * strength));
    return update.byMoving ? planet::LineColour{255, 60, 220, opacity}
                           : planet::LineColour{70, 230, 255, opacity};
}

void remember(const planet::gl::ColourClipmapState& state, double nowS, ClipmapTrace& trace) {
    trace.filledTexels += state.updatedTexels;
    for (const planet::ClipmapUpdate& update : state.updates) {
        // Levels that are resident as a whole have no windows.
        if (update.level > state.layout.wholeLevel) trace.filled.push_back({update, nowS});
    }
    while (!trace.filled.empty() &&
           (trace.filled.size() > mostShown || nowS - trace.filled.front().atS > shownS))
        trace.filled.pop_front();
}

}  // namespace

void traceClipmap(const planet::gl::ChunkRenderer& renderer, double nowS, ClipmapTrace& trace) {
    const planet::gl::ColourClipmapState* state = renderer.colourClipmap();
    const std::optional<int> sizePx = state ? std::optional(state->layout.sizePx) : std::nullopt;
    if (std::exchange(trace.sizePx, sizePx) != sizePx) trace.filled.clear();
    if (state) remember(*state, nowS, trace);
}

ClipmapStats clipmapStatsOf(const planet::gl::PlanetRenderer& renderer, const ClipmapTrace& trace) {
    ClipmapStats stats;
    stats.problem = renderer.clipmapProblem();
    const planet::gl::ColourClipmapState* state = renderer.chunks().colourClipmap();
    if (!state) return stats;
    stats.windows = static_cast<int>(state->windows.size());
    stats.wholeLevel = state->layout.wholeLevel;
    stats.filledTexels = trace.filledTexels;
    return stats;
}

void appendClipmapLines(const planet::gl::ChunkRenderer& renderer, const ClipmapTrace& trace,
                        const planet::ChunkTree& tree, const planet::View& renderView, double nowS,
                        planet::Lines& lines) {
    const planet::gl::ColourClipmapState* state = renderer.colourClipmap();
    if (!state) return;
    for (const ClipmapTrace::Filled& filled : trace.filled) {
        const double ageS = nowS - filled.atS;
        if (ageS > shownS) continue;
        const planet::LineColour colour = filledColour(filled.update, ageS);
        const GroundLines ground{tree, renderView, filled.update.face, filled.update.level, lines};
        appendOutline(ground, filled.update.texels, colour);
        appendBars(ground, filled.update.texels, colour);
    }
    // Outlines come last, on top of rectangles that fill a whole window.
    for (const planet::gl::ColourClipmapState::Window& window : state->windows) {
        appendOutline({tree, renderView, window.face, window.level, lines}, window.texels,
                      colourBytes(levelColour(window.level), 255));
    }
}

}  // namespace worldy
