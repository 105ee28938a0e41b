// A survey looks everywhere at first, then where neighbours differ and where the worst is.
#include "planet/measure/atlas_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "planet/sphere/planet_shape.h"

namespace planet {
namespace {

using Value = std::function<double(const glm::dvec3& direction, const AtlasPlace& place)>;

AtlasGrid grid(std::uint64_t most) {
    AtlasGrid made;
    made.altitudesM = {1000, 5000};
    made.headings = 2;
    made.most = most;
    made.finestLevel = 7;
    return made;
}

// Surveys with a formula as the number of triangles; nothing else is measured.
std::vector<AtlasViewpoint> surveyed(const AtlasGrid& grid, const Value& value) {
    std::vector<AtlasViewpoint> all;
    while (true) {
        const std::vector<AtlasPlace> places = nextPlaces(grid, earthRadiusM, all);
        if (places.empty()) return all;
        for (const AtlasPlace& place : places) {
            AtlasViewpoint viewpoint{.place = place};
            viewpoint.figures.fill(std::numeric_limits<double>::quiet_NaN());
            viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::Triangles)] =
                value(middleOf(place.cell), place);
            all.push_back(viewpoint);
        }
    }
}

// A spike that no first cell's middle hits well: it falls off over 20 degrees.
const glm::dvec3 spike = directionFromGeographic({0.4, 1.1});
double spikeAt(const glm::dvec3& direction, const AtlasPlace&) {
    const double angle = std::acos(std::min(glm::dot(direction, spike), 1.0));
    return std::max(0.0, 1 - angle / 0.35);
}

TEST(AtlasSampling, BeginsWithEveryCellAltitudeAndHeading) {
    const AtlasGrid all = grid(5000);
    const std::vector<AtlasPlace> places = nextPlaces(all, earthRadiusM, {});
    EXPECT_EQ(places.size(), 6u * 16 * 2 * 2);
    EXPECT_EQ(std::set(places.begin(), places.end()).size(), places.size());
    for (const AtlasPlace& place : places) EXPECT_EQ(place.cell.level, 2);
}

TEST(AtlasSampling, BeginsCoarserIfTheViewpointsAreFew) {
    EXPECT_EQ(firstLevelOf(grid(5000)), 2);
    EXPECT_EQ(firstLevelOf(grid(1000)), 1);
    EXPECT_EQ(firstLevelOf(grid(100)), 0);
}

TEST(AtlasSampling, AUniformPlanetNeedsNoMoreThanTheFirstCells) {
    const auto all = surveyed(grid(5000), [](const glm::dvec3&, const AtlasPlace&) { return 7.0; });
    EXPECT_EQ(all.size(), 6u * 16 * 2 * 2);
}

TEST(AtlasSampling, RefinesAroundAPlantedSpikeAndNotElsewhere) {
    const AtlasGrid few = grid(2000);
    const auto all = surveyed(few, spikeAt);
    EXPECT_LE(all.size(), 2000u);
    EXPECT_GT(all.size(), 1900u);
    double nearest = 10, found = 0;
    for (const AtlasViewpoint& viewpoint : all) {
        const double angle = std::acos(std::min(glm::dot(middleOf(viewpoint.place.cell), spike), 1.0));
        nearest = std::min(nearest, angle);
        found = std::max(found, figureOf(viewpoint.figures, AtlasMeasure::Triangles));
        // The middle of a first cell is at most 0.37 from those of its quarters.
        if (viewpoint.place.cell.level > 3) {
            EXPECT_LT(angle, 0.35 + 0.4) << toString(viewpoint.place.cell);
        }
    }
    EXPECT_LT(nearest, 0.03);
    EXPECT_GT(found, 0.9);
}

TEST(AtlasSampling, AltitudesAreRefinedEachByItself) {
    const auto all = surveyed(grid(2000), [](const glm::dvec3& direction, const AtlasPlace& place) {
        return place.altitude == 1 ? spikeAt(direction, place) : 3.0;
    });
    for (const AtlasViewpoint& viewpoint : all) {
        if (viewpoint.place.cell.level > 2) {
            EXPECT_EQ(viewpoint.place.altitude, 1);
        }
    }
    EXPECT_GT(all.size(), 1000u);
}

TEST(AtlasSampling, AValueOfOneHeadingIsEnoughToRefine) {
    const auto all = surveyed(grid(2000), [](const glm::dvec3& direction, const AtlasPlace& place) {
        return place.heading == 1 ? spikeAt(direction, place) : 0.0;
    });
    EXPECT_GT(all.size(), 1000u);
}

TEST(AtlasSampling, CellsNarrowerThanTheAltitudeAreNotSplit) {
    AtlasGrid high = grid(5000);
    high.altitudesM = {4'000'000};
    for (const AtlasViewpoint& viewpoint : surveyed(high, spikeAt)) EXPECT_LE(viewpoint.place.cell.level, 2);
}

TEST(AtlasSampling, CellsThatWereSplitAreNotAmongTheCells) {
    const AtlasGrid few = grid(2000);
    const auto all = surveyed(few, spikeAt);
    double area = 0;
    for (const AtlasCell& cell : cellsOf(few, all)) area += std::ldexp(1.0, -2 * cell.cell.level);
    EXPECT_EQ(area, 6 * 2);  // each altitude covers the six faces once
}

}  // namespace
}  // namespace planet
