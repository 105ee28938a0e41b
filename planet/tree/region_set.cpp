#include "planet/tree/region_set.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "planet/base/try.h"
#include "planet/tree/sphere_polygon.h"

namespace planet {

namespace {

// Covers the rounding of angles, less than a millimetre on Earth.
constexpr double slackRad = 1e-10;

// Returns the weight at a distance from what a region covers; at most 0 inside.
double weightAt(double distance, double border) {
    if (distance <= 0) return 1;
    return distance < border ? 1 - distance / border : 0;
}

// Lays a value over the one below. Among the weights of an area, the extremes lie at their ends.
double laidOver(double below, double own, double weight) {
    return weight <= 0 ? below : weight >= 1 ? own : below + (own - below) * weight;
}

float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) > value ? std::nextafter(nearest, 0.0f) : nearest;
}

std::uint8_t levelFrom(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::ceil(value), 0.0, static_cast<double>(maxLevel)));
}

}  // namespace

Result<std::shared_ptr<const RegionSet>> RegionSet::make(std::vector<Region> regions,
                                                         const PlanetShape& shape) {
    TRY(checkRegions(regions));
    return std::shared_ptr<const RegionSet>(new RegionSet(std::move(regions), shape));
}

RegionSet::~RegionSet() = default;

RegionSet::RegionSet(std::vector<Region> regions, const PlanetShape& shape)
    : regions_(std::move(regions)), shape_(shape) {
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
        const Region& region = regions_[i];
        if (!region.on) continue;
        for (const RegionCircle& circle : region.circles) {
            shapes_.push_back({i, -1, directionOf(circle.centre), circle.radiusM / shape_.radiusM});
        }
        for (const RegionPolygon& polygon : region.polygons) {
            std::vector<glm::dvec3> corners;
            corners.reserve(polygon.size());
            for (const RegionPoint& corner : polygon) corners.push_back(directionOf(corner));
            polygons_.push_back(SpherePolygon::make(corners).value());
            const DirectionCone& cone = polygons_.back().cone();
            shapes_.push_back(
                {i, static_cast<std::int32_t>(polygons_.size()) - 1, cone.axis, cone.halfAngleRad});
        }
        if (region.heights && region.circles.empty() && region.polygons.empty())
            shapes_.push_back({i, -1, glm::dvec3(0, 0, 1), 2 * std::numbers::pi});
        if (region.tauFactor) byTau_.push_back(i);
        if (region.leastLevel) byLeastLevel_.push_back(i);
        if (region.mostLevel) byMostLevel_.push_back(i);
        choosesMetrics_ |= region.metric.has_value();
    }
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) allParts_.push_back({i, false});
    // The strictest comes last, on top.
    std::stable_sort(byTau_.begin(), byTau_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return *regions_[a].tauFactor > *regions_[b].tauFactor;
    });
    std::stable_sort(byLeastLevel_.begin(), byLeastLevel_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return *regions_[a].leastLevel < *regions_[b].leastLevel;
    });
    std::stable_sort(byMostLevel_.begin(), byMostLevel_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return *regions_[a].mostLevel < *regions_[b].mostLevel;
    });
}

RegionSet::Weight RegionSet::weightOf(const Shape& shape, const GroundArea& area) const {
    const double border = regions_[shape.region].borderM / shape_.radiusM;
    const double halfAngle = area.cone.halfAngleRad + slackRad;
    // A chord is at most as long as its arc.
    const double reach = shape.radiusRad + border + halfAngle;
    const glm::dvec3 away = area.cone.axis - shape.centre;
    if (glm::dot(away, away) > reach * reach) return {};
    const double distance =
        shape.polygon < 0
            ? angleBetweenRad(area.cone.axis, shape.centre) - shape.radiusRad
            : polygons_[static_cast<std::size_t>(shape.polygon)].signedDistanceRad(area.cone.axis);
    return {weightAt(distance + halfAngle, border), weightAt(distance - halfAngle, border)};
}

RegionSet::Weight RegionSet::bandWeight(const HeightBand& band, const GroundArea& area) {
    const double nearestM = std::max(band.lowestM - area.highestM, area.lowestM - band.highestM);
    const double farthestM = std::max(band.lowestM - area.lowestM, area.highestM - band.highestM);
    return {weightAt(farthestM, band.borderM), weightAt(nearestM, band.borderM)};
}

std::vector<RegionSet::Weight> RegionSet::weightsIn(const GroundArea& area, const Parts& among) const {
    std::vector<Weight> weights(regions_.size());
    for (const Part& part : among) {
        const Shape& shape = shapes_[part.shape];
        Weight& of = weights[shape.region];
        if (of.low >= 1) continue;
        const Weight found = part.covers ? Weight{1, 1} : weightOf(shape, area);
        of.low = std::max(of.low, found.low);
        of.high = std::max(of.high, found.high);
    }
    for (std::size_t i = 0; i < regions_.size(); ++i) {
        if (weights[i].high <= 0 || !regions_[i].heights) continue;
        const Weight band = bandWeight(*regions_[i].heights, area);
        weights[i] = {std::min(weights[i].low, band.low), std::min(weights[i].high, band.high)};
    }
    return weights;
}

RegionSet::Parts RegionSet::partsIn(const GroundArea& area, const Parts& among) const {
    Parts parts;
    std::uint32_t covered = std::numeric_limits<std::uint32_t>::max();
    for (const Part& part : among) {
        const Shape& shape = shapes_[part.shape];
        if (shape.region == covered) continue;
        const Weight weight = part.covers ? Weight{1, 1} : weightOf(shape, area);
        if (weight.high <= 0) continue;
        if (weight.low < 1) {
            parts.push_back(part);
            continue;
        }
        // The other shapes of the region add nothing.
        covered = shape.region;
        while (!parts.empty() && shapes_[parts.back().shape].region == covered) parts.pop_back();
        parts.push_back({part.shape, true});
    }
    return parts;
}

RegionSet::Decided RegionSet::tauIn(std::span<const Weight> weights) const {
    Decided factor;
    for (const std::uint32_t i : byTau_) {
        if (weights[i].high <= 0) continue;
        const double own = std::log2(*regions_[i].tauFactor);
        const double low = laidOver(factor.value, own, weights[i].low);
        const double strict = std::min(low, laidOver(factor.value, own, weights[i].high));
        // A lenient region whose weight may be 0 changes nothing.
        if (strict != factor.value || weights[i].low >= 1) factor = {strict, i};
    }
    return factor;
}

RegionSet::Decided RegionSet::leastLevelIn(std::span<const Weight> weights) const {
    Decided level;
    for (const std::uint32_t i : byLeastLevel_) {
        const double own = *regions_[i].leastLevel;
        const double strict =
            std::max(laidOver(level.value, own, weights[i].low), laidOver(level.value, own, weights[i].high));
        if (strict != level.value) level = {strict, i};
    }
    return level;
}

RegionSet::Decided RegionSet::mostLevelIn(std::span<const Weight> weights) const {
    const double deepest = deepestLevelOf(shape_);
    Decided level{deepest, std::nullopt};
    for (const std::uint32_t i : byMostLevel_) {
        if (weights[i].high <= 0) continue;
        const double own = std::min<double>(*regions_[i].mostLevel, deepest);
        const double strict =
            std::max(laidOver(level.value, own, weights[i].low), laidOver(level.value, own, weights[i].high));
        if (strict != level.value || (weights[i].low >= 1 && own < deepest)) level = {strict, i};
    }
    if (!level.by || level.value >= deepest) return {static_cast<double>(maxLevel), std::nullopt};
    return level;
}

// Any place makes the metric additive; only all of them make it tight.
std::optional<std::uint32_t> RegionSet::metricDecidedIn(std::span<const Weight> weights) const {
    std::optional<std::uint32_t> tight;
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
        if (!regions_[i].metric || weights[i].high < 1) continue;
        if (*regions_[i].metric == ErrorMetric::Additive) return i;
        if (weights[i].low >= 1 && !tight) tight = i;
    }
    return tight;
}

MetricRule RegionSet::metricIn(std::span<const Weight> weights) const {
    const std::optional<std::uint32_t> by = metricDecidedIn(weights);
    if (!by) return MetricRule::AsSet;
    return *regions_[*by].metric == ErrorMetric::Additive ? MetricRule::Additive : MetricRule::Tight;
}

ChunkDemand RegionSet::demandIn(const GroundArea& area, const Parts& among) const {
    if (among.empty()) return {};
    const std::vector<Weight> weights = weightsIn(area, among);
    ChunkDemand demand;
    const Decided tau = tauIn(weights);
    const Decided leastLevel = leastLevelIn(weights);
    const Decided mostLevel = mostLevelIn(weights);
    demand.tauFactor = roundedDown(std::exp2(tau.value));
    demand.leastLevel = levelFrom(leastLevel.value);
    demand.mostLevel = levelFrom(mostLevel.value);
    demand.metric = metricIn(weights);
    for (const std::optional<std::uint32_t>& by :
         {tau.by, leastLevel.by, mostLevel.by, metricDecidedIn(weights)}) {
        if (by && demand.region == noRegion) demand.region = static_cast<std::uint8_t>(*by);
    }
    return demand;
}

std::vector<RegionEffect> RegionSet::effectsIn(const GroundArea& area, const Parts& among) const {
    const std::vector<Weight> weights = weightsIn(area, among);
    const std::optional<std::uint32_t> tau = tauIn(weights).by;
    const std::optional<std::uint32_t> least = leastLevelIn(weights).by;
    const std::optional<std::uint32_t> most = mostLevelIn(weights).by;
    const std::optional<std::uint32_t> metric = metricDecidedIn(weights);
    std::vector<RegionEffect> effects;
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
        if (weights[i].high <= 0) continue;
        effects.push_back({i, regions_[i].name, weights[i].low, weights[i].high, tau == i, least == i,
                           most == i, metric == i});
    }
    return effects;
}

ChunkDemand withinParent(const ChunkDemand& own, const ChunkDemand& parent) {
    ChunkDemand demand{std::max(own.tauFactor, parent.tauFactor), std::min(own.leastLevel, parent.leastLevel),
                       std::min(own.mostLevel, parent.mostLevel), own.metric, own.region};
    // Additive is the strictest, tight the most lenient; the settings' metric lies between them.
    if (own.metric == MetricRule::Additive && parent.metric != MetricRule::Additive)
        demand.metric = parent.metric;
    if (parent.metric == MetricRule::Tight) demand.metric = MetricRule::Tight;
    return demand;
}

}  // namespace planet
