#include "planet/bake/colour_report.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "planet/bake/colour_tile_sampling.h"
#include "planet/base/parallel.h"
#include "planet/base/try.h"
#include "planet/format/colour_tile.h"

namespace planet {

namespace {

constexpr std::size_t mostColourProblems = 100;

Result<void> tallyChildren(const ChunkFile& file, const ChunkId& parent, BlockLocation block,
                           std::vector<ColourLevelReport>& levels, std::uint64_t& bytesLeft) {
    ColourLevelReport& level = levels[parent.level + 1u];
    level.tiles += quadrantCount;
    level.bytes += block.size;
    TRY(spendOn(file, block, bytesLeft));
    if (level.level == file.info().colour->leafLevel) return {};
    TRY_ASSIGN(const auto entries, file.readColourEntries(parent, block));
    for (std::size_t q = 0; q < entries.size(); ++q) {
        if (!entries[q].children.exists()) continue;
        const ChunkId child = childOf(parent, static_cast<int>(q));
        TRY(tallyChildren(file, child, entries[q].children, levels, bytesLeft));
    }
    return {};
}

// The key of an edge between two tiles of a face: the face, the level, whether it runs along v, and its place
// on the grid.
using TileEdge = std::tuple<Face, int, bool, std::uint32_t, std::uint32_t>;

struct SeenTileEdge {
    ChunkId tile;
    std::uint64_t hash;
};

// Returns the hash of the decoded texels on an edge.
std::uint64_t hashOfEdge(std::span<const std::uint8_t> rgb, Edge edge) {
    const bool upright = edge == Edge::West || edge == Edge::East;
    const int across = edge == Edge::East || edge == Edge::North ? colourTileCells : 0;
    std::vector<std::uint8_t> texels;
    for (int along = 0; along <= colourTileCells; ++along) {
        const int column = colourBorderBefore + (upright ? across : along);
        const int row = colourBorderBefore + (upright ? along : across);
        const auto at = 3 * static_cast<std::size_t>(row * colourTileTexels + column);
        texels.insert(texels.end(), rgb.begin() + static_cast<std::ptrdiff_t>(at),
                      rgb.begin() + static_cast<std::ptrdiff_t>(at + 3));
    }
    return XXH3_64bits(texels.data(), texels.size());
}

// Verifies the tiles of one face.
class ColourVerifier {
public:
    ColourVerifier(const ChunkFile& file, const ColourSource* source, const std::function<bool()>& goOn)
        : file_(file), colour_(*file.info().colour), source_(source), goOn_(goOn) {}

    Result<ColourVerifyReport> run(Face face) {
        if (const auto root = file_.readColourRoot(face)) {
            TRY(visit(*root));
        } else {
            problem(root.error().message);
        }
        return report_;
    }

private:
    Result<void> visit(const TileData& tile) {
        if (!goOn_()) return cancelled();
        ++report_.tiles;
        const std::vector<std::uint8_t> rgb = rgbOfColourTexels(colour_.format, tile.texels);
        for (const Edge edge : allEdges) checkEdge(tile.id, edge, rgb);
        if (source_) {
            TRY(compare(tile));
        }
        if (!tile.children.exists()) return {};
        const auto children = file_.readColourChildren(tile.id, tile.children);
        if (!children) {
            problem(children.error().message);
            return {};
        }
        for (const TileData& child : *children) {
            TRY(visit(child));
        }
        return {};
    }

    void checkEdge(const ChunkId& id, Edge edge, std::span<const std::uint8_t> rgb) {
        const bool upright = edge == Edge::West || edge == Edge::East;
        const std::uint32_t x = id.x + (edge == Edge::East ? 1 : 0);
        const std::uint32_t y = id.y + (edge == Edge::North ? 1 : 0);
        const std::uint32_t across = upright ? x : y;
        if (across == 0 || across == 1u << id.level) return;  // a face's own edge
        const std::uint64_t hash = hashOfEdge(rgb, edge);
        const auto [seen, isFirst] =
            open_.try_emplace(TileEdge{id.face, id.level, upright, x, y}, SeenTileEdge{id, hash});
        if (isFirst) return;
        ++report_.edges;
        if (seen->second.hash != hash) {
            problem(fmt::format("{}: the colours of tiles {} and {} differ along the edge they share",
                                file_.name(), toString(seen->second.tile), toString(id)));
        }
        open_.erase(seen);
    }

    Result<void> compare(const TileData& tile) {
        std::vector<std::uint8_t> rgb(colourTileBytes(ColourFormat::Lossless));
        TRY(sampleColourTile(*source_, tile.id, rgb));
        ++report_.compared;
        if (colourTexels(colour_.format, rgb) != tile.texels) {
            ++report_.sourceProblems;
            problem(fmt::format("{}: the colours of tile {} are not those of {}", file_.name(),
                                toString(tile.id), source_->description));
        }
        return {};
    }

    void problem(std::string what) {
        ++report_.problemCount;
        if (report_.problems.size() < mostColourProblems) report_.problems.push_back(std::move(what));
    }

    const ChunkFile& file_;
    const ColourPyramid& colour_;
    const ColourSource* source_;
    const std::function<bool()>& goOn_;
    std::map<TileEdge, SeenTileEdge> open_;
    ColourVerifyReport report_;
};

}  // namespace

Result<std::vector<ColourLevelReport>> reportColours(const ChunkFile& file) {
    assert(file.info().colour);
    const ColourPyramid& colour = *file.info().colour;
    std::vector<ColourLevelReport> levels(static_cast<std::size_t>(colour.leafLevel) + 1);
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i].level = static_cast<int>(i);
    std::uint64_t bytesLeft = file.sizeBytes();
    for (const Face face : allFaces) {
        const BlockLocation block = colour.roots[static_cast<std::size_t>(face)];
        levels[0].tiles += 1;
        levels[0].bytes += block.size;
        TRY_ASSIGN(const auto root, file.readColourRoot(face));
        if (!root.children.exists()) continue;
        TRY(tallyChildren(file, root.id, root.children, levels, bytesLeft));
    }
    return levels;
}

Result<ColourVerifyReport> verifyColours(const ChunkFile& file, const ColourSource* source,
                                         const std::function<bool()>& goOn) {
    assert(file.info().colour);
    std::atomic<bool> isStopped = false;
    const std::function<bool()> allGoOn = [&] { return !isStopped && (!goOn || goOn()); };
    std::array<Result<ColourVerifyReport>, faceCount> faces;
    std::mutex mutex;  // of the error
    std::optional<Error> error;
    parallelFor(faceCount, [&](std::size_t i) {
        faces[i] = ColourVerifier(file, source, allGoOn).run(allFaces[i]);
        if (faces[i]) return;
        const std::lock_guard lock(mutex);
        if (!error) error = faces[i].error();
        isStopped = true;
    });
    if (error) return tl::unexpected(*error);
    ColourVerifyReport report;
    for (const Result<ColourVerifyReport>& face : faces) {
        report.tiles += face->tiles;
        report.edges += face->edges;
        report.compared += face->compared;
        report.problemCount += face->problemCount;
        report.sourceProblems += face->sourceProblems;
        report.problems.insert(report.problems.end(), face->problems.begin(), face->problems.end());
    }
    report.problems.resize(std::min(report.problems.size(), mostColourProblems));
    return report;
}

}  // namespace planet
