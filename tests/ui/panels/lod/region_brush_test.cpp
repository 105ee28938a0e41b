#include "ui/panels/lod/region_brush.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace worldy::ui {
namespace {

constexpr double planetM = 1e6;

glm::dvec3 groundAt(double alongM) {
    return 1.01 * planetM * glm::dvec3(std::cos(alongM / planetM), std::sin(alongM / planetM), 0);
}

BrushStroke still(double alongM) {
    return {groundAt(alongM), groundAt(alongM)};
}

// Returns how far the worst place along a way is from the nearest centre of a circle, metres.
double farthestFromCentresM(const planet::Region& region, double wayM) {
    double farthestM = 0;
    for (double alongM = 0; alongM <= wayM; alongM += 50) {
        double nearestM = 1e9;
        for (const planet::RegionCircle& circle : region.circles)
            nearestM =
                std::min(nearestM, std::abs(circle.centre.longitudeDeg * M_PI / 180 * planetM - alongM));
        farthestM = std::max(farthestM, nearestM);
    }
    return farthestM;
}

RegionSettings oneRegion() {
    planet::Region region;
    region.name = "painted";
    return {.list = std::make_shared<const std::vector<planet::Region>>(1, region)};
}

TEST(RegionBrush, AStrokeCoversItsWayWithFewCircles) {
    RegionSettings regions = oneRegion();
    const RegionBrush brush{BrushMode::Paint, 1000};
    for (double alongM = 0; alongM <= 10'000; alongM += 10) paint(brush, 0, still(alongM), planetM, regions);
    const planet::Region region = regions.all()[0];
    EXPECT_GT(region.circles.size(), 10u);
    EXPECT_LT(region.circles.size(), 40u);
    for (const planet::RegionCircle& circle : region.circles) EXPECT_EQ(circle.radiusM, 1000);
    EXPECT_LT(farthestFromCentresM(region, 10'000), 350);
    const auto before = regions.list;
    paint(brush, 0, still(5000), planetM, regions);
    EXPECT_EQ(regions.list, before) << "nothing new is covered";
}

TEST(RegionBrush, AFastPointerLeavesNoGaps) {
    RegionSettings fast = oneRegion();
    paint({BrushMode::Paint, 1000}, 0, still(0), planetM, fast);
    paint({BrushMode::Paint, 1000}, 0, {groundAt(0), groundAt(10'000)}, planetM, fast);
    EXPECT_LT(farthestFromCentresM(fast.all()[0], 10'000), 350);
    paint({BrushMode::Erase, 1000}, 0, {groundAt(0), groundAt(10'000)}, planetM, fast);
    EXPECT_TRUE(fast.all()[0].circles.empty());
    // A stroke around half of the planet has an end, however small the brush is.
    paint({BrushMode::Paint, 1}, 0, {groundAt(0), groundAt(3 * planetM)}, planetM, fast);
    EXPECT_LE(fast.all()[0].circles.size(), std::size_t{mostBrushSteps});
    EXPECT_GT(fast.all()[0].circles.size(), 100u);
}

TEST(RegionBrush, ErasesTheCirclesUnderItAndNoOthers) {
    RegionSettings regions = oneRegion();
    for (double alongM = 0; alongM <= 10'000; alongM += 500)
        paint({BrushMode::Paint, 600}, 0, still(alongM), planetM, regions);
    const std::size_t all = regions.all()[0].circles.size();
    paint({BrushMode::Erase, 1'100}, 0, still(5'000), planetM, regions);
    EXPECT_EQ(regions.all()[0].circles.size(), all - 5);
    const auto before = regions.list;
    paint({BrushMode::Erase, 1'100}, 0, still(5'000), planetM, regions);
    paint({BrushMode::Off, 1'100}, 0, still(0), planetM, regions);
    paint({BrushMode::Paint, 1'100}, 1, still(0), planetM, regions);
    EXPECT_EQ(regions.list, before);
}

TEST(RegionBrush, AFullRegionTakesNoMore) {
    planet::Region region;
    region.name = "full";
    region.circles.assign(planet::mostCircles, {{80, 0}, 1});
    RegionSettings regions{.list = std::make_shared<const std::vector<planet::Region>>(1, region)};
    paint({BrushMode::Paint, 1000}, 0, still(0), planetM, regions);
    EXPECT_EQ(regions.all()[0].circles.size(), planet::mostCircles);
}

TEST(RegionBrush, AClosedPolygonIsOfTheRegionAndABadOneIsKeptToBeMended) {
    planet::Region region = oneRegion().list->front();
    planet::RegionPolygon corners = {{0, 0}, {0, 2}, {2, 0}, {2, 2}};
    const auto crossing = closePolygon(corners, region);
    ASSERT_FALSE(crossing);
    EXPECT_TRUE(region.polygons.empty());
    ASSERT_EQ(corners.size(), 4u);
    corners.pop_back();
    ASSERT_TRUE(closePolygon(corners, region));
    EXPECT_TRUE(corners.empty());
    ASSERT_EQ(region.polygons.size(), 1u);
    EXPECT_EQ(region.polygons[0].size(), 3u);
}

TEST(RegionBrush, TheDraftIsWhatTheBrushWouldAdd) {
    const planet::RegionPolygon corners = {{0, 0}, {0, 2}};
    const auto at = groundAt(1000);
    EXPECT_EQ(draftAt({BrushMode::Off, 500}, corners, at), planet::Region{});
    EXPECT_EQ(draftAt({BrushMode::Paint, 500}, corners, at).circles.size(), 1u);
    EXPECT_EQ(draftAt({BrushMode::Paint, 500}, corners, {}), planet::Region{});
    const planet::Region draft = draftAt({BrushMode::Polygon, 500}, corners, at);
    ASSERT_EQ(draft.polygons.size(), 1u);
    EXPECT_EQ(draft.polygons[0].size(), 3u);
    EXPECT_EQ(draftAt({BrushMode::Polygon, 500}, corners, {}).polygons[0], corners);
    EXPECT_EQ(draftAt({BrushMode::Polygon, 500}, {}, at), planet::Region{});
}

}  // namespace
}  // namespace worldy::ui
