#include "planet/bake/file_report.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "planet/bake/finest_distance.h"
#include "planet/bake/quantise.h"
#include "planet/base/percentile.h"
#include "planet/base/try.h"
#include "planet/source/sample_tiles.h"
#include "planet/sphere/chunk_surface.h"
#include "planet/sphere/geometric_error.h"

namespace planet {

namespace {

// --- reportFile
// -----------------------------------------------------------------------------------------------------

struct LevelTally {
    std::uint64_t chunks = 0;
    std::uint64_t bytes = 0;
    std::vector<float> deltasM;
    double sumTightM = 0;
    float maxTightM = 0;

    void add(float deltaCM, float deltaTightM) {
        deltasM.push_back(deltaCM);
        sumTightM += deltaTightM;
        maxTightM = std::max(maxTightM, deltaTightM);
    }
};

Result<void> tallyChildren(const ChunkFile& file, const ChunkId& parent, BlockLocation block,
                           std::vector<LevelTally>& levels, std::uint64_t& bytesLeft) {
    LevelTally& level = levels[parent.level + 1u];
    level.chunks += quadrantCount;
    level.bytes += block.size;
    TRY(spendOn(file, block, bytesLeft));
    if (parent.level + 1 == leafLevel(file.info().shape)) return {};  // leaves: δc is 0, no index
    TRY_ASSIGN(const auto entries, file.readEntries(parent, block));
    for (const ChunkEntry& entry : entries) level.add(entry.deltaCM, entry.deltaTightM);
    for (std::size_t q = 0; q < entries.size(); ++q) {
        const ChunkId child = childOf(parent, static_cast<int>(q));
        TRY(tallyChildren(file, child, entries[q].children, levels, bytesLeft));
    }
    return {};
}

LevelReport summarise(int level, LevelTally& tally) {
    LevelReport report;
    report.level = level;
    report.chunks = tally.chunks;
    report.bytes = tally.bytes;
    if (tally.deltasM.empty()) return report;
    const auto [least, most] = std::minmax_element(tally.deltasM.begin(), tally.deltasM.end());
    report.minDeltaM = *least;
    report.maxDeltaM = *most;
    report.medianDeltaM = percentileOf(tally.deltasM, 0.5);
    report.p99DeltaM = percentileOf(tally.deltasM, 0.99);
    const auto count = static_cast<double>(tally.deltasM.size());
    report.meanDeltaM = std::accumulate(tally.deltasM.begin(), tally.deltasM.end(), 0.0) / count;
    report.meanTightM = tally.sumTightM / count;
    report.maxTightM = tally.maxTightM;
    return report;
}

// --- verifyFile
// -----------------------------------------------------------------------------------------------------

// The key of an edge of a chunk, the same from both sides: its level, and twice its middle on the cube in
// whole cells.
struct EdgeKey {
    int level;
    glm::i64vec3 middle;
    bool operator==(const EdgeKey&) const = default;
};
struct EdgeHash {
    std::size_t operator()(const EdgeKey& key) const {
        return XXH3_64bits(&key.middle, sizeof key.middle) ^ static_cast<std::size_t>(key.level);
    }
};
struct SeenEdge {
    ChunkId chunk;
    std::uint64_t hash;
};

using ReportProblem = std::function<void(const ChunkId& id, const std::string& what)>;

// Recomputes the tight metric during a depth-first walk of the file, as a bake does: from the finest heights
// of one tile at a time, and by a search if cells are wider than a tile.
class TightVerifier {
public:
    explicit TightVerifier(const ChunkFile& file)
        : file_(file),
          shape_(file.info().shape),
          tileLevel_(tileLevelOf(shape_, std::nullopt)),
          coarsestLevel_(coarsestLevelOfTiles(shape_, tileLevel_)),
          offM_(static_cast<std::size_t>(tileLevel_)),
          missedAtEntry_(static_cast<std::size_t>(leafLevel(shape_)) + 1) {}

    void enter(const ChunkData& chunk) {
        missedAtEntry_[chunk.id.level] = missed_;
        if (chunk.id.level == tileLevel_) {
            finest_.assign(tileSide() * tileSide(), 0);
            inTile_.clear();
        }
        if (chunk.id.level == leafLevel(shape_)) placeLeaf(chunk);
    }

    // Records that a block under the last entered chunk cannot be read.
    void missed() { ++missed_; }

    struct Below {
        double deltaGM = 0;
        float largestTightM = 0;  // of the children
    };
    void leave(const ChunkData& chunk, const Below& below, const ReportProblem& report) {
        const int level = chunk.id.level;
        const bool whole = missed_ == missedAtEntry_[chunk.id.level];
        const Met met{chunk.id, chunk.deltaCM, chunk.deltaTightM, below.largestTightM};
        if (level == leafLevel(shape_) - 1) {
            if (whole) check(met, below.deltaGM, report);
        } else if (level < coarsestLevel_) {
            if (whole) search(chunk, met, report);
        } else if (level < tileLevel_) {
            const double offM = std::exchange(offM_[chunk.id.level], 0);
            if (whole) check(met, offM, report);
        } else if (level < leafLevel(shape_)) {
            inTile_.push_back(met);
        }
        if (level == tileLevel_ && whole) finishTile(chunk.id, report);
    }

private:
    struct Met {
        ChunkId id;
        float deltaCM = 0;
        float deltaTightM = 0;
        float largestOfChildrenM = 0;
    };

    std::size_t tileSide() const { return static_cast<std::size_t>(faceCells(shape_) >> tileLevel_) + 1; }

    void placeLeaf(const ChunkData& leaf) {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const std::uint32_t withinTile = (1u << (leafLevel(shape_) - tileLevel_)) - 1;
        const std::size_t column = (leaf.id.x & withinTile) * (side - 1);
        const std::size_t row = (leaf.id.y & withinTile) * (side - 1);
        for (std::size_t j = 0; j < side; ++j) {
            const auto from = std::span(leaf.heights).subspan(j * side, side);
            const std::size_t to = (row + j) * tileSide() + column;
            std::copy(from.begin(), from.end(), finest_.begin() + static_cast<std::ptrdiff_t>(to));
        }
    }

    void finishTile(const ChunkId& tile, const ReportProblem& report) {
        measureTile(shape_, tile, finest_, scratch_, distances_);
        for (const Met& met : inTile_) check(met, distances_.of(met.id), report);
        const int end = std::min(tileLevel_, leafLevel(shape_) - 1);
        for (int level = coarsestLevel_; level < end; ++level) {
            double& offM = offM_[static_cast<std::size_t>(level)];
            offM = std::max(offM, distances_.above(level));
        }
    }

    // Searches for the chunk's distance. Unreadable blocks are already reported by the walk.
    void search(const ChunkData& chunk, const Met& met, const ReportProblem& report) {
        const Result<double> offM = searchFinestDistance(shape_, chunk, [this](const ChunkData& parent) {
            return file_.readChildren(parent.id, parent.children, parent.heights);
        });
        if (offM) check(met, *offM, report);
    }

    void check(const Met& met, double ownM, const ReportProblem& report) const {
        const float expected = tightMetric(ownM, met.largestOfChildrenM, met.deltaCM);
        if (met.largestOfChildrenM > met.deltaTightM) {
            report(met.id, "the tight metric grows from it to a child");
        }
        if (std::abs(expected - met.deltaTightM) > 1e-6f * expected + 1e-6f) {
            report(met.id,
                   fmt::format("the tight metric is {} m in the file, but the finest heights give {} m",
                               met.deltaTightM, expected));
        }
    }

    const ChunkFile& file_;
    PlanetShape shape_;
    int tileLevel_;
    int coarsestLevel_;
    std::vector<std::int16_t> finest_;          // of the current tile
    std::vector<Met> inTile_;                   // chunks of the tile, except those of the two finest levels
    std::vector<double> offM_;                  // by level above the tile, of the current chunk
    std::uint64_t missed_ = 0;                  // chunks with unreadable children
    std::vector<std::uint64_t> missedAtEntry_;  // by level
    GeometricErrorScratch scratch_;
    TileDistances distances_;
};

class Verifier {
public:
    Verifier(const ChunkFile& file, const HeightSource* source, const VerifyProgressCallback& progress)
        : file_(file),
          source_(source),
          progress_(progress),
          shape_(file.info().shape),
          total_(chunkCountOf(shape_)),
          tight_(file) {}

    Result<VerifyReport> run() {
        for (const Face face : allFaces) {
            const auto root = file_.readRoot(face);
            if (!root) {
                problem(root.error().message);
                continue;
            }
            TRY(visit(*root));
        }
        if (report_.problemCount == 0 && !openEdges_.empty()) {
            problem(fmt::format("{}: {} edges have no chunk on their other side", file_.name(),
                                openEdges_.size()));
        }
        return report_;
    }

private:
    void problem(std::string message) {
        constexpr std::size_t mostKept = 100;
        ++report_.problemCount;
        if (report_.problems.size() < mostKept) report_.problems.push_back(std::move(message));
    }

    void chunkProblem(const ChunkId& id, const std::string& what) {
        problem(fmt::format("{}: chunk {}: {}", file_.name(), toString(id), what));
    }

    Result<void> visit(const ChunkData& chunk) {
        ++report_.chunks;
        if (report_.chunks % 512 == 0 && progress_ && !progress_(report_.chunks, total_)) return cancelled();
        checkBounds(chunk);
        checkEdges(chunk);
        const auto report = [this](const ChunkId& id, const std::string& what) { chunkProblem(id, what); };
        tight_.enter(chunk);
        if (chunk.id.level == leafLevel(shape_)) {
            tight_.leave(chunk, {}, report);
            return source_ != nullptr ? compareWithSource(chunk) : Result<void>{};
        }
        const auto children = file_.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!children) {
            problem(children.error().message);
            tight_.missed();
            tight_.leave(chunk, {}, report);
            return {};
        }
        const double deltaGM = checkError(chunk, *children);
        float largestTightM = 0;
        for (const ChunkData& child : *children) {
            TRY(visit(child));
            largestTightM = std::max(largestTightM, child.deltaTightM);
        }
        tight_.leave(chunk, {deltaGM, largestTightM}, report);
        return {};
    }

    void checkBounds(const ChunkData& chunk) {
        const ChunkBounds bounds = chunkBounds(chunk.id, shape_.radiusM, heightM(shape_, chunk.minStep),
                                               heightM(shape_, chunk.maxStep));
        const FaceSquare square = faceSquareOf(chunk.id);
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const double step = square.side / chunkCells(shape_);
        for (std::size_t i = 0; i < chunk.heights.size(); ++i) {
            const std::int16_t height = chunk.heights[i];
            const std::size_t row = i / side;
            const std::size_t column = i % side;
            const glm::dvec3 direction =
                sphereFromCube(cubePoint(chunk.id.face, square.u + step * static_cast<double>(column),
                                         square.v + step * static_cast<double>(row)));
            if (height < chunk.minStep || height > chunk.maxStep) {
                return chunkProblem(chunk.id, "a height lies outside its recorded extremes");
            }
            // 1 mm covers the rounding of a position at a planet's radius.
            if (distanceM(bounds.box, positionM(shape_, direction, heightM(shape_, height))) > 1e-3) {
                return chunkProblem(chunk.id, "a vertex lies outside its bounding box");
            }
        }
    }

    // Checks the samples of the four edges, each in the direction of increasing cube coordinates, so that
    // both sides agree.
    void checkEdges(const ChunkData& chunk) {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const FaceSquare square = faceSquareOf(chunk.id);
        struct Side {
            double u0, v0, u1, v1;
            std::size_t first, stride;
        };
        const double east = square.u + square.side;
        const double north = square.v + square.side;
        const std::array<Side, 4> sides = {{{square.u, square.v, east, square.v, 0, 1},
                                            {square.u, north, east, north, side * (side - 1), 1},
                                            {square.u, square.v, square.u, north, 0, side},
                                            {east, square.v, east, north, side - 1, side}}};
        std::vector<std::int16_t> samples(side);
        for (const Side& edge : sides) {
            const glm::dvec3 from = cubePoint(chunk.id.face, edge.u0, edge.v0);
            const glm::dvec3 to = cubePoint(chunk.id.face, edge.u1, edge.v1);
            for (std::size_t i = 0; i < side; ++i) samples[i] = chunk.heights[edge.first + i * edge.stride];
            if (std::tie(to.x, to.y, to.z) < std::tie(from.x, from.y, from.z))
                std::reverse(samples.begin(), samples.end());
            const EdgeKey key{chunk.id.level,
                              glm::i64vec3((from + to) * std::ldexp(1.0, chunk.id.level + 1))};
            matchEdge(chunk.id, key, XXH3_64bits(samples.data(), samples.size() * sizeof samples[0]));
        }
    }

    void matchEdge(const ChunkId& id, const EdgeKey& key, std::uint64_t hash) {
        const auto [seen, isFirst] = openEdges_.try_emplace(key, SeenEdge{id, hash});
        if (isFirst) return;
        ++report_.edges;
        if (seen->second.hash != hash) {
            chunkProblem(id,
                         fmt::format("its edge differs from that of chunk {}", toString(seen->second.chunk)));
        }
        openEdges_.erase(seen);
    }

    // Verifies the chunk's errors and returns its δg.
    double checkError(const ChunkData& chunk, const std::array<ChunkData, quadrantCount>& children) {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const std::size_t refinedSide = 2 * side - 1;
        std::vector<std::int16_t> refined(refinedSide * refinedSide);
        float childrenDeltaM = 0;
        for (std::size_t q = 0; q < children.size(); ++q) {
            const ChunkData& child = children[q];
            childrenDeltaM = std::max(childrenDeltaM, child.deltaCM);
            if (child.minStep < chunk.minStep || child.maxStep > chunk.maxStep) {
                chunkProblem(child.id, "its extremes reach beyond its parent's");
            }
            placeQuarter(child.heights, chunkCells(shape_), static_cast<int>(q), refined);
        }
        if (childrenDeltaM > chunk.deltaCM) chunkProblem(chunk.id, "delta_c grows from it to a child");
        const double deltaGM = geometricErrorM(shape_, chunk.id, refined, scratch_);
        const double expected = deltaGM + childrenDeltaM;
        if (std::abs(expected - chunk.deltaCM) > 1e-6 * expected + 1e-6) {
            chunkProblem(chunk.id, fmt::format("delta_c is {} m in the file, but its heights give {} m",
                                               chunk.deltaCM, expected));
        }
        return deltaGM;
    }

    Result<void> compareWithSource(const ChunkData& chunk) {
        const SampleTile tile = tileOf(shape_, chunk.id);
        std::vector<float> heights(chunk.heights.size());
        std::vector<std::int16_t> steps(chunk.heights.size());
        TRY(source_->sample(tile, heights));
        TRY(quantise(shape_, *source_, heights, steps));
        report_.leafSamples += steps.size();
        int largest = 0;
        for (std::size_t i = 0; i < steps.size(); ++i)
            largest = std::max(largest, std::abs(steps[i] - chunk.heights[i]));
        if (largest > 0) {
            ++report_.sourceProblems;
            chunkProblem(chunk.id, fmt::format("its heights differ from the source by up to {} m",
                                               largest * shape_.quantumM));
        }
        return {};
    }

    const ChunkFile& file_;
    const HeightSource* source_;
    const VerifyProgressCallback& progress_;
    PlanetShape shape_;
    std::uint64_t total_;
    VerifyReport report_;
    TightVerifier tight_;
    GeometricErrorScratch scratch_;
    std::unordered_map<EdgeKey, SeenEdge, EdgeHash> openEdges_;  // edges that have been seen from one side
};

}  // namespace

Result<FileReport> reportFile(const ChunkFile& file) {
    const PlanetShape& shape = file.info().shape;
    std::vector<LevelTally> tallies(static_cast<std::size_t>(leafLevel(shape)) + 1);
    std::uint64_t bytesLeft = file.sizeBytes();
    for (const Face face : allFaces) {
        TRY_ASSIGN(const auto root, file.readRoot(face));
        ++tallies[0].chunks;
        tallies[0].bytes += file.info().roots[static_cast<std::size_t>(face)].size;
        tallies[0].add(root.deltaCM, root.deltaTightM);
        if (leafLevel(shape) == 0) continue;
        TRY(tallyChildren(file, root.id, root.children, tallies, bytesLeft));
    }
    FileReport report;
    report.fileBytes = file.sizeBytes();
    report.finestSamples = sampleCountOf(shape);
    std::uint64_t heightBytes = chunkFileHeaderBytes;
    for (int level = 0; level <= leafLevel(shape); ++level) {
        report.levels.push_back(summarise(level, tallies[static_cast<std::size_t>(level)]));
        heightBytes += report.levels.back().bytes;
    }
    report.bitsPerFinestSample =
        8 * static_cast<double>(heightBytes) / static_cast<double>(report.finestSamples);
    return report;
}

Result<VerifyReport> verifyFile(const ChunkFile& file, const HeightSource* source,
                                const VerifyProgressCallback& progress) {
    return Verifier(file, source, progress).run();
}

Result<ProbeReport> probeFile(const ChunkFile& file, const Geographic& place) {
    const PlanetShape& shape = file.info().shape;
    ProbeReport report;
    report.place = facePointFromDirection(directionFromGeographic(place));
    TRY_ASSIGN(ChunkData chunk, file.readRoot(report.place.face));
    for (;;) {
        const FaceSquare square = faceSquareOf(chunk.id);
        const int cells = chunkCells(shape);
        const double step =
            stepOnTriangles(chunk.heights, cells, (report.place.u - square.u) / square.side * cells,
                            (report.place.v - square.v) / square.side * cells);
        report.heightM = shape.baseHeightM + step * shape.quantumM;
        const double lowest = heightM(shape, chunk.minStep);
        const double highest = heightM(shape, chunk.maxStep);
        report.chain.push_back({chunk.id, chunk.deltaCM, chunk.deltaTightM, lowest, highest, report.heightM,
                                chunkBounds(chunk.id, shape.radiusM, lowest, highest)});
        if (chunk.id.level == leafLevel(shape)) return report;
        TRY_ASSIGN(auto children, file.readChildren(chunk.id, chunk.children, chunk.heights));
        const ChunkId next = chunkAt(report.place, chunk.id.level + 1);
        chunk = std::move(children[static_cast<std::size_t>(quadrantOf(next))]);
    }
}

}  // namespace planet
