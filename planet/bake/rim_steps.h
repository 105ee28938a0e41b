// Measures how steep the finest surface is where the depth of the tree changes: at the rims of what a finer source
// covers. Internal to the library; one thread at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planet/format/chunk_file_types.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// The steepest step between two neighbouring samples of a leaf.
struct SteepestStep {
    ChunkId chunk;
    Geographic place;  // of one of the two
    double stepM = 0;  // the difference of their heights, >= 0
    double overM = 0;  // the distance between them on the sphere of height 0

    double slope() const { return overM > 0 ? stepM / overM : 0; }
};

// The steepest step at a rim, and the slopes of all leaves of its level.
struct RimReport {
    std::uint64_t leaves = 0;   // of groups of siblings that touch a coarser leaf
    SteepestStep steepest;      // of those leaves
    double levelP999Slope = 0;  // which 99.9 % of the slopes of all leaves of that level do not exceed
    double levelLargestSlope = 0;
};

// Collects the steps of leaves. A source ends inside of the leaves that it refines, so the rim lies in the groups of
// siblings that touch a coarser leaf.
class RimSteps {
public:
    explicit RimSteps(const PlanetShape& shape) : shape_(shape) {}

    // Adds a leaf. All its cells count as long as the one at its middle.
    void add(const ChunkData& leaf);

    // Adds the leaves of another one.
    void merge(const RimSteps& other);

    // Returns the report; nothing if there are no rims. touching: leaves that have a coarser one beside them, any
    // number of times.
    std::optional<RimReport> report(const std::vector<ChunkId>& touching) const;

private:
    // Slopes of one level in steps of a tenth of a degree.
    struct Slopes {
        std::array<std::uint64_t, 901> counts{};
        double largest = 0;
    };

    struct Group {
        std::uint64_t leaves = 0;
        SteepestStep steepest;
    };

    double slopeBelow(int level, double share) const;

    PlanetShape shape_;
    std::vector<Slopes> byLevel_;
    std::unordered_map<std::uint64_t, Group> byGroup_;  // by the key of the siblings' parent
};

}  // namespace planet
