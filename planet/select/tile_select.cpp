#include "planet/select/tile_select.h"

#include <algorithm>
#include <cassert>

#include "planet/select/screen_error.h"
#include "planet/sphere/culling.h"

namespace planet {

namespace {

struct TileFrame {
    const TileTree& tiles;
    const ChunkTree& chunks;
    const TileSettings& settings;
    glm::dvec3 eyeM;
    double scalePx;  // K'
    Culling culling;
};

// Returns the chunk that covers a tile: the one of the same level if it is resident, else its finest resident
// ancestor.
NodeIndex chunkOver(const ChunkTree& chunks, NodeIndex above, const ChunkId& tile) {
    const ChunkNode& node = chunks.nodes[above];
    if (node.id.level >= tile.level || node.childrenState != ChildrenState::Resident) return above;
    return node.firstChild + static_cast<NodeIndex>(quadrantOf(ancestorOf(tile, node.id.level + 1)));
}

ChunkBounds boundsOf(const TileFrame& frame, const TileNode& tile, const ChunkNode& ground) {
    return chunkBounds(tile.directions, frame.chunks.shape.radiusM, static_cast<double>(ground.minHeightM),
                       static_cast<double>(ground.maxHeightM));
}

void visit(const TileFrame& frame, NodeIndex index, NodeIndex chunkAbove, OpenTests open,
           TileSelection& out) {
    const TileNode& tile = frame.tiles.nodes[index];
    ++out.counters.visited;
    out.touched.push_back(index);
    const NodeIndex ground = chunkOver(frame.chunks, chunkAbove, tile.id);
    const ChunkBounds bounds = boundsOf(frame, tile, frame.chunks.nodes[ground]);
    if (cull(frame.culling, bounds, open) != Culled::No) return;
    const double awayM = std::max(distanceM(bounds.box, frame.eyeM), nearestM);
    const double texelsPerPixel = awayM / (texelM(frame.chunks.shape, tile.id.level) * frame.scalePx);
    const auto priority = static_cast<float>(frame.settings.texelsPerPixel / texelsPerPixel);
    const bool wantsFiner = priority > 1 && tile.childrenState != ChildrenState::None;
    if (wantsFiner && tile.childrenState == ChildrenState::Resident) {
        out.splits.push_back({index, tile.id, priority});
        for (NodeIndex q = 0; q < quadrantCount; ++q) visit(frame, tile.firstChild + q, ground, open, out);
        return;
    }
    TileCounters& counters = out.counters;
    counters.deepestLevel = std::max<std::uint32_t>(counters.deepestLevel, tile.id.level);
    const auto texels = static_cast<float>(texelsPerPixel);
    counters.fewestTexelsPerPixel =
        counters.fewestTexelsPerPixel == 0 ? texels : std::min(counters.fewestTexelsPerPixel, texels);
    if (!wantsFiner) return;
    ++counters.waiting;
    if (tile.childrenState != ChildrenState::Failed) out.requests.push_back({index, tile.id, priority});
}

}  // namespace

double texelM(const PlanetShape& shape, int level) {
    return 2 * shape.radiusM / (static_cast<double>(tileCells) * static_cast<double>(1 << level));
}

void selectTiles(const TileTree& tiles, const ChunkTree& chunks, const View& lodView,
                 const TileSettings& settings, const LodSettings& lod, TileSelection& selection) {
    selection.requests.clear();
    selection.splits.clear();
    selection.touched.clear();
    selection.counters = {};
    if (tiles.nodes.empty() || !settings.enabled) return;
    const TileFrame frame{tiles,
                          chunks,
                          settings,
                          lodView.eyeM,
                          screenScalePx(lodView),
                          {frustumOf(lodView), horizonOf(lodView.eyeM, chunks.occluderRadiusM)}};
    const OpenTests all = openTests(lod.frustumCulling, lod.horizonCulling);
    for (NodeIndex root = 0; root < faceCount; ++root) visit(frame, root, root, all, selection);
    std::sort(selection.requests.begin(), selection.requests.end(),
              [](const ChildrenRequest& a, const ChildrenRequest& b) {
                  return a.priority != b.priority ? a.priority > b.priority : a.parentId < b.parentId;
              });
}

}  // namespace planet
