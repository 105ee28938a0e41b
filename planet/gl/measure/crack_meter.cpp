#include "planet/gl/measure/crack_meter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>

#include "planet/gl/device/keep_framebuffers.h"
#include "planet/gl/device/render_target.h"
#include "planet/measure/seen_mesh.h"
#include "planet/select/drawn_surface.h"

namespace planet::gl {

namespace {

constexpr std::uint32_t nothing = ~std::uint32_t{0};
constexpr double noGround = std::numeric_limits<double>::infinity();

// Returns whether a is nearer than b by more than the rasteriser's rounding of one place. Each distance is
// rounded to 24 bits once when it is stored and about three times during transformation and interpolation. A
// non-reversed depth buffer stores values near 1, so the relative error grows with the distance.
bool isNearer(double aM, double bM, const Projection& projection) {
    double share = 8.0 / (1 << 24);
    if (!projection.reversedZ) share *= std::max(aM / projection.nearM, 1.0);
    return aM * (1 + share) < bM;
}

// The picture of a pass, rows from the top.
struct Pass {
    std::vector<std::uint32_t> item;  // nothing: no ground
    std::vector<double> distanceM;    // along the view's direction; infinity: no ground
};

ChunkTint tintOf(std::size_t index) {
    const auto byte = [&](int shift) { return static_cast<std::uint8_t>(index >> shift & 0xFF); };
    return {{byte(16), byte(8), byte(0), 255}};
}

RenderSettings passSettings(bool stitched) {
    RenderSettings settings;
    settings.surface = SurfaceColour::HeightRamp;
    settings.sea = false;
    settings.stitched = stitched;
    settings.atmosphere = false;
    settings.lighting = false;
    settings.detail = FeatureUse::Off;
    return settings;
}

Result<Pass> drawPass(ChunkRenderer& renderer, const View& view, std::span<const DrawItem> items,
                      bool stitched) {
    assert(items.size() < (std::size_t{1} << 24));
    std::vector<ChunkTint> tints;
    for (std::size_t i = 0; i < items.size(); ++i) tints.push_back(tintOf(i));
    const Result<RenderTarget> target = RenderTarget::create(view.widthPx, view.heightPx);
    if (!target) return tl::unexpected(target.error());
    target->bind();
    renderer.draw(view, items, passSettings(stitched), tints);
    const std::vector<std::uint8_t> rgb = target->readRgb();
    const std::vector<float> depth = target->readDepth();
    const Projection& projection = renderer.projection();
    const float cleared = projection.reversedZ ? 0 : 1;
    Pass pass;
    pass.item.reserve(depth.size());
    pass.distanceM.reserve(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const bool ground = depth[i] != cleared;
        const auto byte = [&](std::size_t channel) { return std::uint32_t{rgb[3 * i + channel]}; };
        const std::uint32_t index = byte(0) << 16 | byte(1) << 8 | byte(2);
        pass.item.push_back(ground ? index : nothing);
        pass.distanceM.push_back(ground ? viewDistanceM(projection, static_cast<double>(depth[i]))
                                        : noGround);
    }
    return pass;
}

Result<Pass> drawPass(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                      float skirtDepthM) {
    std::vector<DrawItem> items(ground.items.begin(), ground.items.end());
    for (DrawItem& item : items) item.skirtDepthM = skirtDepthM;
    return drawPass(renderer, view, items, ground.stitched);
}

// A segment of a chunk's border between two vertices.
struct BorderPiece {
    Edge edge = Edge::West;
    std::size_t from = 0;  // vertices, in the order of the skirts: counter-clockwise from above
    std::size_t to = 0;
};

std::vector<BorderPiece> borderOf(int cells) {
    const auto at = [&](int column, int row) { return static_cast<std::size_t>(row * (cells + 1) + column); };
    std::vector<BorderPiece> pieces;
    for (int i = 0; i < cells; ++i) pieces.push_back({Edge::South, at(i, 0), at(i + 1, 0)});
    for (int i = 0; i < cells; ++i) pieces.push_back({Edge::East, at(cells, i), at(cells, i + 1)});
    for (int i = cells; i > 0; --i) pieces.push_back({Edge::North, at(i, cells), at(i - 1, cells)});
    for (int i = cells; i > 0; --i) pieces.push_back({Edge::West, at(0, i), at(0, i - 1)});
    return pieces;
}

// A drawn chunk in the view: its ground, and its long skirt labelled by border segment.
struct SeenChunk {
    DrawnGrid grid;
    std::vector<BorderPiece> border;
    SeenMesh surface;
    SeenMesh wall;
};

SeenChunk seenChunk(const View& view, const DrawnGround& ground, std::uint32_t index, double shellDepthM) {
    const DrawItem& item = ground.items[index];
    SeenChunk chunk{drawnGrid(ground.shape, item, ground.heights(item), ground.stitched),
                    borderOf(chunkCells(ground.shape)), SeenMesh(view), SeenMesh(view)};
    const std::vector<glm::dvec3>& at = chunk.grid.positionM;
    const auto across = static_cast<std::size_t>(chunk.grid.cells) + 1;
    for (std::size_t southWest = 0; southWest + across + 1 < at.size(); ++southWest) {
        if (southWest % across == across - 1) continue;
        const std::size_t northEast = southWest + across + 1;
        chunk.surface.add({at[southWest], at[southWest + 1], at[northEast]});
        chunk.surface.add({at[southWest], at[northEast], at[southWest + across]});
    }
    const auto below = [&](const glm::dvec3& p) { return p * (1 - shellDepthM / glm::length(p)); };
    for (std::uint32_t i = 0; i < chunk.border.size(); ++i) {
        const glm::dvec3& top = at[chunk.border[i].from];
        const glm::dvec3& nextTop = at[chunk.border[i].to];
        chunk.wall.add({below(top), below(nextTop), nextTop}, i);
        chunk.wall.add({below(top), nextTop, top}, i);
    }
    return chunk;
}

// Verifies crack pixels of one view in doubles. Chunks are computed on first use.
class CrackJudge {
public:
    CrackJudge(const View& view, const DrawnGround& ground, std::span<const DrawnPair> pairs,
               double shellDepthM, const Projection& projection)
        : view_(view),
          ground_(ground),
          pairs_(pairs, ground.items.size()),
          shellDepthM_(shellDepthM),
          projection_(projection) {}

    // Returns the crack at a pixel whose closed pass shows something nearer than the open one; nothing if the
    // difference is only rounding.
    std::optional<CrackPixel> crackAt(int x, int y, std::size_t at, const Pass& closed, const Pass& open) {
        CrackPixel pixel;
        pixel.x = x;
        pixel.y = y;
        pixel.item = closed.item[at];
        pixel.closedM = closed.distanceM[at];
        pixel.openM = open.distanceM[at];
        pixel.wallM = pixel.closedM;
        const SeenChunk& chunk = chunkOf(pixel.item);
        const std::optional<SeenMesh::Hit> wall = chunk.wall.frontAt(x, y);
        if (open.item[at] != nothing) {
            if (!wall) return std::nullopt;
            const double groundM =
                chunkOf(open.item[at]).surface.nearestAtM(x, y).value_or(open.distanceM[at]);
            if (!isNearer(wall->farthestM, groundM, projection_)) return std::nullopt;
        }
        if (wall) place(chunk, *wall, pixel);
        return pixel;
    }

private:
    const SeenChunk& chunkOf(std::uint32_t item) {
        const auto found = chunks_.find(item);
        if (found != chunks_.end()) return found->second;
        return chunks_.emplace(item, seenChunk(view_, ground_, item, shellDepthM_)).first->second;
    }

    void place(const SeenChunk& chunk, const SeenMesh::Hit& wall, CrackPixel& pixel) const {
        const BorderPiece& piece = chunk.border[wall.label];
        const glm::dvec3& from = chunk.grid.positionM[piece.from];
        const glm::dvec3& to = chunk.grid.positionM[piece.to];
        // The position along the edge is measured as seen from the planet's centre, because skirts hang
        // towards it.
        const glm::dvec3 start = glm::normalize(from);
        const glm::dvec3 way = glm::normalize(to) - start;
        const glm::dvec3 seen =
            glm::normalize(SeenMesh::pointAt(view_, pixel.x, pixel.y, wall.distanceM)) - start;
        const double squared = glm::dot(way, way);
        const double share = squared > 0 ? std::clamp(glm::dot(seen, way) / squared, 0.0, 1.0) : 0;
        const bool upright = piece.edge == Edge::West || piece.edge == Edge::East;
        const auto along = [&](std::size_t vertex) {
            const glm::dvec2 place = chunk.grid.place[vertex];
            return (upright ? place.y : place.x) / chunk.grid.cells;
        };
        pixel.wallM = wall.farthestM;
        pixel.placeM = glm::mix(from, to, share);
        pixel.pair = pairs_.at(pixel.item, piece.edge, glm::mix(along(piece.from), along(piece.to), share))
                         .value_or(noPair);
    }

    const View& view_;
    const DrawnGround& ground_;
    PairFinder pairs_;
    double shellDepthM_;
    const Projection& projection_;
    std::unordered_map<std::uint32_t, SeenChunk> chunks_;
};

bool isHidden(const CrackPixel& pixel, const Pass& asSet, std::size_t at, const Projection& projection) {
    if (asSet.item[at] == nothing) return false;
    const double shownM = asSet.distanceM[at];
    if (asSet.item[at] == pixel.item && isNearer(shownM, pixel.openM, projection)) return true;
    return !isNearer(pixel.wallM, shownM, projection);
}

}  // namespace

double innerShellDepthM(const ChunkTree& tree) {
    return tree.shape.radiusM + heightM(tree.shape, tree.maxStep) - tree.occluderRadiusM;
}

Result<CrackMap> findCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                            std::span<const DrawnPair> pairs, double shellDepthM) {
    const KeepFramebuffers keep;
    const Result<Pass> closed = drawPass(renderer, view, ground, static_cast<float>(shellDepthM));
    if (!closed) return tl::unexpected(closed.error());
    const Result<Pass> open = drawPass(renderer, view, ground, 0);
    if (!open) return tl::unexpected(open.error());
    CrackMap map{view.widthPx, view.heightPx, {}, 0};
    CrackJudge judge(view, ground, pairs, shellDepthM, renderer.projection());
    std::size_t at = 0;
    for (int y = 0; y < view.heightPx; ++y) {
        for (int x = 0; x < view.widthPx; ++x, ++at) {
            if (!isNearer(closed->distanceM[at], open->distanceM[at], renderer.projection())) continue;
            if (const auto crack = judge.crackAt(x, y, at, *closed, *open)) map.pixels.push_back(*crack);
        }
    }
    return map;
}

Result<void> findLeaks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground, CrackMap& map) {
    assert(map.widthPx == view.widthPx && map.heightPx == view.heightPx);
    map.leaking = 0;
    if (map.pixels.empty()) return {};
    const KeepFramebuffers keep;
    const Result<Pass> asSet = drawPass(renderer, view, ground.items, ground.stitched);
    if (!asSet) return tl::unexpected(asSet.error());
    for (CrackPixel& pixel : map.pixels) {
        const auto at = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(map.widthPx) +
                        static_cast<std::size_t>(pixel.x);
        pixel.leaks = !isHidden(pixel, *asSet, at, renderer.projection());
        map.leaking += pixel.leaks ? 1 : 0;
    }
    return {};
}

Result<CrackMap> measureCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                               std::span<const DrawnPair> pairs, double shellDepthM) {
    Result<CrackMap> map = findCracks(renderer, view, ground, pairs, shellDepthM);
    if (!map) return map;
    if (Result<void> leaks = findLeaks(renderer, view, ground, *map); !leaks)
        return tl::unexpected(leaks.error());
    return map;
}

}  // namespace planet::gl
