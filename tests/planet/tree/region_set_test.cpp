#include "planet/tree/region_set.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "planet/select/screen_error.h"
#include "tests/support/fake_selection.h"
#include "tests/support/random_regions.h"

namespace planet {
namespace {

constexpr double radiusM = 1e5;
const PlanetShape& regionShape() {
    return fakePyramid().shape;
}

std::shared_ptr<const RegionSet> setOf(std::vector<Region> regions) {
    return RegionSet::make(std::move(regions), regionShape()).value();
}

GroundArea placeAt(const glm::dvec3& direction, double heightM) {
    return {{direction, 0}, heightM, heightM};
}

// The test computes what the header says of a single place again, in the plainest way: angles by the haversine, insides by the
// angle that a polygon turns around a place, outlines by points along each edge.

double haversineRad(const glm::dvec3& a, const glm::dvec3& b) {
    return 2 * std::asin(std::min(1.0, glm::length(a - b) / 2));
}

bool turnsAround(const RegionPolygon& polygon, const glm::dvec3& at) {
    double turnRad = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 from = directionOf(polygon[i]);
        const glm::dvec3 to = directionOf(polygon[(i + 1) % polygon.size()]);
        const glm::dvec3 a = glm::cross(glm::cross(at, from), at);
        const glm::dvec3 b = glm::cross(glm::cross(at, to), at);
        turnRad += std::atan2(glm::dot(at, glm::cross(a, b)), glm::dot(a, b));
    }
    return std::abs(turnRad) > std::numbers::pi;
}

double outlineRad(const RegionPolygon& polygon, const glm::dvec3& at) {
    double nearestRad = std::numbers::pi;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 from = directionOf(polygon[i]);
        const glm::dvec3 to = directionOf(polygon[(i + 1) % polygon.size()]);
        const auto awayRad = [&](double share) {
            return haversineRad(at, glm::normalize(glm::mix(from, to, std::clamp(share, 0.0, 1.0))));
        };
        // Finer and finer steps around the nearest place.
        double nearest = 0.5;
        for (double step = 1.0 / 40; step > 1e-9; step /= 20) {
            const double middle = nearest;
            for (int k = -40; k <= 40; ++k)
                if (awayRad(middle + k * step) < awayRad(nearest)) nearest = middle + k * step;
        }
        nearestRad = std::min(nearestRad, awayRad(nearest));
    }
    return nearestRad;
}

double plainWeight(const Region& region, const glm::dvec3& at, double heightM) {
    double beyondM = std::numeric_limits<double>::infinity();
    for (const RegionCircle& circle : region.circles)
        beyondM = std::min(beyondM, haversineRad(at, directionOf(circle.centre)) * radiusM - circle.radiusM);
    for (const RegionPolygon& polygon : region.polygons) {
        // Nothing lies inside on the far side of the planet.
        glm::dvec3 middle{0, 0, 0};
        for (const RegionPoint& corner : polygon) middle += directionOf(corner);
        const bool inside = glm::dot(middle, at) > 0 && turnsAround(polygon, at);
        beyondM = std::min(beyondM, inside ? 0 : outlineRad(polygon, at) * radiusM);
    }
    double weight = beyondM <= 0 ? 1 : std::max(0.0, 1 - beyondM / region.borderM);
    if (region.heights) {
        const double offM =
            std::max({region.heights->lowestM - heightM, heightM - region.heights->highestM, 0.0});
        const double band = offM == 0 ? 1 : std::max(0.0, 1 - offM / region.heights->borderM);
        weight = region.circles.empty() && region.polygons.empty() ? band : std::min(weight, band);
    }
    return weight;
}

double plainTau(std::vector<Region> regions, const glm::dvec3& at, double heightM) {
    std::erase_if(regions, [](const Region& region) { return !region.tauFactor || !region.on; });
    std::sort(regions.begin(), regions.end(),
              [](const Region& a, const Region& b) { return *a.tauFactor > *b.tauFactor; });
    double factor = 1;
    for (const Region& region : regions) {
        const double weight = plainWeight(region, at, heightM);
        factor = std::pow(factor, 1 - weight) * std::pow(*region.tauFactor, weight);
    }
    return factor;
}

template <class Random>
glm::dvec3 randomDirection(Random& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// A place of a chunk and the height of the ground there, from its finest samples.
template <class Random>
std::pair<glm::dvec3, double> placeIn(Random& random, const ChunkId& id) {
    std::uniform_int_distribution<std::uint32_t> half(0, 1);
    ChunkId leaf = id;
    while (leaf.level < deepestLevelOf(regionShape()))
        leaf = childOf(leaf, static_cast<int>(half(random) + 2 * half(random)));
    std::uniform_int_distribution<int> cell(0, chunkCells(regionShape()));
    const int column = cell(random);
    const int row = cell(random);
    const ChunkData& chunk = fakePyramid().at(leaf);
    const auto at = static_cast<std::size_t>(row * chunkSize(regionShape()) + column);
    return {glm::normalize(vertexM(regionShape(), leaf, column, row, 0)),
            heightM(regionShape(), chunk.heights[at])};
}

TEST(RegionSet, TheFactorOfAPlaceIsThatOfTheFormula) {
    std::mt19937 random(61);
    int changed = 0;
    for (int i = 0; i < 40; ++i) {
        const std::vector<Region> regions = randomRegions(random, radiusM);
        const auto set = setOf(regions);
        for (int place = 0; place < 25; ++place) {
            const glm::dvec3 at = randomDirection(random);
            const double heightM = std::uniform_real_distribution<double>(-2500, 5000)(random);
            const double expected = plainTau(regions, at, heightM);
            const float found = set->demandIn(placeAt(at, heightM)).tauFactor;
            EXPECT_NEAR(found / expected, 1, 1e-5) << i << " " << place;
            changed += expected != 1;
        }
    }
    EXPECT_GT(changed, 300);
}

TEST(RegionSet, TheDemandOfAChunkIsAtLeastAsStrictAsThatOfAnyPlaceInIt) {
    std::mt19937 random(62);
    int tighter = 0;
    for (int i = 0; i < 30; ++i) {
        ChunkTree tree = wholeTree();
        setRegions(tree, setOf(randomRegions(random, radiusM)));
        for (int n = 0; n < 300; ++n) {
            const ChunkNode& node = tree.nodes[random() % tree.nodes.size()];
            float leastFactor = std::numeric_limits<float>::max();
            for (int p = 0; p < 12; ++p) {
                const auto [direction, heightM] = placeIn(random, node.id);
                const ChunkDemand at = tree.regions->demandIn(placeAt(direction, heightM));
                ASSERT_LE(node.demand.tauFactor, at.tauFactor) << toString(node.id);
                ASSERT_GE(node.demand.leastLevel, at.leastLevel) << toString(node.id);
                ASSERT_GE(node.demand.mostLevel, at.mostLevel) << toString(node.id);
                for (const ErrorMetric set : {ErrorMetric::Additive, ErrorMetric::Tight}) {
                    ASSERT_LE(metricBy(node.demand.metric, set), metricBy(at.metric, set));
                }
                leastFactor = std::min(leastFactor, at.tauFactor);
            }
            tighter += node.demand.tauFactor > 0.5f * leastFactor && node.demand.tauFactor != 1;
        }
    }
    EXPECT_GT(tighter, 2000) << "the demands are not just as strict as possible";
}

TEST(RegionSet, NoChunkDemandsMoreThanItsParent) {
    std::mt19937 random(63);
    for (int i = 0; i < 30; ++i) {
        ChunkTree tree = wholeTree();
        setRegions(tree, setOf(randomRegions(random, radiusM)));
        for (const ChunkNode& node : tree.nodes) {
            if (node.parent == noNode) continue;
            const ChunkDemand& above = tree.nodes[node.parent].demand;
            ASSERT_GE(node.demand.tauFactor, above.tauFactor);
            ASSERT_LE(node.demand.leastLevel, above.leastLevel);
            ASSERT_LE(node.demand.mostLevel, above.mostLevel);
            for (const ErrorMetric metric : {ErrorMetric::Additive, ErrorMetric::Tight})
                ASSERT_LE(deltaOf(node, metric), deltaOf(tree.nodes[node.parent], metric));
        }
    }
}

TEST(RegionSet, DemandsDoNotDependOnWhenAChunkIsLoaded) {
    std::mt19937 random(64);
    for (int i = 0; i < 10; ++i) {
        const auto set = setOf(randomRegions(random, radiusM));
        ChunkTree before = residentTree(fakePyramid(), 0);
        setRegions(before, set);
        for (NodeIndex n = 0; n < before.nodes.size(); ++n)
            if (before.nodes[n].childrenState == ChildrenState::Absent) addFakeChildren(before, n);
        ChunkTree after = wholeTree();
        setRegions(after, set);
        ASSERT_EQ(before.nodes.size(), after.nodes.size());
        for (const ChunkNode& node : before.nodes)
            ASSERT_EQ(node.demand, after.nodes[findNode(after, node.id)].demand) << toString(node.id);
        setRegions(after, nullptr);
        for (const ChunkNode& node : after.nodes) ASSERT_EQ(node.demand, ChunkDemand{});
    }
}

TEST(RegionSet, HeightsStayThoseOfTheGroundThroughExaggeration) {
    ChunkTree tree = wholeTree();
    setRegions(tree, setOf({{.name = "peaks", .heights = HeightBand{2000, 9000, 0}, .tauFactor = 0.5}}));
    std::vector<ChunkDemand> plain;
    for (const ChunkNode& node : tree.nodes) plain.push_back(node.demand);
    EXPECT_TRUE(
        std::any_of(plain.begin(), plain.end(), [](const auto& demand) { return demand.tauFactor == 0.5f; }));
    EXPECT_TRUE(
        std::any_of(plain.begin(), plain.end(), [](const auto& demand) { return demand.tauFactor == 1; }));
    setExaggeration(tree, 5);
    setRegions(tree, tree.regions);
    for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_EQ(tree.nodes[i].demand, plain[i]);
}

// The values at a few distances from one circle of factor 1/4 and a soft border of 10 km.
TEST(RegionSet, ASoftBorderFallsByEqualRatios) {
    const auto set = setOf({{.name = "soft",
                             .circles = {{{0, 0}, 5'000}},
                             .borderM = 10'000,
                             .tauFactor = 0.25,
                             .leastLevel = 4}});
    const auto at = [&](double alongM) {
        const double angle = alongM / radiusM;
        return set->demandIn(placeAt({std::cos(angle), std::sin(angle), 0}, 0));
    };
    EXPECT_FLOAT_EQ(at(0).tauFactor, 0.25f);
    EXPECT_FLOAT_EQ(at(4'999).tauFactor, 0.25f);
    EXPECT_NEAR(at(10'000).tauFactor, 0.5, 1e-6);
    EXPECT_NEAR(at(12'500).tauFactor, std::pow(0.25, 0.25), 1e-6);
    EXPECT_EQ(at(15'001).tauFactor, 1);
    EXPECT_EQ(at(0).leastLevel, 4);
    EXPECT_EQ(at(10'001).leastLevel, 2);
    EXPECT_EQ(at(14'999).leastLevel, 1);
    EXPECT_EQ(at(15'001).leastLevel, 0);
}

TEST(RegionSet, TheStrictestOfOverlappingRegionsWinsInAnyOrder) {
    const RegionCircle here{{0, 0}, 5'000};
    std::vector<Region> regions = {{.name = "coarse", .circles = {here}, .tauFactor = 4.0, .mostLevel = 1},
                                   {.name = "fine",
                                    .circles = {here},
                                    .tauFactor = 0.5,
                                    .leastLevel = 2,
                                    .mostLevel = 3,
                                    .metric = ErrorMetric::Additive},
                                   {.name = "tight", .circles = {here}, .metric = ErrorMetric::Tight}};
    const GroundArea ground = placeAt({1, 0, 0}, 0);
    std::sort(regions.begin(), regions.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    do {
        const ChunkDemand demand = setOf(regions)->demandIn(ground);
        EXPECT_EQ(regions[demand.region].name, "fine");
        EXPECT_EQ(demand, (ChunkDemand{0.5f, 2, 3, MetricRule::Additive, demand.region}));
    } while (std::next_permutation(regions.begin(), regions.end(),
                                   [](const auto& a, const auto& b) { return a.name < b.name; }));
    regions[1].on = false;
    EXPECT_EQ(regions[1].name, "fine");
    EXPECT_EQ(setOf(regions)->demandIn(ground), (ChunkDemand{4, 0, 1, MetricRule::Tight, 0}));
}

TEST(RegionSet, EffectsNameWhatDecides) {
    ChunkTree tree = wholeTree();
    const RegionCircle everywhere{{0, 0}, 1e9};
    setRegions(tree, setOf({{.name = "all", .circles = {everywhere}, .tauFactor = 2.0},
                            {.name = "spot", .circles = {{{0, 0}, 1'000}}, .tauFactor = 0.5, .leastLevel = 3},
                            {.name = "nowhere", .tauFactor = 0.25},
                            {.name = "off", .on = false, .circles = {everywhere}, .tauFactor = 0.1}}));
    const std::vector<RegionEffect> root = regionEffects(tree, findNode(tree, {Face::PosX, 0, 0, 0}));
    ASSERT_EQ(root.size(), 2u);
    EXPECT_EQ(root[0].name, "all");
    EXPECT_FALSE(root[0].decides());
    EXPECT_EQ(root[1].name, "spot");
    EXPECT_TRUE(root[1].setsTauFactor && root[1].setsLeastLevel);
    EXPECT_FALSE(root[1].setsMostLevel || root[1].setsMetric);
    EXPECT_EQ(root[1].leastWeight, 0);
    EXPECT_EQ(root[1].mostWeight, 1);
    const std::vector<RegionEffect> away = regionEffects(tree, findNode(tree, {Face::NegX, 0, 0, 0}));
    ASSERT_EQ(away.size(), 1u);
    EXPECT_TRUE(away[0].setsTauFactor);
    EXPECT_EQ(away[0].leastWeight, 1);
}

// Files that are refused.

std::string refusal(Region region) {
    const std::vector<Region> regions{std::move(region)};
    const Result<void> checked = checkRegions(regions);
    return checked ? "" : checked.error().message;
}

Region named(std::string name) {
    Region region;
    region.name = std::move(name);
    return region;
}

Region withPolygon(RegionPolygon polygon) {
    Region region = named("r");
    region.polygons = {std::move(polygon)};
    return region;
}

TEST(Region, WrongValuesAreRefusedByName) {
    Region region = named("Valley");
    EXPECT_EQ(refusal(region), "");
    region.circles = {{{0, 0}, 5}, {{0, 0}, -5}};
    EXPECT_EQ(refusal(region),
              "region 1 \"Valley\": circle 2: radius_m: -5 is out of range; expected above 0 and at most "
              "10000000000");
    region.circles = {{{91, 0}, 5}};
    EXPECT_EQ(refusal(region), "region 1 \"Valley\": circle 1: lat: 91 is out of range; expected [-90, 90]");
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    region.circles = {{{0, nan}, 5}};
    EXPECT_NE(refusal(region).find("lon: nan is out of range"), std::string::npos);
    region.circles.clear();
    region.tauFactor = 0;
    EXPECT_NE(refusal(region).find("tau_factor: 0 is out of range; expected [0.015625, 64]"),
              std::string::npos);
    region.tauFactor = nan;
    EXPECT_NE(refusal(region).find("tau_factor: nan"), std::string::npos);
    region.tauFactor.reset();
    region.leastLevel = maxLevel + 1;
    EXPECT_NE(refusal(region).find("least_level: 25 is out of range; expected [0, 24]"), std::string::npos);
    region.leastLevel = 5;
    region.mostLevel = 2;
    EXPECT_NE(refusal(region).find(
                  "least_level: 5 is larger than most_level, 2; expected at most 2, or a larger most_level"),
              std::string::npos);
    region.mostLevel = 5;
    EXPECT_EQ(refusal(region), "");
    region.leastLevel.reset();
    region.mostLevel.reset();
    region.heights = HeightBand{10, 5, 0};
    EXPECT_NE(refusal(region).find("heights_m: 10 to 5 is empty; expected the lowest height first"),
              std::string::npos);
    region.heights.reset();
    region.circles.assign(mostCircles + 1, {{0, 0}, 1});
    EXPECT_NE(refusal(region).find("circles: 4097 of them; expected at most 4096"), std::string::npos);
    EXPECT_NE(refusal(named("")).find("name: 0 bytes"), std::string::npos);
    EXPECT_NE(refusal(named("a\nb")).find("control characters"), std::string::npos);
    const std::vector<Region> twice = {named("a"), named("a")};
    EXPECT_EQ(checkRegions(twice).error().message,
              "region 2 \"a\": name: another region has it; expected a unique name");
}

TEST(Region, PolygonsThatAreNoneAreRefused) {
    EXPECT_EQ(refusal(withPolygon({{0, 0}, {0, 10}, {10, 0}})), "");
    EXPECT_NE(refusal(withPolygon({{0, 0}, {0, 10}})).find("2 corners; expected at least 3"),
              std::string::npos);
    EXPECT_NE(
        refusal(withPolygon({{0, 0}, {0, 10}, {10, 0}, {0, 0}})).find("corners 4 and 1 are the same place"),
        std::string::npos);
    EXPECT_NE(refusal(withPolygon({{0, 0}, {10, 10}, {10, 0}, {0, 10}}))
                  .find("the edges from corner 1 and from corner 3 meet"),
              std::string::npos);
    EXPECT_NE(
        refusal(withPolygon({{0, 0}, {0, 170}, {80, 90}})).find("degrees from the middle of all corners"),
        std::string::npos);
    RegionPolygon many;
    for (std::size_t i = 0; i <= mostCorners; ++i)
        many.push_back({10 * std::sin(0.001 * static_cast<double>(i)), 0.01 * static_cast<double>(i)});
    EXPECT_NE(refusal(withPolygon(many)).find("corners: 1001 of them"), std::string::npos);
    // A spike that runs back over itself.
    EXPECT_NE(refusal(withPolygon({{0, 0}, {0, 10}, {0, 5}, {10, 0}})).find("meet"), std::string::npos);
}

TEST(Region, APolygonMayCrossTheDateLineAndHoldAPole) {
    const auto set = setOf(
        {{.name = "date line", .polygons = {{{-5, 175}, {-5, -175}, {5, -175}, {5, 175}}}, .tauFactor = 0.5},
         {.name = "pole", .polygons = {{{70, 0}, {70, 90}, {70, 180}, {70, -90}}}, .tauFactor = 0.25}});
    const auto factorAt = [&](double latitudeDeg, double longitudeDeg) {
        return set->demandIn(placeAt(directionOf({latitudeDeg, longitudeDeg}), 0)).tauFactor;
    };
    EXPECT_EQ(factorAt(0, 180), 0.5f);
    EXPECT_EQ(factorAt(0, -178), 0.5f);
    EXPECT_EQ(factorAt(0, 170), 1);
    EXPECT_EQ(factorAt(0, 0), 1);
    EXPECT_EQ(factorAt(90, 0), 0.25f);
    EXPECT_EQ(factorAt(80, 45), 0.25f);
    EXPECT_EQ(factorAt(-90, 0), 1);
}

}  // namespace
}  // namespace planet
