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

RegionSettings oneRegion() {
    planet::Region region;
    region.name = "painted";
    return {.list = std::make_shared<const std::vector<planet::Region>>(1, region)};
}

TEST(RegionBrush, AStrokeCoversItsWayWithFewCircles) {
    RegionSettings regions = oneRegion();
    const RegionBrush brush{BrushMode::Paint, 1000};
    for (double alongM = 0; alongM <= 10'000; alongM += 10)
        paint(brush, 0, groundAt(alongM), planetM, regions);
    const planet::Region region = regions.all()[0];
    EXPECT_GT(region.circles.size(), 10u);
    EXPECT_LT(region.circles.size(), 40u);
    for (const planet::RegionCircle& circle : region.circles) EXPECT_EQ(circle.radiusM, 1000);
    // Every place along the way lies deep in one of them.
    for (double alongM = 0; alongM <= 10'000; alongM += 50) {
        double nearestM = 1e9;
        for (const planet::RegionCircle& circle : region.circles)
            nearestM =
                std::min(nearestM, std::abs(circle.centre.longitudeDeg * M_PI / 180 * planetM - alongM));
        EXPECT_LT(nearestM, 350) << alongM;
    }
    const auto before = regions.list;
    paint(brush, 0, groundAt(5000), planetM, regions);
    EXPECT_EQ(regions.list, before) << "nothing new is covered";
}

TEST(RegionBrush, ErasesTheCirclesUnderItAndNoOthers) {
    RegionSettings regions = oneRegion();
    for (double alongM = 0; alongM <= 10'000; alongM += 500)
        paint({BrushMode::Paint, 600}, 0, groundAt(alongM), planetM, regions);
    const std::size_t all = regions.all()[0].circles.size();
    paint({BrushMode::Erase, 1'100}, 0, groundAt(5'000), planetM, regions);
    EXPECT_EQ(regions.all()[0].circles.size(), all - 5);
    const auto before = regions.list;
    paint({BrushMode::Erase, 1'100}, 0, groundAt(5'000), planetM, regions);
    paint({BrushMode::Off, 1'100}, 0, groundAt(0), planetM, regions);
    paint({BrushMode::Paint, 1'100}, 1, groundAt(0), planetM, regions);
    EXPECT_EQ(regions.list, before);
}

TEST(RegionBrush, AFullRegionTakesNoMore) {
    planet::Region region;
    region.name = "full";
    region.circles.assign(planet::mostCircles, {{80, 0}, 1});
    RegionSettings regions{.list = std::make_shared<const std::vector<planet::Region>>(1, region)};
    paint({BrushMode::Paint, 1000}, 0, groundAt(0), planetM, regions);
    EXPECT_EQ(regions.all()[0].circles.size(), planet::mostCircles);
}

}  // namespace
}  // namespace worldy::ui
