#include "planet/file_report.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "planet/chunk_surface.h"
#include "planet/geometric_error.h"
#include "planet/quantise.h"

namespace planet {

namespace {

std::uint64_t chunkCount(const PlanetShape& shape) {
    std::uint64_t count = 0;
    for (int level = 0; level <= leafLevel(shape); ++level) count += std::uint64_t{faceCount} << (2 * level);
    return count;
}

// --- reportFile
// -----------------------------------------------------------------------------------------------------

struct LevelTally {
    std::uint64_t chunks = 0;
    std::uint64_t bytes = 0;
    std::vector<float> deltasM;
};

Result<void> tallyChildren(const ChunkFile& file, const ChunkId& parent, BlockLocation block,
                           std::vector<LevelTally>& levels) {
    LevelTally& level = levels[parent.level + 1u];
    level.chunks += quadrantCount;
    level.bytes += block.size;
    if (parent.level + 1 == leafLevel(file.info().shape)) return {};  // leaves: delta_c is 0, no index
    const auto entries = file.readEntries(parent, block);
    if (!entries) return tl::unexpected(entries.error());
    for (const ChunkEntry& entry : *entries) level.deltasM.push_back(entry.deltaCM);
    for (std::size_t q = 0; q < entries->size(); ++q) {
        const ChunkId child = childOf(parent, static_cast<int>(q));
        if (auto done = tallyChildren(file, child, (*entries)[q].children, levels); !done) return done;
    }
    return {};
}

LevelReport summarise(int level, LevelTally& tally) {
    LevelReport report{level, tally.chunks, tally.bytes, 0, 0, 0, 0};
    if (tally.deltasM.empty()) return report;
    std::sort(tally.deltasM.begin(), tally.deltasM.end());
    const auto at = [&](double fraction) {
        return tally
            .deltasM[static_cast<std::size_t>(fraction * static_cast<double>(tally.deltasM.size() - 1))];
    };
    report.minDeltaM = tally.deltasM.front();
    report.medianDeltaM = at(0.5);
    report.p99DeltaM = at(0.99);
    report.maxDeltaM = tally.deltasM.back();
    return report;
}

// --- verifyFile
// -----------------------------------------------------------------------------------------------------

// An edge of a chunk, the same key from both its sides: its level and twice its middle on the cube in whole
// cells.
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

class Verifier {
public:
    Verifier(const ChunkFile& file, const HeightSource* source, const VerifyProgressCallback& progress)
        : file_(file),
          source_(source),
          progress_(progress),
          shape_(file.info().shape),
          total_(chunkCount(shape_)) {}

    Result<VerifyReport> run() {
        for (const Face face : allFaces) {
            const auto root = file_.readRoot(face);
            if (!root) {
                problem(root.error().message);
                continue;
            }
            if (auto done = visit(*root); !done) return tl::unexpected(done.error());
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
        if (++report_.chunks % 512 == 0 && progress_ && !progress_(report_.chunks, total_))
            return cancelled();
        checkBounds(chunk);
        checkEdges(chunk);
        if (chunk.id.level == leafLevel(shape_))
            return source_ != nullptr ? compareWithSource(chunk) : Result<void>{};
        const auto children = file_.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!children) {
            problem(children.error().message);
            return {};
        }
        checkError(chunk, *children);
        for (const ChunkData& child : *children) {
            if (auto done = visit(child); !done) return done;
        }
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
            const glm::dvec3 direction =
                sphereFromCube(cubePoint(chunk.id.face, square.u + step * static_cast<double>(i % side),
                                         square.v + step * static_cast<double>(i / side)));
            if (height < chunk.minStep || height > chunk.maxStep) {
                return chunkProblem(chunk.id, "a height lies outside its recorded extremes");
            }
            // A millimetre covers the rounding of a position at a planet's radius.
            if (distanceM(bounds.box, positionM(shape_, direction, heightM(shape_, height))) > 1e-3) {
                return chunkProblem(chunk.id, "a vertex lies outside its bounding box");
            }
        }
    }

    // The four edges' samples, each in the direction in which the cube point grows, so that both sides agree.
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

    void checkError(const ChunkData& chunk, const std::array<ChunkData, quadrantCount>& children) {
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
        const double expected = geometricErrorM(shape_, chunk.id, refined, scratch_) + childrenDeltaM;
        if (std::abs(expected - chunk.deltaCM) > 1e-6 * expected + 1e-6) {
            chunkProblem(chunk.id, fmt::format("delta_c is {} m in the file, but its heights give {} m",
                                               chunk.deltaCM, expected));
        }
    }

    Result<void> compareWithSource(const ChunkData& chunk) {
        const int cells = chunkCells(shape_);
        const SampleTile tile{chunk.id.face,
                              faceCells(shape_),
                              static_cast<int>(chunk.id.x) * cells,
                              static_cast<int>(chunk.id.y) * cells,
                              cells + 1,
                              cells + 1};
        std::vector<float> heights(chunk.heights.size());
        std::vector<std::int16_t> steps(chunk.heights.size());
        if (auto sampled = source_->sample(tile, heights); !sampled) return sampled;
        if (auto fitted = quantise(shape_, *source_, heights, steps); !fitted) return fitted;
        report_.leafSamples += steps.size();
        int largest = 0;
        for (std::size_t i = 0; i < steps.size(); ++i)
            largest = std::max(largest, std::abs(steps[i] - chunk.heights[i]));
        if (largest > 0) {
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
    GeometricErrorScratch scratch_;
    std::unordered_map<EdgeKey, SeenEdge, EdgeHash> openEdges_;  // edges of which one side has been seen
};

}  // namespace

Result<FileReport> reportFile(const ChunkFile& file) {
    const PlanetShape& shape = file.info().shape;
    std::vector<LevelTally> tallies(static_cast<std::size_t>(leafLevel(shape)) + 1);
    for (const Face face : allFaces) {
        const auto root = file.readRoot(face);
        if (!root) return tl::unexpected(root.error());
        ++tallies[0].chunks;
        tallies[0].bytes += file.info().roots[static_cast<std::size_t>(face)].size;
        tallies[0].deltasM.push_back(root->deltaCM);
        if (leafLevel(shape) == 0) continue;
        if (auto done = tallyChildren(file, root->id, root->children, tallies); !done)
            return tl::unexpected(done.error());
    }
    FileReport report;
    report.fileBytes = file.sizeBytes();
    report.finestSamples = sampleCountOf(shape);
    report.bitsPerFinestSample =
        8 * static_cast<double>(report.fileBytes) / static_cast<double>(report.finestSamples);
    for (int level = 0; level <= leafLevel(shape); ++level) {
        report.levels.push_back(summarise(level, tallies[static_cast<std::size_t>(level)]));
    }
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
    auto root = file.readRoot(report.place.face);
    if (!root) return tl::unexpected(root.error());
    ChunkData chunk = *std::move(root);
    for (;;) {
        const FaceSquare square = faceSquareOf(chunk.id);
        const int cells = chunkCells(shape);
        const double step =
            stepOnTriangles(chunk.heights, cells, (report.place.u - square.u) / square.side * cells,
                            (report.place.v - square.v) / square.side * cells);
        report.heightM = shape.baseHeightM + step * shape.quantumM;
        const double lowest = heightM(shape, chunk.minStep);
        const double highest = heightM(shape, chunk.maxStep);
        report.chain.push_back({chunk.id, chunk.deltaCM, lowest, highest, report.heightM,
                                chunkBounds(chunk.id, shape.radiusM, lowest, highest)});
        if (chunk.id.level == leafLevel(shape)) return report;
        auto children = file.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!children) return tl::unexpected(children.error());
        const ChunkId next = chunkAt(report.place, chunk.id.level + 1);
        chunk = std::move((*children)[static_cast<std::size_t>(quadrantOf(next))]);
    }
}

}  // namespace planet
