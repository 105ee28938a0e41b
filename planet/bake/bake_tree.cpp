#include "planet/bake/bake_tree.h"

#include <algorithm>

namespace planet {

namespace {

// Returns the level whose leaves have leastFaceCells along a face, or the deepest if that is coarser.
int coarsestLeafLevel(const PlanetShape& shape) {
    int level = 0;
    while (level < deepestLevelOf(shape) && (chunkCells(shape) << level) < leastFaceCells) ++level;
    return level;
}

// Returns the level of all leaves under a chunk, if they have one and it is at most `levels` below it.
std::optional<int> evenLeafLevel(const HeightSource& source, const PlanetShape& shape, const ChunkId& id,
                                 int levels) {
    if (!isRefined(source, shape, id)) return id.level;
    if (levels == 0) return std::nullopt;
    if (!source.finestCells) {
        const int below = deepestLevelOf(shape) - id.level;
        return below <= levels ? std::optional(deepestLevelOf(shape)) : std::nullopt;
    }
    const std::optional<int> level = evenLeafLevel(source, shape, childOf(id, 0), levels - 1);
    for (int q = 1; level && q < quadrantCount; ++q) {
        if (evenLeafLevel(source, shape, childOf(id, q), levels - 1) != level) return std::nullopt;
    }
    return level;
}

// Adds the units under a chunk; returns false if one lies too deep.
bool addUnits(const HeightSource& source, const PlanetShape& shape, const ChunkId& id, int levels,
              int levelsAbove, std::vector<TreeUnit>& units) {
    if (const std::optional<TreeUnit> unit = unitAt(source, shape, id, levels)) {
        units.push_back(*unit);
        return true;
    }
    for (int q = 0; q < quadrantCount; ++q) {
        if (levelsAbove == 0 || !addUnits(source, shape, childOf(id, q), levels, levelsAbove - 1, units))
            return false;
    }
    return true;
}

class Counting {
public:
    Counting(const HeightSource& source, const PlanetShape& shape, const std::function<bool()>& goOn)
        : source_(source), shape_(shape), goOn_(goOn) {
        count_.coarsestLeafLevel = deepestLevelOf(shape);
    }

    std::optional<TreeCount> run() {
        for (const Face face : allFaces) visit({face, 0, 0, 0});
        if (cancelled_) return std::nullopt;
        return count_;
    }

private:
    // Returns the number of levels under a chunk.
    int visit(const ChunkId& id) {
        constexpr std::uint64_t chunksBetweenCalls = 4096;
        if (++count_.chunks % chunksBetweenCalls == 0 && goOn_ && !goOn_()) cancelled_ = true;
        if (cancelled_ || !isRefined(source_, shape_, id)) {
            count_.coarsestLeafLevel = std::min<int>(count_.coarsestLeafLevel, id.level);
            count_.leafCells += chunkCellCount(shape_);
            return 0;
        }
        int below = 0;
        for (int q = 0; q < quadrantCount; ++q) below = std::max(below, visit(childOf(id, q)));
        ++count_.refinedByHeight[static_cast<std::size_t>(below)];
        return below + 1;
    }

    const HeightSource& source_;
    const PlanetShape& shape_;
    const std::function<bool()>& goOn_;
    TreeCount count_;
    bool cancelled_ = false;
};

TreeCount countDense(const PlanetShape& shape) {
    const int deepest = deepestLevelOf(shape);
    TreeCount count;
    count.chunks = chunkCountOf(shape);
    count.coarsestLeafLevel = deepest;
    count.leafCells = leafCountOf(count.chunks) * chunkCellCount(shape);
    for (int level = 0; level < deepest; ++level)
        count.refinedByHeight[static_cast<std::size_t>(deepest - 1 - level)] = std::uint64_t{faceCount}
                                                                               << (2 * level);
    return count;
}

}  // namespace

bool isRefined(const HeightSource& source, const PlanetShape& shape, const ChunkId& id) {
    if (id.level >= deepestLevelOf(shape)) return false;
    if (!source.finestCells || id.level < coarsestLeafLevel(shape)) return true;
    return source.finestCells(id) > (chunkCells(shape) << id.level);
}

std::optional<TreeUnit> unitAt(const HeightSource& source, const PlanetShape& shape, const ChunkId& id,
                               int levels) {
    const std::optional<int> level = evenLeafLevel(source, shape, id, levels);
    return level ? std::optional(TreeUnit{id, *level}) : std::nullopt;
}

std::vector<TreeUnit> unitsUnder(const HeightSource& source, const PlanetShape& shape, const ChunkId& id,
                                 int levels, int levelsAbove) {
    std::vector<TreeUnit> units;
    return addUnits(source, shape, id, levels, levelsAbove, units) ? units : std::vector<TreeUnit>();
}

TreeWalk::TreeWalk(const HeightSource& source, const PlanetShape& shape, int levels)
    : source_(source), shape_(shape), levels_(levels) {
    for (auto face = allFaces.rbegin(); face != allFaces.rend(); ++face) open_.push_back({*face, 0, 0, 0});
}

std::optional<TreeUnit> TreeWalk::next() {
    while (!open_.empty()) {
        const ChunkId id = open_.back();
        open_.pop_back();
        if (const std::optional<TreeUnit> unit = unitAt(source_, shape_, id, levels_)) return unit;
        for (int q = quadrantCount - 1; q >= 0; --q) open_.push_back(childOf(id, q));
    }
    return std::nullopt;
}

std::optional<TreeCount> countTree(const HeightSource& source, const PlanetShape& shape,
                                   const std::function<bool()>& goOn) {
    return source.finestCells ? Counting(source, shape, goOn).run() : countDense(shape);
}

}  // namespace planet
