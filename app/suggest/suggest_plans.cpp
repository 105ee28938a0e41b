#include "app/suggest/suggest_plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/suggest/suggest_meter.h"
#include "planet/base/percentile.h"
#include "planet/tree/region.h"

namespace worldy {

planet::RegionCircle circleOver(std::span<const SuggestGround> ground, double radiusM) {
    constexpr double covered = 0.8;
    glm::dvec3 sum{0, 0, 0};
    for (const SuggestGround& one : ground) sum += one.direction;
    const glm::dvec3 middle = glm::length(sum) > 1e-9 ? glm::normalize(sum) : ground.front().direction;
    std::vector<double> angles;
    for (const SuggestGround& one : ground)
        angles.push_back(std::acos(std::clamp(glm::dot(middle, one.direction), -1.0, 1.0)) + one.angleRad);
    return {planet::pointOf(middle), std::max(planet::percentileOf(angles, covered) * radiusM, 1.0)};
}

planet::HeightBand bandOver(std::span<const SuggestGround> ground) {
    std::vector<double> heights;
    for (const SuggestGround& one : ground) heights.push_back(one.heightM);
    planet::HeightBand band{planet::percentileOf(heights, 0.2), planet::percentileOf(heights, 0.8)};
    band.borderM = (band.highestM - band.lowestM) / 4;
    return band;
}

std::string newRegionName(std::string_view plan, std::span<const planet::Region> taken) {
    const std::string first = fmt::format("suggested {}", plan);
    std::string name = first;
    for (int number = 2; std::ranges::any_of(taken, [&](const auto& one) { return one.name == name; });
         ++number)
        name = fmt::format("{} {}", first, number);
    return name;
}

bool isSuggestedName(std::string_view name) {
    return std::ranges::any_of(std::array{placesPlan, heightsPlan}, [&](std::string_view plan) {
        const std::string first = newRegionName(plan, {});
        return name == first || name.starts_with(first + ' ');
    });
}

std::vector<SuggestPlan> plansOver(std::span<const std::vector<SuggestGround>> frames, double radiusM,
                                   std::span<const planet::Region> taken) {
    constexpr double borderShare = 0.5;  // of the smallest circle
    planet::Region places{.name = newRegionName(placesPlan, taken)};
    std::vector<SuggestGround> all;
    for (const std::vector<SuggestGround>& ground : frames) {
        if (ground.empty()) continue;
        places.circles.push_back(circleOver(ground, radiusM));
        const double borderM = borderShare * places.circles.back().radiusM;
        places.borderM = places.circles.size() == 1 ? borderM : std::min(places.borderM, borderM);
        all.insert(all.end(), ground.begin(), ground.end());
    }
    if (all.empty()) return {};
    std::vector<SuggestPlan> plans{{std::string(placesPlan), {places}}};
    const planet::HeightBand band = bandOver(all);
    if (band.highestM - band.lowestM >= 1) {
        planet::Region heights{.name = newRegionName(heightsPlan, taken)};
        heights.heights = band;
        plans.push_back({std::string(heightsPlan), {heights}});
    }
    return plans;
}

}  // namespace worldy
