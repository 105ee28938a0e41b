#include "planet/bake/file_report.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "planet/bake/bake_tree.h"
#include "planet/bake/delta_ranks.h"
#include "planet/bake/finest_distance.h"
#include "planet/bake/quantise.h"
#include "planet/base/parallel.h"
#include "planet/base/try.h"
#include "planet/source/sample_tiles.h"
#include "planet/sphere/chunk_surface.h"
#include "planet/sphere/geometric_error.h"

namespace planet {

namespace {

// --- reportFile
// -----------------------------------------------------------------------------------------------------

// Counts and sums over the chunks of a level in a part of the file.
struct LevelTally {
    std::uint64_t chunks = 0;
    std::uint64_t leaves = 0;
    std::uint64_t bytes = 0;
    float minDeltaM = std::numeric_limits<float>::infinity();  // of those with children
    float maxDeltaM = 0;
    double sumDeltaM = 0;
    double sumTightM = 0;
    float maxTightM = 0;

    void add(const LevelTally& part) {
        chunks += part.chunks;
        leaves += part.leaves;
        bytes += part.bytes;
        minDeltaM = std::min(minDeltaM, part.minDeltaM);
        maxDeltaM = std::max(maxDeltaM, part.maxDeltaM);
        sumDeltaM += part.sumDeltaM;
        sumTightM += part.sumTightM;
        maxTightM = std::max(maxTightM, part.maxTightM);
    }
};

// The subtree under a chunk, and what it holds by level; the Error if it cannot be read.
struct PartTally {
    ChunkId root;
    BlockLocation children;
    std::vector<LevelTally> levels;
    Result<void> outcome;
};

// Tallies the index of a file, in parts that are read in parallel. The result is the same for any number of threads.
class Tallying {
public:
    explicit Tallying(const ChunkFile& file)
        : file_(file), deepest_(deepestLevelOf(file.info().shape)), levels_(emptyLevels()) {
        for (int level = 0; level <= deepest_; ++level) ranks_.emplace_back(std::array{0.5, 0.99});
    }

    Result<FileReport> run() {
        TRY_ASSIGN(auto parts, tallyTop());
        TRY(tallyAll(parts, &DeltaRanks::add));
        for (const PartTally& part : parts) {
            for (std::size_t level = 0; level < levels_.size(); ++level)
                levels_[level].add(part.levels[level]);
        }
        bool isAgain = false;
        for (DeltaRanks& ranks : ranks_) isAgain = ranks.needsSecondPass() || isAgain;
        if (isAgain) TRY(tallyAll(parts, &DeltaRanks::addAgain));
        FileReport report;
        for (int level = 0; level <= deepest_; ++level) report.levels.push_back(summarise(level));
        return report;
    }

private:
    using AddDelta = void (DeltaRanks::*)(float);

    std::vector<LevelTally> emptyLevels() const {
        return std::vector<LevelTally>(static_cast<std::size_t>(deepest_) + 1);
    }

    void tally(int level, const BlockLocation& children, float deltaCM, float deltaTightM,
               std::vector<LevelTally>& levels, AddDelta addDelta) {
        LevelTally& to = levels[static_cast<std::size_t>(level)];
        if (!children.exists()) {
            ++to.leaves;
            return;
        }
        (ranks_[static_cast<std::size_t>(level)].*addDelta)(deltaCM);
        to.minDeltaM = std::min(to.minDeltaM, deltaCM);
        to.maxDeltaM = std::max(to.maxDeltaM, deltaCM);
        to.sumDeltaM += static_cast<double>(deltaCM);
        to.sumTightM += static_cast<double>(deltaTightM);
        to.maxTightM = std::max(to.maxTightM, deltaTightM);
    }

    // Tallies the chunks of the coarsest levels, and returns the subtrees under them. Those of the first pass only: these
    // levels have too few chunks for a second.
    Result<std::vector<PartTally>> tallyTop() {
        std::vector<PartTally> parts;
        for (const Face face : allFaces) {
            TRY_ASSIGN(const auto root, file_.readRoot(face));
            ++levels_[0].chunks;
            levels_[0].bytes += file_.info().roots[static_cast<std::size_t>(face)].size;
            tally(0, root.children, root.deltaCM, root.deltaTightM, levels_, &DeltaRanks::add);
            if (root.children.exists()) parts.push_back({root.id, root.children, {}, {}});
        }
        for (int level = 1; level <= std::min(partLevel, deepest_ - 1); ++level) {
            std::vector<PartTally> finer;
            for (const PartTally& part : parts) {
                std::uint64_t bytesLeft = file_.sizeBytes();
                TRY_ASSIGN(const auto entries,
                           readChildren(part.root, part.children, levels_, &DeltaRanks::add, bytesLeft));
                for (std::size_t q = 0; q < entries.size(); ++q) {
                    if (entries[q].children.exists())
                        finer.push_back(
                            {childOf(part.root, static_cast<int>(q)), entries[q].children, {}, {}});
                }
            }
            parts = std::move(finer);
        }
        return parts;
    }

    Result<void> tallyAll(std::vector<PartTally>& parts, AddDelta addDelta) {
        parallelFor(parts.size(), [&](std::size_t i) {
            PartTally& part = parts[i];
            part.levels = emptyLevels();
            std::uint64_t bytesLeft = file_.sizeBytes();
            part.outcome = tallyUnder(part.root, part.children, part.levels, addDelta, bytesLeft);
        });
        for (const PartTally& part : parts) TRY(part.outcome);
        return {};
    }

    // Tallies four siblings, and returns their entries if they can have children.
    Result<std::array<ChunkEntry, quadrantCount>> readChildren(const ChunkId& parent, BlockLocation block,
                                                               std::vector<LevelTally>& levels,
                                                               AddDelta addDelta, std::uint64_t& bytesLeft) {
        const int level = parent.level + 1;
        LevelTally& to = levels[static_cast<std::size_t>(level)];
        to.chunks += quadrantCount;
        to.bytes += block.size;
        TRY(spendOn(file_, block, bytesLeft));
        if (level == deepest_) {
            to.leaves += quadrantCount;
            return std::array<ChunkEntry, quadrantCount>{};
        }
        TRY_ASSIGN(const auto entries, file_.readEntries(parent, block));
        for (const ChunkEntry& entry : entries)
            tally(level, entry.children, entry.deltaCM, entry.deltaTightM, levels, addDelta);
        return entries;
    }

    Result<void> tallyUnder(const ChunkId& parent, BlockLocation block, std::vector<LevelTally>& levels,
                            AddDelta addDelta, std::uint64_t& bytesLeft) {
        TRY_ASSIGN(const auto entries, readChildren(parent, block, levels, addDelta, bytesLeft));
        for (std::size_t q = 0; q < entries.size(); ++q) {
            if (!entries[q].children.exists()) continue;
            const ChunkId child = childOf(parent, static_cast<int>(q));
            TRY(tallyUnder(child, entries[q].children, levels, addDelta, bytesLeft));
        }
        return {};
    }

    LevelReport summarise(int level) const {
        const LevelTally& tally = levels_[static_cast<std::size_t>(level)];
        LevelReport report;
        report.level = level;
        report.chunks = tally.chunks;
        report.leaves = tally.leaves;
        report.bytes = tally.bytes;
        if (tally.chunks == tally.leaves) return report;
        const DeltaRanks& ranks = ranks_[static_cast<std::size_t>(level)];
        report.minDeltaM = tally.minDeltaM;
        report.medianDeltaM = ranks.percentile(0);
        report.p99DeltaM = ranks.percentile(1);
        report.maxDeltaM = tally.maxDeltaM;
        const auto count = static_cast<double>(tally.chunks - tally.leaves);
        report.meanDeltaM = tally.sumDeltaM / count;
        report.meanTightM = tally.sumTightM / count;
        report.maxTightM = tally.maxTightM;
        return report;
    }

    static constexpr int partLevel = 3;  // of the chunks whose subtrees are parts: up to 384

    const ChunkFile& file_;
    int deepest_;
    std::vector<LevelTally> levels_;
    std::deque<DeltaRanks> ranks_;  // by level
};

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
    Edge edge;
    std::uint64_t hash;
};

using ReportProblem = std::function<void(const ChunkId& id, const std::string& what)>;

// Recomputes the tight metric during a depth-first walk of a part of the file, as a bake does: from the finest heights
// of one complete subtree at a time, and by a search if cells are wider than a subtree.
class TightVerifier {
public:
    explicit TightVerifier(const ChunkFile& file)
        : file_(file),
          shape_(file.info().shape),
          levels_(deepestLevelOf(shape_) - tileLevelOf(shape_, std::nullopt)),
          above_(static_cast<std::size_t>(deepestLevelOf(shape_)) + 1) {}

    struct Met {
        ChunkId id;
        float deltaCM = 0;
        float deltaTightM = 0;
        float largestOfChildrenM = 0;
    };
    // A complete subtree, whose leaves have one level (TreeUnit).
    struct Unit {
        int leafLevel = 0;
        std::vector<std::int32_t> finest;  // the samples of its square on the leaves' grid
        std::vector<Met> met;              // its chunks two or more levels above the leaves
    };
    struct Below {
        double deltaGM = 0;
        float largestTightM = 0;  // of the children
        bool hasLeaves = false;
        bool isWhole = true;  // every block under the chunk could be read
        std::array<std::optional<Unit>, quadrantCount> units;
    };

    static Unit unitOf(const ChunkData& leaf) { return {leaf.id.level, leaf.heights.view().toVector(), {}}; }

    // Checks a chunk after everything under it. Returns the chunk as a unit if it is one.
    std::optional<Unit> leave(const ChunkData& chunk, Below&& below, const ReportProblem& report) {
        const Met met{chunk.id, chunk.deltaCM, chunk.deltaTightM, below.largestTightM};
        if (std::optional<Unit> unit = joined(chunk.id, below)) {
            if (unit->leafLevel == chunk.id.level + 1)
                check(met, below.deltaGM, report);
            else
                unit->met.push_back(met);
            return unit;
        }
        for (int q = 0; q < quadrantCount; ++q) {
            if (const auto& unit = below.units[static_cast<std::size_t>(q)])
                finish(childOf(chunk.id, q), *unit, report);
        }
        const Above above = std::exchange(above_[chunk.id.level], {});
        if (!below.isWhole) return std::nullopt;
        if (above.isUnknown)
            search(chunk, met, report);
        else
            check(met, below.hasLeaves ? std::max(below.deltaGM, above.offM) : above.offM, report);
        return std::nullopt;
    }

    // Takes over what another part found out about the chunks above it.
    void merge(const TightVerifier& part) {
        for (std::size_t level = 0; level < above_.size(); ++level) {
            above_[level].offM = std::max(above_[level].offM, part.above_[level].offM);
            above_[level].isUnknown = above_[level].isUnknown || part.above_[level].isUnknown;
        }
    }

    // Checks the chunks of a unit that belongs to no larger one.
    void finish(const ChunkId& root, const Unit& unit, const ReportProblem& report) {
        measureTile(shapeOfLevel(shape_, unit.leafLevel), root, unit.finest, scratch_, distances_);
        for (const Met& met : unit.met) check(met, distances_.of(met.id), report);
        const int coarsest = coarsestLevelOfTiles(root.level, shape_);
        for (int level = 0; level < coarsest; ++level)
            above_[static_cast<std::size_t>(level)].isUnknown = true;
        for (int level = coarsest; level <= std::min(root.level - 1, unit.leafLevel - 2); ++level) {
            double& offM = above_[static_cast<std::size_t>(level)].offM;
            offM = std::max(offM, distances_.above(level));
        }
    }

private:
    // The chunk of a level that is being walked.
    struct Above {
        double offM = 0;         // from the finest samples of its units
        bool isUnknown = false;  // a unit is narrower than its cells
    };

    // Joins four units of one leaf level, if the result is not too large for a unit.
    std::optional<Unit> joined(const ChunkId& parent, Below& below) const {
        for (const std::optional<Unit>& unit : below.units) {
            if (!unit || unit->leafLevel != below.units[0]->leafLevel) return std::nullopt;
        }
        Unit all{below.units[0]->leafLevel, {}, {}};
        if (all.leafLevel - parent.level > levels_) return std::nullopt;
        const int cells = chunkCells(shape_) << (all.leafLevel - parent.level - 1);
        const auto side = static_cast<std::size_t>(cells) * 2 + 1;
        all.finest.resize(side * side);
        for (int q = 0; q < quadrantCount; ++q) {
            const Unit& quarter = *below.units[static_cast<std::size_t>(q)];
            placeQuarter(quarter.finest, cells, q, all.finest);
            all.met.insert(all.met.end(), quarter.met.begin(), quarter.met.end());
        }
        return all;
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
    int levels_;                // of the largest unit, without its root
    std::vector<Above> above_;  // by level
    GeometricErrorScratch scratch_;
    TileDistances distances_;
};

// The file, the source and the progress, which all threads of a verification share.
class Verification {
public:
    Verification(const ChunkFile& file, const HeightSource* source, const VerifyProgressCallback& progress)
        : file_(file), source_(source), progress_(progress) {}

    const ChunkFile& file() const { return file_; }
    const HeightSource* source() const { return source_; }

    // Counts chunks as done. Returns false if the caller has cancelled.
    bool advance(std::uint64_t chunks) {
        const std::lock_guard lock(mutex_);
        done_ += chunks;
        goesOn_ = goesOn_ && (!progress_ || progress_(done_, file_.info().chunks));
        return goesOn_;
    }

    // Ends all parts soon. The first error is that of the verification: the others only follow from it.
    void stop(const Error& error) {
        const std::lock_guard lock(mutex_);
        goesOn_ = false;
        if (!error_) error_ = error;
    }
    const std::optional<Error>& error() const { return error_; }

private:
    const ChunkFile& file_;
    const HeightSource* source_;
    const VerifyProgressCallback& progress_;
    std::mutex mutex_;  // of the rest
    std::uint64_t done_ = 0;
    bool goesOn_ = true;
    std::optional<Error> error_;
};

// Verifies a part of the file: the whole of it, or the subtrees under some chunks, which it hands to parts of their own.
class Verifier {
public:
    explicit Verifier(Verification& whole)
        : whole_(whole),
          file_(whole.file()),
          source_(whole.source()),
          shape_(file_.info().shape),
          isSparse_(file_.info().chunks < chunkCountOf(shape_)),
          rims_(shape_),
          tight_(file_) {}

    Result<VerifyReport> run() {
        std::vector<ChunkData> roots;
        for (const Face face : allFaces) {
            auto root = file_.readRoot(face);
            if (!root) {
                problem(root.error().message);
                continue;
            }
            children_[static_cast<std::size_t>(face)] = root->children;
            roots.push_back(std::move(*root));
        }
        TRY_ASSIGN(const Units units, visitApart(roots));
        for (std::size_t i = 0; i < roots.size(); ++i) {
            if (units[i]) tight_.finish(roots[i].id, *units[i], reportProblem());
        }
        if (report_.problemCount == 0) {
            checkTree();
            report_.rims = rims_.report(chunksBesideCoarserOnes());
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

    ReportProblem reportProblem() {
        return [this](const ChunkId& id, const std::string& what) { chunkProblem(id, what); };
    }

    using Units = std::vector<std::optional<TightVerifier::Unit>>;  // nothing where a chunk is not a unit

    // Visits chunks and everything under them in parallel. Their problems are in the order of the chunks.
    Result<Units> visitApart(std::span<const ChunkData> chunks) {
        struct Part {
            Verifier verifier;
            Result<std::optional<TightVerifier::Unit>> unit{};
        };
        std::vector<std::optional<Part>> parts(chunks.size());
        parallelFor(chunks.size(), [&](std::size_t i) {
            Part& part = parts[i].emplace(Part{Verifier(whole_)});
            part.unit = part.verifier.visit(chunks[i]);
            if (!part.unit) whole_.stop(part.unit.error());
        });
        Units units;
        for (std::optional<Part>& part : parts) {
            TRY(part->unit);
            merge(std::move(part->verifier));
            units.push_back(std::move(*part->unit));
        }
        if (!goesOn()) return cancelled();
        return units;
    }

    // Counts the visited chunks once they are enough. Returns false if the caller has cancelled.
    bool goesOn() { return toCount_ < countedAtOnce || whole_.advance(std::exchange(toCount_, 0)); }

    void merge(Verifier&& part) {
        toCount_ += part.toCount_;
        report_.chunks += part.report_.chunks;
        report_.edges += part.report_.edges;
        report_.leafSamples += part.report_.leafSamples;
        report_.sourceProblems += part.report_.sourceProblems;
        const std::uint64_t unkept = part.report_.problemCount - part.report_.problems.size();
        for (std::string& message : part.report_.problems) problem(std::move(message));
        report_.problemCount += unkept;
        leaves_ += part.leaves_;
        missed_ += part.missed_;
        coarsestLeafLevel_ = std::min(coarsestLeafLevel_, part.coarsestLeafLevel_);
        rims_.merge(part.rims_);
        tight_.merge(part.tight_);
        for (const auto& [key, edge] : part.openEdges_) matchEdge(edge, key);
    }

    // Visits a chunk and everything under it. Returns it as a unit if it is one.
    Result<std::optional<TightVerifier::Unit>> visit(const ChunkData& chunk) {
        ++report_.chunks;
        ++toCount_;
        if (!goesOn()) return cancelled();
        checkBounds(chunk);
        checkEdges(chunk);
        if (!chunk.children.exists()) {
            ++leaves_;
            coarsestLeafLevel_ = std::min<int>(coarsestLeafLevel_, chunk.id.level);
            if (isSparse_) rims_.add(chunk);
            if (source_ != nullptr) {
                TRY(compareWithSource(chunk));
            }
            return TightVerifier::unitOf(chunk);
        }
        TightVerifier::Below below;
        const std::uint64_t missedBefore = missed_;
        const auto children = file_.readChildren(chunk.id, chunk.children, chunk.heights);
        if (children) {
            below.deltaGM = checkError(chunk, *children);
        } else {
            problem(children.error().message);
            ++missed_;
        }
        if (children && isWorthSplitting(*children)) {
            TRY_ASSIGN(Units units, visitApart(*children));
            std::ranges::move(units, below.units.begin());
        } else if (children) {
            for (std::size_t q = 0; q < children->size(); ++q) {
                TRY_ASSIGN(below.units[q], visit((*children)[q]));
            }
        }
        for (std::size_t q = 0; children && q < children->size(); ++q) {
            const ChunkData& child = (*children)[q];
            below.largestTightM = std::max(below.largestTightM, child.deltaTightM);
            below.hasLeaves = below.hasLeaves || !child.children.exists();
        }
        below.isWhole = missed_ == missedBefore;
        return tight_.leave(chunk, std::move(below), reportProblem());
    }

    // Starting a part takes about as long as one chunk, so parts get several: at least two of the children have children
    // of their own, and only every second level is split.
    static bool isWorthSplitting(const std::array<ChunkData, quadrantCount>& children) {
        return children[0].id.level % 2 == 1 &&
               std::ranges::count_if(children, [](const ChunkData& c) { return c.children.exists(); }) >= 2;
    }

    // Checks what the header says of the tree, and that an edge without a chunk of its level on the other
    // side belongs to a leaf there.
    void checkTree() {
        const ChunkFileInfo& info = file_.info();
        if (report_.chunks != info.chunks || leaves_ != leafCountOf(info.chunks)) {
            problem(fmt::format("{}: has {} chunks; the header says {}", file_.name(), report_.chunks,
                                info.chunks));
        }
        if (coarsestLeafLevel_ != info.coarsestLeafLevel) {
            problem(fmt::format("{}: its coarsest leaf has level {}; the header says {}", file_.name(),
                                coarsestLeafLevel_, info.coarsestLeafLevel));
        }
        std::uint64_t alone = 0;
        for (const auto& [key, seen] : openEdges_)
            alone += !liesUnderLeaf(neighbourOf(seen.chunk, seen.edge));
        if (alone > 0)
            problem(fmt::format("{}: {} edges have no chunk on their other side", file_.name(), alone));
    }

    // Returns the chunks with an edge that no chunk of their level shares. Everything has been read before without a
    // problem.
    std::vector<ChunkId> chunksBesideCoarserOnes() const {
        std::vector<ChunkId> chunks;
        for (const auto& [key, seen] : openEdges_) chunks.push_back(seen.chunk);
        return chunks;
    }

    // Returns whether a chunk of a coarser level is a leaf at the place of this one. Everything has been read
    // before without a problem.
    bool liesUnderLeaf(const ChunkId& id) const {
        BlockLocation children = children_[static_cast<std::size_t>(id.face)];
        for (int level = 0; level < id.level; ++level) {
            if (!children.exists()) return true;
            const auto entries = file_.readEntries(ancestorOf(id, level), children);
            if (!entries) return false;
            children = (*entries)[static_cast<std::size_t>(quadrantOf(ancestorOf(id, level + 1)))].children;
        }
        return false;
    }

    void checkBounds(const ChunkData& chunk) {
        const ChunkBounds bounds = chunkBounds(chunk.id, shape_.radiusM, heightM(shape_, chunk.minStep),
                                               heightM(shape_, chunk.maxStep));
        const FaceSquare square = faceSquareOf(chunk.id);
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const double step = square.side / chunkCells(shape_);
        for (std::size_t i = 0; i < chunk.heights.size(); ++i) {
            const std::int32_t height = chunk.heights[i];
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
            Edge edge;
            double u0, v0, u1, v1;
            std::size_t first, stride;
        };
        const double east = square.u + square.side;
        const double north = square.v + square.side;
        const std::array<Side, 4> sides = {{{Edge::South, square.u, square.v, east, square.v, 0, 1},
                                            {Edge::North, square.u, north, east, north, side * (side - 1), 1},
                                            {Edge::West, square.u, square.v, square.u, north, 0, side},
                                            {Edge::East, east, square.v, east, north, side - 1, side}}};
        std::vector<std::int32_t> samples(side);
        for (const Side& edge : sides) {
            const glm::dvec3 from = cubePoint(chunk.id.face, edge.u0, edge.v0);
            const glm::dvec3 to = cubePoint(chunk.id.face, edge.u1, edge.v1);
            for (std::size_t i = 0; i < side; ++i) samples[i] = chunk.heights[edge.first + i * edge.stride];
            if (std::tie(to.x, to.y, to.z) < std::tie(from.x, from.y, from.z))
                std::reverse(samples.begin(), samples.end());
            const EdgeKey key{chunk.id.level,
                              glm::i64vec3((from + to) * std::ldexp(1.0, chunk.id.level + 1))};
            matchEdge({chunk.id, edge.edge, XXH3_64bits(samples.data(), samples.size() * sizeof samples[0])},
                      key);
        }
    }

    void matchEdge(const SeenEdge& edge, const EdgeKey& key) {
        const auto [seen, isFirst] = openEdges_.try_emplace(key, edge);
        if (isFirst) return;
        ++report_.edges;
        if (seen->second.hash != edge.hash) {
            chunkProblem(edge.chunk,
                         fmt::format("its edge differs from that of chunk {}", toString(seen->second.chunk)));
        }
        openEdges_.erase(seen);
    }

    // Verifies the chunk's errors and returns its δg.
    double checkError(const ChunkData& chunk, const std::array<ChunkData, quadrantCount>& children) {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const std::size_t refinedSide = 2 * side - 1;
        std::vector<std::int32_t> refined(refinedSide * refinedSide);
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
        const SampleTile tile = tileOf(shape_, chunk.id, chunk.id.level);
        std::vector<std::int32_t> steps(chunk.heights.size());
        TRY(sampleSteps(shape_, *source_, tile, sampled_, steps));
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

    static constexpr std::uint64_t countedAtOnce = 512;

    Verification& whole_;
    const ChunkFile& file_;
    const HeightSource* source_;
    PlanetShape shape_;
    VerifyReport report_;
    std::uint64_t toCount_ = 0;                      // visited chunks that are not counted as done yet
    std::array<BlockLocation, faceCount> children_;  // of the roots
    std::uint64_t leaves_ = 0;
    std::uint64_t missed_ = 0;  // chunks with unreadable children
    bool isSparse_;
    RimSteps rims_;
    int coarsestLeafLevel_ = maxLevel;
    TightVerifier tight_;
    GeometricErrorScratch scratch_;
    SampledHeights sampled_;
    std::unordered_map<EdgeKey, SeenEdge, EdgeHash> openEdges_;  // edges that have been seen from one side
};

}  // namespace

Result<FileReport> reportFile(const ChunkFile& file) {
    TRY_ASSIGN(FileReport report, Tallying(file).run());
    report.fileBytes = file.sizeBytes();
    report.finestSamples = sampleCountOf(file.info());
    std::uint64_t heightBytes = chunkFileHeaderBytes;
    for (const LevelReport& level : report.levels) heightBytes += level.bytes;
    report.bitsPerFinestSample =
        8 * static_cast<double>(heightBytes) / static_cast<double>(report.finestSamples);
    return report;
}

Result<VerifyReport> verifyFile(const ChunkFile& file, const HeightSource* source,
                                const VerifyProgressCallback& progress) {
    Verification whole(file, source, progress);
    Result<VerifyReport> report = Verifier(whole).run();
    if (whole.error()) return tl::unexpected(*whole.error());
    return report;
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
        if (!chunk.children.exists()) return report;
        TRY_ASSIGN(auto children, file.readChildren(chunk.id, chunk.children, chunk.heights));
        const ChunkId next = chunkAt(report.place, chunk.id.level + 1);
        chunk = std::move(children[static_cast<std::size_t>(quadrantOf(next))]);
    }
}

}  // namespace planet
