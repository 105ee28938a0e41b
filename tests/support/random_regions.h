// Regions of every kind at random, for tests that have to hold for all of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "planet/tree/region.h"

namespace planet {

template <class Random>
std::vector<Region> randomRegions(Random& random, double radiusM, std::size_t count = 6) {
    const auto within = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto point = [&] {
        return RegionPoint{std::asin(within(-1, 1)) * 180 / std::numbers::pi, within(-180, 180)};
    };
    // A star around a point, whose edges cannot cross.
    const auto polygon = [&] {
        const RegionPoint middle{within(-60, 60), within(-120, 120)};
        RegionPolygon corners;
        const int sides = 3 + static_cast<int>(within(0, 9));
        for (int i = 0; i < sides; ++i) {
            const double turn = 2 * std::numbers::pi * (i + within(0.1, 0.9)) / sides;
            const double reach = within(4, 25);
            corners.push_back(
                {middle.latitudeDeg + reach * std::sin(turn), middle.longitudeDeg + reach * std::cos(turn)});
        }
        if (within(0, 1) < 0.5) std::reverse(corners.begin(), corners.end());
        return corners;
    };
    std::vector<Region> regions;
    while (regions.size() < count) {
        Region region;
        region.name = "region " + std::to_string(regions.size());
        const int kind = static_cast<int>(within(0, 4));
        for (int i = 0; kind != 1 && kind != 3 && i < 1 + static_cast<int>(within(0, 3)); ++i)
            region.circles.push_back({point(), radiusM * std::exp(within(std::log(0.01), std::log(1.5)))});
        if (kind == 1 || kind == 2) region.polygons.push_back(polygon());
        if (kind == 3 || within(0, 1) < 0.3) {
            const double lowM = radiusM * within(-0.02, 0.03);
            region.heights = HeightBand{lowM, lowM + radiusM * within(0, 0.02), radiusM * within(0, 0.01)};
        }
        if (within(0, 1) < 0.7) region.borderM = radiusM * within(0, 0.5);
        if (within(0, 1) < 0.8) region.tauFactor = std::exp2(within(-4, 4));
        if (within(0, 1) < 0.3) region.leastLevel = static_cast<int>(within(0, 5));
        if (within(0, 1) < 0.3) region.mostLevel = static_cast<int>(within(0, 5));
        if (region.leastLevel > region.mostLevel && region.mostLevel)
            std::swap(region.leastLevel, region.mostLevel);
        if (within(0, 1) < 0.3)
            region.metric = within(0, 1) < 0.5 ? ErrorMetric::Additive : ErrorMetric::Tight;
        // A star of long arms may have edges that meet after all.
        std::vector<Region> alone{region};
        if (checkRegions(alone)) regions.push_back(std::move(region));
    }
    return regions;
}

}  // namespace planet
