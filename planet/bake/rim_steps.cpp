#include "planet/bake/rim_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

namespace planet {

namespace {

constexpr double binsPerDeg = 10;
constexpr double degPerRad = 180 / std::numbers::pi;

glm::dvec3 directionAt(const ChunkId& id, double across, double up) {
    const FaceSquare square = faceSquareOf(id);
    return sphereFromCube(cubePoint(id.face, square.u + square.side * across, square.v + square.side * up));
}

// The lengths of a leaf's cells along u and along v, metres.
std::array<double, 2> cellLengthsM(const PlanetShape& shape, const ChunkId& id) {
    const double cell = 1.0 / chunkCells(shape);
    const glm::dvec3 middle = directionAt(id, 0.5, 0.5);
    return {glm::distance(middle, directionAt(id, 0.5 + cell, 0.5)) * shape.radiusM,
            glm::distance(middle, directionAt(id, 0.5, 0.5 + cell)) * shape.radiusM};
}

}  // namespace

void RimSteps::add(const ChunkData& leaf) {
    if (leaf.id.level == 0) return;  // a root has no siblings
    if (byLevel_.size() <= leaf.id.level) byLevel_.resize(leaf.id.level + 1u);
    Slopes& slopes = byLevel_[leaf.id.level];
    const auto side = static_cast<std::size_t>(chunkSize(shape_));
    const std::array<double, 2> lengthsM = cellLengthsM(shape_, leaf.id);
    const std::array<std::size_t, 2> strides = {1, side};
    Group& group = byGroup_[keyOf(parentOf(leaf.id))];
    ++group.leaves;
    SteepestStep& steepest = group.steepest;
    std::size_t steepestAt = leaf.heights.size();
    for (std::size_t i = 0; i < leaf.heights.size(); ++i) {
        const std::array<bool, 2> hasNext = {i % side + 1 < side, i / side + 1 < side};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            if (!hasNext[axis]) continue;
            const double stepM =
                std::abs(leaf.heights[i + strides[axis]] - leaf.heights[i]) * shape_.quantumM;
            const double slope = stepM / lengthsM[axis];
            ++slopes.counts[static_cast<std::size_t>(std::atan(slope) * degPerRad * binsPerDeg)];
            slopes.largest = std::max(slopes.largest, slope);
            if (steepest.overM > 0 && slope <= steepest.slope()) continue;
            steepest.stepM = stepM;
            steepest.overM = lengthsM[axis];
            steepestAt = i;
        }
    }
    if (steepestAt == leaf.heights.size()) return;
    steepest.chunk = leaf.id;
    const double cell = 1.0 / chunkCells(shape_);
    const std::size_t row = steepestAt / side;
    steepest.place = geographicFromDirection(
        directionAt(leaf.id, static_cast<double>(steepestAt % side) * cell, static_cast<double>(row) * cell));
}

void RimSteps::merge(const RimSteps& other) {
    byLevel_.resize(std::max(byLevel_.size(), other.byLevel_.size()));
    for (std::size_t level = 0; level < other.byLevel_.size(); ++level) {
        const Slopes& theirs = other.byLevel_[level];
        Slopes& ours = byLevel_[level];
        for (std::size_t bin = 0; bin < theirs.counts.size(); ++bin) ours.counts[bin] += theirs.counts[bin];
        ours.largest = std::max(ours.largest, theirs.largest);
    }
    for (const auto& [key, theirs] : other.byGroup_) {
        Group& ours = byGroup_[key];
        ours.leaves += theirs.leaves;
        if (ours.steepest.overM <= 0 || theirs.steepest.slope() > ours.steepest.slope())
            ours.steepest = theirs.steepest;
    }
}

double RimSteps::slopeBelow(int level, double share) const {
    const auto& counts = byLevel_[static_cast<std::size_t>(level)].counts;
    std::uint64_t all = 0;
    for (const std::uint64_t count : counts) all += count;
    const double wanted = share * static_cast<double>(all);
    std::uint64_t below = 0;
    std::size_t bin = 0;
    while (bin + 1 < counts.size() && static_cast<double>(below += counts[bin]) < wanted) ++bin;
    return std::tan(static_cast<double>(bin + 1) / binsPerDeg / degPerRad);
}

std::optional<RimReport> RimSteps::report(const std::vector<ChunkId>& touching) const {
    std::set<std::uint64_t> groups;
    for (const ChunkId& leaf : touching) {
        if (leaf.level > 0) groups.insert(keyOf(parentOf(leaf)));
    }
    RimReport report;
    for (const std::uint64_t group : groups) {
        const auto found = byGroup_.find(group);
        if (found == byGroup_.end()) continue;
        const Group& siblings = found->second;
        const bool isFirst = report.leaves == 0;
        report.leaves += siblings.leaves;
        if (isFirst || siblings.steepest.slope() > report.steepest.slope())
            report.steepest = siblings.steepest;
    }
    if (report.leaves == 0) return std::nullopt;
    report.levelP999Slope = slopeBelow(report.steepest.chunk.level, 0.999);
    report.levelLargestSlope = byLevel_[report.steepest.chunk.level].largest;
    return report;
}

}  // namespace planet
