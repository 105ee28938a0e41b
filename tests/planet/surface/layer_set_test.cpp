#include "planet/surface/layer_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "planet/surface/layer_noise.h"
#include "tests/support/layer_relief.h"

namespace planet {
namespace {

LayerPlace placeAt(double heightM, double slopeDeg = 0, double latitudeDeg = 0) {
    return {{6.371e6, 0, 0}, heightM, slopeDeg, latitudeDeg};
}

LayerSet setOf(std::vector<TextureLayer> layers, LayerBlend blend = LayerBlend::Weight) {
    LayerSet set;
    set.blend = blend;
    set.layers = std::move(layers);
    return set;
}

TEST(LayerSet, ALayerWithoutRangesCoversEverything) {
    const LayerSet set = setOf({TextureLayer{}});
    for (const double height : {-20000.0, -300.0, 0.0, 20000.0}) {
        for (const double slope : {0.0, 45.0, 90.0}) {
            for (const double latitude : {-90.0, 0.0, 90.0})
                EXPECT_EQ(layerWeights(set, placeAt(height, slope, latitude))[0], 1);
        }
    }
}

TEST(LayerSet, ARangesEndIsHalfAndItsEdgeAStraightLine) {
    TextureLayer layer;
    layer.heightM = {100, 500, 40};
    const LayerSet set = setOf({layer});
    const std::vector<std::pair<double, double>> expected = {
        {79, 0}, {80, 0}, {90, 0.25}, {100, 0.5}, {120, 1}, {300, 1}, {490, 0.75}, {500, 0.5}, {520, 0}};
    for (const auto& [height, weight] : expected)
        EXPECT_NEAR(layerWeights(set, placeAt(height))[0], weight, 1e-12) << height;
}

TEST(LayerSet, HeightSlopeAndLatitudeAllHaveToAgree) {
    TextureLayer layer;
    layer.heightM = {0, 1000, 0};
    layer.slopeDeg = {20, 40, 10};
    layer.latitudeDeg = {-30, 30, 20};
    layer.opacity = 0.8;
    const LayerSet set = setOf({layer});
    EXPECT_NEAR(layerWeights(set, placeAt(500, 30, 0))[0], 0.8, 1e-12);
    EXPECT_NEAR(layerWeights(set, placeAt(500, 20, 30))[0], 0.8 * 0.5 * 0.5, 1e-12);
    EXPECT_EQ(layerWeights(set, placeAt(-1, 30, 0))[0], 0);
    EXPECT_EQ(layerWeights(set, placeAt(500, 46, 0))[0], 0);
    EXPECT_EQ(layerWeights(set, placeAt(500, 30, -41))[0], 0);
}

TEST(LayerSet, TheTwoLayerBlendIsHeightOver255) {
    const LayerSet set = twoLayerHeightBlend();
    ASSERT_EQ(set.layers.size(), 2u);
    for (int height = -100; height <= 400; height += 5) {
        const double rock = std::clamp(height / 255.0, 0.0, 1.0);
        const LayerValues weights = layerWeights(set, placeAt(height, 60, 80));
        EXPECT_NEAR(weights[0], 1 - rock, 1e-9) << height;
        EXPECT_NEAR(weights[1], rock, 1e-9) << height;
    }
}

TEST(LayerSet, LaterLayersArePaintedOverEarlierOnes) {
    TextureLayer below, above;
    above.opacity = 0.25;
    LayerSet set = setOf({below, above});
    EXPECT_NEAR(layerWeights(set, placeAt(0))[0], 0.75, 1e-12);
    EXPECT_NEAR(layerWeights(set, placeAt(0))[1], 0.25, 1e-12);
    std::swap(set.layers[0], set.layers[1]);
    EXPECT_EQ(layerWeights(set, placeAt(0))[0], 0);
    EXPECT_EQ(layerWeights(set, placeAt(0))[1], 1);
}

TEST(LayerSet, MuteLeavesOutAndSoloLeavesTheOthersOut) {
    LayerSet set = setOf({TextureLayer{}, TextureLayer{}, TextureLayer{}});
    set.layers[2].muted = true;
    EXPECT_THAT(layerWeights(set, placeAt(0)), testing::ElementsAre(0, 1, 0, 0, 0, 0, 0, 0));
    set.layers[0].solo = true;
    EXPECT_THAT(layerWeights(set, placeAt(0)), testing::ElementsAre(1, 0, 0, 0, 0, 0, 0, 0));
    set.layers[0].muted = true;
    EXPECT_THAT(layerWeights(set, placeAt(0)), testing::Each(0));
}

TEST(LayerSet, WeightsNeverSumToMoreThanOne) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> height(-6000, 9000), slope(0, 90), latitude(-90, 90),
        at(-7e6, 7e6);
    const LayerSet set = earthLayers();
    for (int i = 0; i < 2000; ++i) {
        const LayerPlace place{
            {at(random), at(random), at(random)}, height(random), slope(random), latitude(random)};
        const LayerValues weights = layerWeights(set, place);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        EXPECT_THAT(weights, testing::Each(testing::AllOf(testing::Ge(0), testing::Le(1))));
        EXPECT_LE(sum, 1 + 1e-12);
        EXPECT_TRUE(place.heightM < 10 || sum > 0.99) << "land without a layer";
    }
}

TEST(LayerSet, NoiseMovesBordersButNotWhatLiesFarFromThem) {
    TextureLayer layer;
    layer.heightM = {0, allHeightsM.highest, 100};
    layer.noiseAmount = 1;
    layer.noiseSizeM = 50;
    const LayerSet set = setOf({layer});
    double least = 1, most = 0;
    for (int i = 0; i < 500; ++i) {
        LayerPlace place = placeAt(0);
        place.positionM += glm::dvec3(7.7 * i, 3.1 * i, -5.3 * i);
        least = std::min(least, layerWeights(set, place)[0]);
        most = std::max(most, layerWeights(set, place)[0]);
        place.heightM = 151;
        EXPECT_EQ(layerWeights(set, place)[0], 1);
        place.heightM = -151;
        EXPECT_EQ(layerWeights(set, place)[0], 0);
    }
    EXPECT_LT(least, 0.1);
    EXPECT_GT(most, 0.9);
}

TEST(LayerSet, TheOneWhoseReliefStandsHigherWinsInAHeightBlend) {
    LayerSet set = setOf({TextureLayer{}, TextureLayer{}}, LayerBlend::Height);
    set.layers[1].opacity = 0.5;
    set.blendDepth = 0.3;
    const LayerValues weights = layerWeights(set, placeAt(0));
    EXPECT_NEAR(weightsByRelief(set, weights, {0.5, 0.5})[0], 0.5, 1e-12);
    EXPECT_NEAR(weightsByRelief(set, weights, {0.6, 0.3})[1], 1 / (1 + std::exp(4.0)), 1e-9);
    EXPECT_GT(weightsByRelief(set, weights, {0.2, 0.8})[1], 0.99);
    set.blend = LayerBlend::Weight;
    EXPECT_EQ(weightsByRelief(set, weights, {0.2, 0.8}), weights);
}

TEST(LayerSet, AHeightBlendKeepsTheSumAndWhatIsNothing) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    LayerSet set = setOf(std::vector<TextureLayer>(maxLayers), LayerBlend::Height);
    for (const double depth : {0.05, 0.3, 2.0}) {
        set.blendDepth = depth;
        for (int i = 0; i < 200; ++i) {
            LayerValues weights{}, relief{};
            for (double& r : relief) r = share(random);
            for (std::size_t k = 1; k < maxLayers; ++k) weights[k] = share(random) / 8;
            const LayerValues shared = weightsByRelief(set, weights, relief);
            EXPECT_EQ(shared[0], 0);
            EXPECT_NEAR(std::accumulate(shared.begin(), shared.end(), 0.0),
                        std::accumulate(weights.begin(), weights.end(), 0.0), 1e-9);
        }
    }
}

TEST(LayerSet, ContradictoryRangesAreNamed) {
    using testing::HasSubstr;
    TextureLayer layer;
    EXPECT_EQ(layerProblem(layer), "");
    layer.heightM = {900, 300, 10};
    EXPECT_THAT(layerProblem(layer), HasSubstr("heights: [900, 300] m is inverted"));
    layer = {};
    layer.slopeDeg = {-5, 40, 0};
    EXPECT_THAT(layerProblem(layer), HasSubstr("is out of range; expected values in [0, 90]"));
    layer = {};
    layer.latitudeDeg.softEdge = -1;
    EXPECT_THAT(layerProblem(layer), HasSubstr("falloff -1° is out of range"));
    layer = {};
    layer.scaleM = 0;
    EXPECT_THAT(layerProblem(layer), HasSubstr("scale"));
    layer = {};
    layer.heightM.lowest = std::nan("");
    EXPECT_NE(layerProblem(layer), "");
    layer = {};
    layer.opacity = std::nan("");
    EXPECT_NE(layerProblem(layer), "");
}

TEST(LayerSet, TheShippedSetsAreInOrder) {
    for (const LayerSet& set : {earthLayers(), twoLayerHeightBlend()}) {
        EXPECT_LE(set.layers.size(), maxLayers);
        for (const TextureLayer& layer : set.layers) EXPECT_EQ(layerProblem(layer), "") << layer.name;
    }
}

TEST(LayerNoise, GoesOnBeyondWhereWholeNumbersWrap) {
    const double wrap = 4294967296.0;
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 place(0.25 * i, 100 - 0.5 * i, 7);
        EXPECT_EQ(valueNoise(place), valueNoise(place + glm::dvec3(wrap, -wrap, 2 * wrap)));
    }
}

TEST(LayerNoise, IsSmoothAndCentredAndItsFourPartsDiffer) {
    double sum = 0, products = 0, squares = 0;
    const int count = 4000;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(6.3e6 + 13.7 * i, -2.1e6 + 5.3 * i, 17.9 * i);
        const glm::dvec4 noise = layerNoise(place, 9);
        const glm::dvec4 beside = layerNoise(place + glm::dvec3(0.01), 9);
        EXPECT_LT(std::abs(noise.x - beside.x), 0.05);
        EXPECT_LE(std::abs(noise.x), 1);
        sum += noise.x;
        products += noise.x * noise.y;
        squares += noise.x * noise.x;
    }
    EXPECT_NEAR(sum / count, 0, 0.03);
    EXPECT_LT(std::abs(products / squares), 0.1);
}

}  // namespace
}  // namespace planet
