// Regions: places of a planet with detail of their own. A region multiplies the tolerance τ, sets a least or a largest
// level, or chooses the error metric, where its circles, polygons and heights say.
//
//     std::vector<planet::Region> regions(1);
//     regions[0] = {.name = "Valley", .circles = {{{46.5, 7.9}, 30'000}}, .borderM = 20'000, .tauFactor = 0.5};
//     if (const auto set = planet->setRegions(regions); !set) report(set.error());
//
// Where. A region covers the union of its circles and polygons, at the heights of its band if it has one. A band alone
// covers all ground at its heights, and a region without any of them covers nothing. Heights are those of the ground
// as baked, not of the camera, and exaggeration does not move them: so which chunks a region covers never changes while
// the camera flies.
//
// Soft borders. The weight w of a region is 1 where it covers the ground. Outside it falls linearly to 0 over borderM.
// The factor there is factor^w, so that τ changes by equal ratios. Levels are interpolated too, and rounded towards more
// detail: the least level from 0, the largest level from the planet's deepest one. A metric has no soft border.
//
// Overlaps. At each place the strictest region wins, which is the one that demands the most detail: the smallest factor,
// the largest least level, the largest of the largest levels, and the additive metric before the tight one. Precisely,
// regions are laid over one another from the most lenient to the strictest, each with its weight, so that soft borders
// stay soft within other regions. A least level overrules a largest level of another region that is less.
// LodSettings::maxLevel limits both.
//
// Chunks. Selection takes the strictest demand of any place in a chunk's area (region_set.h).
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/tree/error_metric.h"

namespace planet {

struct RegionPoint {
    double latitudeDeg = 0;   // [-90, 90], north positive
    double longitudeDeg = 0;  // [-180, 180], east positive

    bool operator==(const RegionPoint&) const = default;
};

struct RegionCircle {
    RegionPoint centre{};
    double radiusM = 0;  // along the planet's sphere, (0, mostRegionM]; a circle may cover the whole planet

    bool operator==(const RegionCircle&) const = default;
};

// The corners in either direction, each once. The edges are arcs of great circles that do not meet other than at their
// corners. All corners lie within 80 degrees of their middle. The inside is the part around the middle of the sphere's
// two parts that lies in this circle.
using RegionPolygon = std::vector<RegionPoint>;

// Heights of the ground above the planet's radius, metres. lowestM <= highestM; both within ±mostRegionM.
struct HeightBand {
    double lowestM = 0;
    double highestM = 0;
    double borderM = 0;  // of the soft border below and above, metres of height, [0, mostRegionM]

    bool operator==(const HeightBand&) const = default;
};

struct Region {
    std::string name;  // unique; 1 to 64 bytes of UTF-8, without control characters
    bool on = true;    // off: has no effect
    std::vector<RegionCircle> circles{};
    std::vector<RegionPolygon> polygons{};
    std::optional<HeightBand> heights{};
    double borderM =
        0;  // of the soft border around circles and polygons, metres along the sphere, [0, mostRegionM]
    std::optional<double>
        tauFactor{};  // [leastTauFactor, mostTauFactor]; larger: fewer triangles, more visible error
    std::optional<int>
        leastLevel{};  // chunks of smaller levels are split, whatever their error; [0, maxLevel]
    std::optional<int>
        mostLevel{};  // chunks of this level are not split, whatever their error; [leastLevel, maxLevel]
    std::optional<ErrorMetric> metric{};

    bool operator==(const Region&) const = default;
};

inline constexpr double mostRegionM = 1e10;
inline constexpr double leastTauFactor = 1.0 / 64;
inline constexpr double mostTauFactor = 64;
inline constexpr std::size_t mostRegions = 255;
inline constexpr std::size_t mostCircles = 4096;        // of a region
inline constexpr std::size_t mostPolygons = 64;         // of a region
inline constexpr std::size_t mostCorners = 1000;        // of a polygon
inline constexpr std::size_t mostCirclesOfAll = 16384;  // of all regions of a planet
inline constexpr std::size_t mostCornersOfAll = 16384;
inline constexpr std::size_t mostNameBytes = 64;

// Return the unit vector from the planet's centre towards a point, and the point in a direction of any length but 0.
glm::dvec3 directionOf(const RegionPoint& point);
RegionPoint pointOf(const glm::dvec3& direction);

// Returns the outlines of a region's circles and polygons on a sphere of a radius, as lines through directions. Parts that
// lie within another circle of the region are left out, so that a painted region has one outline.
std::vector<std::vector<glm::dvec3>> outlinesOf(const Region& region, double radiusM);

// Checks that the regions of a planet are not too many, and have not too many circles and corners. Cheap.
Result<void> checkCounts(std::span<const Region> regions);
// Checks what is said above of one region. The Error does not name the region: "circle 1: radius_m: -5 is out of ...".
Result<void> checkRegion(const Region& region);
// Checks what is said above. The Error names the region, the circle or polygon and the value, with what is right:
// "region 2 "Valley": circle 1: radius_m: -5 is out of range; expected above 0 and at most 10000000000". Names of values are
// those of a regions file. Pure, any thread.
Result<void> checkRegions(std::span<const Region> regions);

}  // namespace planet
