// The regions of one planet, prepared for evaluation. Immutable; any thread.
//
// Conservative evaluation. The signed distance from a circle or a polygon changes by at most the angle that a place moves
// by. So over a cone of half angle h, which holds a chunk's area, the distance lies within h of that of the cone's axis.
// This gives the range [low, high] of a region's weight, and so that of each value laid over those below, because
//
//     value = below (1 - w) + own w
//
// is linear in w and does not fall while `below` grows. The demand of an area is the strict end of these ranges: it is at
// least as strict as the demand at any place in it. A smaller area has smaller ranges, and a child takes no demand that is
// stricter than its parent's, which holds for the child's area too. So from parent to child the factor never falls, and
// the levels never rise, just as δc never grows: wherever a chunk must be split, so must all of its ancestors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/sphere/bounds.h"
#include "planet/sphere/planet_shape.h"
#include "planet/tree/chunk_demand.h"
#include "planet/tree/region.h"

namespace planet {

class SpherePolygon;  // sphere_polygon.h

// A part of the ground: the directions of a cone, and the lowest and highest ground there, metres.
struct GroundArea {
    DirectionCone cone;
    double lowestM = 0;
    double highestM = 0;
};

// The effect of a region in an area.
struct RegionEffect {
    std::size_t region = 0;  // its index
    std::string name;
    double leastWeight = 0;      // bounds of its weight in the area, [0, 1]
    double mostWeight = 0;       // > 0
    bool setsTauFactor = false;  // it decides the demand's factor; with a soft border, those below take part
    bool setsLeastLevel = false;
    bool setsMostLevel = false;
    bool setsMetric = false;

    bool decides() const { return setsTauFactor || setsLeastLevel || setsMostLevel || setsMetric; }
};

class RegionSet {
public:
    // The Error is that of checkRegions. shape: with heights as baked.
    static Result<std::shared_ptr<const RegionSet>> make(std::vector<Region> regions,
                                                         const PlanetShape& shape);
    ~RegionSet();
    RegionSet(const RegionSet&) = delete;
    RegionSet& operator=(const RegionSet&) = delete;

    const std::vector<Region>& regions() const { return regions_; }
    const PlanetShape& shape() const { return shape_; }
    // Returns whether any region that is on chooses a metric.
    bool choosesMetrics() const { return choosesMetrics_; }

    // The circles, polygons and bands that matter in an area and everything in it. It makes descending a tree fast.
    struct Part {
        std::uint32_t shape = 0;  // index in a list of all of them
        bool covers = false;      // it covers all of the area
    };
    using Parts = std::vector<Part>;
    const Parts& allParts() const { return allParts_; }
    Parts partsIn(const GroundArea& area, const Parts& among) const;

    // Returns the strictest demand of any place in an area. among: allParts(), or partsIn() a larger area.
    ChunkDemand demandIn(const GroundArea& area, const Parts& among) const;
    ChunkDemand demandIn(const GroundArea& area) const { return demandIn(area, allParts_); }

    // Returns what each region that is on does in an area, in their order; those without any weight there are left out.
    std::vector<RegionEffect> effectsIn(const GroundArea& area, const Parts& among) const;

private:
    struct Shape {
        std::uint32_t region = 0;
        std::int32_t polygon = -1;  // index; -1: a circle, or the whole planet
        glm::dvec3 centre{0, 0, 1};
        double radiusRad = 0;  // around the whole shape
    };
    // The bounds of a weight.
    struct Weight {
        double low = 0;
        double high = 0;
    };
    // The order in which regions are laid over one another, for one kind of value.
    using Order = std::vector<std::uint32_t>;

    RegionSet(std::vector<Region> regions, const PlanetShape& shape);
    Weight weightOf(const Shape& shape, const GroundArea& area) const;
    static Weight bandWeight(const HeightBand& band, const GroundArea& area);
    // Returns the weights by region.
    std::vector<Weight> weightsIn(const GroundArea& area, const Parts& among) const;
    // The value of an area, and the region that decides it.
    struct Decided {
        double value = 0;
        std::optional<std::uint32_t> by;
    };
    Decided tauIn(std::span<const Weight> weights) const;  // log2 of the factor
    Decided leastLevelIn(std::span<const Weight> weights) const;
    Decided mostLevelIn(std::span<const Weight> weights) const;
    std::optional<std::uint32_t> metricDecidedIn(std::span<const Weight> weights) const;
    MetricRule metricIn(std::span<const Weight> weights) const;

    std::vector<Region> regions_;
    PlanetShape shape_;
    std::vector<SpherePolygon> polygons_;
    std::vector<Shape> shapes_;  // by region
    Parts allParts_;
    Order byTau_;
    Order byLeastLevel_;
    Order byMostLevel_;
    bool choosesMetrics_ = false;
};

// Returns the demand of a chunk whose parent's is known: the stricter of both never falls to the child.
ChunkDemand withinParent(const ChunkDemand& own, const ChunkDemand& parent);

}  // namespace planet
