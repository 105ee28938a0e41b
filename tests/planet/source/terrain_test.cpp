#include "planet/source/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "planet/source/gradient_noise.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/support/synthetic_source.h"

namespace planet {
namespace {

using ::testing::HasSubstr;

// One of each kind, with detail over a rough world of 32 cells.
const std::vector<std::string> oneOfEach = {
    "noise:fbm,seed=3",
    "noise:ridged,seed=3",
    "noise:faults,seed=3,count=60",
    "noise:faults,seed=3,count=60,smooth_deg=8",
    "noise:midpoint,seed=3",
    "noise:midpoint,seed=3,roughness=1",
    "noise:craters,seed=3,sizes=6",
};

HeightSource roughSource() {
    const auto height = [](const glm::dvec3& d) {
        return 3000 * std::sin(23 * d.x + 1) * std::cos(21 * d.y) + 900 * std::sin(37 * d.z + 9 * d.x);
    };
    return test::formulaSource(height, -3900, 3900, 1, 33);
}

HeightSource detailedRough(const DetailTerrain& detail = {.seaM = -10000, .coastM = 0}) {
    return amplified(roughSource(), detail).value();
}

std::vector<HeightSource> allSources() {
    std::vector<HeightSource> sources;
    for (const std::string& text : oneOfEach) sources.push_back(mustOpen(text));
    sources.push_back(detailedRough());
    return sources;
}

struct Moments {
    double mean = 0;
    double rms = 0;  // about the mean
    double low = 0;
    double high = 0;
};
Moments momentsOf(const std::vector<float>& values) {
    Moments m{0, 0, values[0], values[0]};
    for (const float value : values) {
        m.mean += double(value) / double(values.size());
        m.low = std::min(m.low, double(value));
        m.high = std::max(m.high, double(value));
    }
    for (const float value : values) m.rms += (value - m.mean) * (value - m.mean) / double(values.size());
    m.rms = std::sqrt(m.rms);
    return m;
}

std::vector<float> wholePlanet(const HeightSource& source, int faceCells) {
    std::vector<float> all;
    for (const Face face : allFaces) {
        const std::vector<float> heights = sampledFace(source, face, faceCells);
        all.insert(all.end(), heights.begin(), heights.end());
    }
    return all;
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(double(a[i]) - double(b[i])));
    return most;
}

TEST(Terrain, FacesAgreeToTheBitOnEveryEdgeAndCornerAtSeveralSizes) {
    for (const HeightSource& source : allSources()) {
        for (const int cells : {1, 2, 4, 32, 128}) {
            const SharedPoints points = sharedPoints(source, cells);
            EXPECT_EQ(points.shared, pointsOnEdges(cells)) << source.description;
            EXPECT_EQ(points.different, 0) << source.description << " of " << cells << " cells";
        }
    }
}

TEST(Terrain, ATileHasTheBitsOfTheWholeFace) {
    for (const HeightSource& source : allSources()) expectTilesAgree(source, 128, 4);
}

TEST(Terrain, NothingShowsWhereFacesMeet) {
    // The step from a sample on the edge to its neighbours on both faces is no larger than steps elsewhere.
    constexpr int cells = 64;
    for (const HeightSource& source : allSources()) {
        const std::vector<float> a = sampledFace(source, Face::PosX, cells);
        const std::vector<float> b = sampledFace(source, Face::PosY, cells);  // right of +x
        const auto at = [](const std::vector<float>& face, int column, int row) {
            return double(face[static_cast<std::size_t>(row * (cells + 1) + column)]);
        };
        // Second differences: of a crease they are large.
        double across = 0, mostInside = 0;
        for (int row = 0; row <= cells; ++row) {
            across += std::abs(at(a, cells - 1, row) - 2 * at(a, cells, row) + at(b, 1, row));
        }
        for (int column = 1; column < cells; ++column) {
            double inA = 0, inB = 0;
            for (int row = 0; row <= cells; ++row) {
                inA += std::abs(at(a, column - 1, row) - 2 * at(a, column, row) + at(a, column + 1, row));
                inB += std::abs(at(b, column - 1, row) - 2 * at(b, column, row) + at(b, column + 1, row));
            }
            mostInside = std::max({mostInside, inA, inB});
        }
        EXPECT_LT(across, 1.5 * mostInside) << source.description;
    }
}

TEST(Terrain, ManyThreadsMakeTheBitsOfOne) {
    constexpr int cells = 128;
    for (const HeightSource& source : allSources()) {
        const std::vector<float> alone = sampledFace(source, Face::NegZ, cells);
        std::vector<float> together(alone.size());
        {
            std::vector<std::jthread> threads;
            for (int t = 0; t < 4; ++t) {
                threads.emplace_back([&, t] {
                    for (int row = t; row <= cells; row += 4) {
                        const std::vector<float> one =
                            sampled(source, {Face::NegZ, cells, 0, row, cells + 1, 1});
                        std::copy(one.begin(), one.end(), together.begin() + row * (cells + 1));
                    }
                });
            }
        }
        EXPECT_EQ(largestDifference(alone, together), 0) << source.description;
    }
}

TEST(Terrain, AnotherSeedIsAnotherWorldAndTheSameSeedTheSame) {
    for (std::string text : oneOfEach) {
        const std::vector<float> first = sampledFace(mustOpen(text), Face::PosY, 32);
        EXPECT_EQ(largestDifference(first, sampledFace(mustOpen(text), Face::PosY, 32)), 0) << text;
        text.replace(text.find("seed=3"), 6, "seed=4");
        const std::vector<float> other = sampledFace(mustOpen(text), Face::PosY, 32);
        EXPECT_GT(largestDifference(first, other), momentsOf(first).rms) << text;
    }
    EXPECT_GT(largestDifference(sampledFace(detailedRough({.seed = 1, .seaM = -10000}), Face::PosY, 128),
                                sampledFace(detailedRough({.seed = 2, .seaM = -10000}), Face::PosY, 128)),
              10);
}

TEST(Terrain, HeightsStayWithinTheRangeThatTheSourceTellsAndFillMuchOfIt) {
    for (const HeightSource& source : allSources()) {
        const Moments m = momentsOf(wholePlanet(source, 128));
        EXPECT_GE(m.low, source.minM - 1e-3) << source.description;
        EXPECT_LE(m.high, source.maxM + 1e-3) << source.description;
        EXPECT_GT(m.high - m.low, 0.25 * (source.maxM - source.minM)) << source.description;
    }
}

TEST(Terrain, AmplitudeAndOffsetScaleAndShiftAllHeights) {
    for (const char* kind : {"noise:fbm", "noise:ridged", "noise:midpoint"}) {
        const std::string text = std::string(kind) + ",seed=9,amplitude_m=";
        const HeightSource low = mustOpen(text + "1000");
        const HeightSource high = mustOpen(text + "3000,offset_m=500");
        const std::vector<float> a = sampledFace(low, Face::PosZ, 64);
        const std::vector<float> b = sampledFace(high, Face::PosZ, 64);
        for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(b[i], 3 * double(a[i]) + 500, 1e-2) << kind;
        EXPECT_NEAR(high.maxM, 3 * low.maxM + 500, 1e-6);
        EXPECT_NEAR(high.minM, 3 * low.minM + 500, 1e-6);
    }
}

TEST(Terrain, NoiseHasTheMomentsThatItsScalesCountOn) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1000, 1000);
    double sum = 0, squares = 0, ridges = 0, most = 0;
    constexpr int count = 400'000;
    for (int i = 0; i < count; ++i) {
        const double noise = gradientNoise({place(random), place(random), place(random)}, 77);
        sum += noise;
        squares += noise * noise;
        ridges += (1 - std::abs(noise)) * (1 - std::abs(noise));
        most = std::max(most, std::abs(noise));
    }
    EXPECT_NEAR(sum / count, 0, 0.002);
    EXPECT_NEAR(std::sqrt(squares / count), gradientNoiseRms, 0.002);
    EXPECT_NEAR(ridges / count, meanRidge, 0.002);
    EXPECT_LT(most, 1.1);
}

TEST(Terrain, NoiseIsZeroOnItsLatticeAndSmoothAcrossIt) {
    for (int i = -3; i < 3; ++i) EXPECT_EQ(gradientNoise({i, 2, -i}, 5), 0);
    for (const double x : {-2.0, 0.0, 5.0}) {
        const double below = gradientNoise({x - 1e-6, 0.3, 0.7}, 5),
                     above = gradientNoise({x + 1e-6, 0.3, 0.7}, 5);
        EXPECT_NEAR(below, above, 1e-5);
    }
}

TEST(Terrain, NoiseDoesNotRepeatAfter256Cells) {
    int same = 0;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 at(0.37 * i, 0.61 * i, 0.5);
        if (gradientNoise(at, 1) == gradientNoise(at + glm::dvec3(256, 0, 0), 1)) ++same;
    }
    EXPECT_LT(same, 5);
}

TEST(Terrain, OctavesFinerThanTwoGridStepsAreLeftOut) {
    // Of 64 cells a grid step is 1.4 degrees: cells of 45, 22.5, 11.2, 5.6 and 2.8125 degrees are held.
    for (const char* kind : {"noise:fbm", "noise:ridged"}) {
        const std::string of =
            std::string(kind) + ",feature_deg=45,lacunarity=2,gain=0.9,amplitude_m=1000,octaves=";
        const HeightSource many = mustOpen(of + "12");
        const HeightSource held = mustOpen(of + "5");
        const HeightSource fewer = mustOpen(of + "4");
        const auto ratioOf = [](const std::vector<float>& a, const std::vector<float>& b) {
            return momentsOf(a).rms / momentsOf(b).rms;
        };
        const std::vector<float> a = sampledFace(many, Face::PosX, 64);
        const std::vector<float> b = sampledFace(held, Face::PosX, 64);
        const std::vector<float> c = sampledFace(fewer, Face::PosX, 64);
        // The same but for the scale, which counts all octaves.
        const double ratio = ratioOf(a, b);
        std::vector<float> scaled(b);
        for (float& value : scaled) value = static_cast<float>(value * ratio);
        EXPECT_LT(largestDifference(a, scaled), 1e-2) << kind;
        for (std::size_t i = 0; i < c.size(); ++i) scaled[i] = static_cast<float>(c[i] * ratioOf(a, c));
        EXPECT_GT(largestDifference(a, scaled), 5) << kind;
    }
}

TEST(Terrain, FinerGridsAddDetailAboutTheCoarseOne) {
    for (const std::string& text : oneOfEach) {
        const HeightSource source = mustOpen(text);
        const std::vector<float> coarse = sampledFace(source, Face::PosX, 64);
        const std::vector<float> fine = sampledFace(source, Face::PosX, 256);
        std::vector<float> added;
        for (int row = 0; row <= 64; ++row) {
            for (int column = 0; column <= 64; ++column) {
                added.push_back(fine[static_cast<std::size_t>(4 * row * 257 + 4 * column)] -
                                coarse[static_cast<std::size_t>(row * 65 + column)]);
            }
        }
        const Moments m = momentsOf(added);
        EXPECT_LT(m.rms, 0.5 * momentsOf(coarse).rms) << text;
        EXPECT_LT(std::abs(m.mean), 0.2 * momentsOf(coarse).rms) << text;
    }
}

TEST(Terrain, FaultStepsFallEvenlyFromTheFirstToTheLast) {
    const FaultTerrain terrain{.count = 5, .maxDeltaM = 100, .minDeltaM = 50};
    EXPECT_DOUBLE_EQ(faultDeltaM(terrain, 0), 100);
    EXPECT_DOUBLE_EQ(faultDeltaM(terrain, 1), 90);
    EXPECT_DOUBLE_EQ(faultDeltaM(terrain, 3), 70);
    EXPECT_DOUBLE_EQ(faultDeltaM(terrain, 4), 60);
}

TEST(Terrain, OneFaultRaisesOneSideByItsStep) {
    const HeightSource source =
        mustOpen("noise:faults,seed=8,count=1,max_delta_m=300,min_delta_m=10,smooth_deg=0");
    const Moments m = momentsOf(wholePlanet(source, 128));
    EXPECT_NEAR(m.low, -150, 1e-3);
    EXPECT_NEAR(m.high, 150, 1e-3);
    EXPECT_NEAR(source.maxM, 150, 1e-9);
}

TEST(Terrain, ASmoothedFaultIsTheStepOfTheBooksFilterThereAndBack) {
    // Found where a row of a fine grid crosses it, then against the filter run over that row's samples.
    const HeightSource sharp = mustOpen("noise:faults,seed=8,count=1,max_delta_m=1000,smooth_deg=0");
    const HeightSource soft = mustOpen("noise:faults,seed=8,count=1,max_delta_m=1000,smooth_deg=2");
    constexpr int cells = 1024;
    double steepest = 0;
    for (const Face face : allFaces) {
        const std::vector<float> row = sampled(soft, {face, cells, 0, cells / 2, cells + 1, 1});
        for (std::size_t i = 1; i < row.size(); ++i)
            steepest = std::max(steepest, std::abs(double(row[i]) - double(row[i - 1])));
    }
    // Across the fault the slope is delta / (2 w); a row may cross it aslant. A grid step is at most 2 /
    // cells.
    const double w = 2 * std::numbers::pi / 180;
    EXPECT_LT(steepest, 1000 / (2 * w) * 2 / cells);
    EXPECT_GT(steepest, 0);
    // k of a grid of step h is e^(-h / w); the filter there and back of a step is e^(-x/w) / 2 short of it.
    constexpr int count = 4000;
    const double h = w / 100, k = std::exp(-h / w);
    std::vector<double> filtered(count);
    for (int i = 0; i < count; ++i) filtered[static_cast<std::size_t>(i)] = i < count / 2 ? 0 : 1;
    for (std::size_t i = 1; i < filtered.size(); ++i)
        filtered[i] = k * filtered[i - 1] + (1 - k) * filtered[i];
    for (std::size_t i = filtered.size() - 1; i-- > 0;)
        filtered[i] = k * filtered[i + 1] + (1 - k) * filtered[i];
    // The heights that the source takes on the way through its fault, by their distance from its middle.
    const std::vector<float> heights = wholePlanet(soft, 512);
    for (const double widths : {0.5, 1.0, 2.0}) {
        const double filter = filtered[static_cast<std::size_t>(count / 2 + static_cast<int>(100 * widths))];
        EXPECT_NEAR(filter, 1 - 0.5 * std::exp(-widths), 0.01);
        // Of the planet, the share of the ground within that many widths of the fault is the ring's area:
        // half its sine's range, whatever its latitude; so counts of samples tell the profile.
        const double heightM = 1000 * (1 - 0.5 * std::exp(-widths)) - 500;
        const auto between = std::count_if(heights.begin(), heights.end(),
                                           [&](float value) { return std::abs(value) < heightM; });
        const double share = double(between) / double(heights.size());
        EXPECT_LT(share, 1.4 * std::sin(widths * w)) << widths;
        EXPECT_GT(share, 0.2 * std::sin(widths * w)) << widths;
    }
    EXPECT_EQ(largestDifference(sampledFace(sharp, Face::PosX, 4), sampledFace(sharp, Face::PosX, 4)), 0);
}

TEST(Terrain, FaultsFarAwayAreCountedAsIfNear) {
    // A piece adds up its far faults before; one sample alone has other far ones than a face.
    const HeightSource source = mustOpen("noise:faults,seed=2,count=300,smooth_deg=1");
    const std::vector<float> face = sampledFace(source, Face::PosZ, 64);
    for (const int at : {0, 17, 31, 64}) {
        EXPECT_EQ(sampledAt(source, Face::PosZ, 64, at, 20), face[static_cast<std::size_t>(20 * 65 + at)]);
    }
}

TEST(Terrain, MidpointsKeepTheHeightsOfACoarserGrid) {
    const HeightSource source = mustOpen("noise:midpoint,seed=5,roughness=0.6");
    const std::vector<float> coarse = sampledFace(source, Face::NegY, 32);
    const std::vector<float> fine = sampledFace(source, Face::NegY, 128);
    for (int row = 0; row <= 32; ++row) {
        for (int column = 0; column <= 32; ++column) {
            ASSERT_EQ(coarse[static_cast<std::size_t>(row * 33 + column)],
                      fine[static_cast<std::size_t>(4 * row * 129 + 4 * column)]);
        }
    }
}

TEST(Terrain, RoughnessRaisesTheFinestStepsOfMidpoints) {
    double before = 0;
    for (const char* roughness : {"0", "0.3", "0.6", "1"}) {
        const HeightSource source = mustOpen(std::string("noise:midpoint,seed=5,roughness=") + roughness);
        const std::vector<float> row = sampled(source, {Face::PosX, 1024, 0, 300, 1025, 1});
        double steps = 0;
        for (std::size_t i = 1; i < row.size(); ++i) steps += std::abs(double(row[i]) - double(row[i - 1]));
        EXPECT_GT(steps, 1.3 * before) << roughness;
        before = steps;
    }
}

TEST(Terrain, MidpointsWorkOnTheFinestGridThereIs) {
    const HeightSource source = mustOpen("noise:midpoint,seed=5");
    constexpr int cells = 1 << 22;
    const float corner = sampledAt(source, Face::PosX, cells, 0, 0);
    EXPECT_EQ(corner, sampledAt(source, Face::PosX, 2, 0, 0));
    EXPECT_NEAR(sampledAt(source, Face::PosX, cells, 1, 1), corner, 200);
}

TEST(Terrain, CratersAreDeeperThanTheGroundAndHaveRims) {
    const HeightSource flat =
        mustOpen("noise:craters,seed=3,amplitude_m=0,sizes=1,density=0.3,largest_deg=20,depth_m=4000");
    const Moments m = momentsOf(wholePlanet(flat, 128));
    EXPECT_LT(m.low, -1200);
    EXPECT_GT(m.high, 200);
    EXPECT_LT(m.high, 1700);
    const std::vector<float> heights = wholePlanet(flat, 128);
    EXPECT_GT(std::count(heights.begin(), heights.end(), 0.0f), 100);  // the ground between them
}

TEST(Terrain, CratersUnderFourGridStepsAreLeftOut) {
    const std::string of = "noise:craters,seed=3,amplitude_m=0,largest_deg=22.5,sizes=";
    // A step of 16 cells is 5.6 degrees.
    EXPECT_EQ(largestDifference(sampledFace(mustOpen(of + "1"), Face::PosX, 16),
                                sampledFace(mustOpen(of + "5"), Face::PosX, 16)),
              0);
    EXPECT_GT(largestDifference(sampledFace(mustOpen(of + "1"), Face::PosX, 64),
                                sampledFace(mustOpen(of + "5"), Face::PosX, 64)),
              50);
}

TEST(Terrain, DetailChangesNothingUpToTheSourcesOwnGrid) {
    const HeightSource plain = roughSource();
    const HeightSource detailed = detailedRough();
    for (const int cells : {8, 32}) {
        for (const Face face : allFaces) {
            EXPECT_EQ(largestDifference(sampledFace(plain, face, cells), sampledFace(detailed, face, cells)),
                      0);
        }
    }
}

TEST(Terrain, DetailOfFinerGridsAveragesOutOverTheSourcesOwnSpacing) {
    const HeightSource plain = roughSource();
    const HeightSource detailed = detailedRough();
    constexpr int cells = 512, block = cells / 32;
    const std::vector<float> a = sampledFace(plain, Face::PosX, cells);
    const std::vector<float> b = sampledFace(detailed, Face::PosX, cells);
    std::vector<float> added, means;
    for (int row = 0; row < cells; row += 2 * block) {
        for (int column = 0; column < cells; column += 2 * block) {
            double sum = 0;
            for (int j = 0; j < 2 * block; ++j) {
                for (int i = 0; i < 2 * block; ++i) {
                    const auto at = static_cast<std::size_t>((row + j) * (cells + 1) + column + i);
                    added.push_back(b[at] - a[at]);
                    sum += double(added.back()) / (4 * block * block);
                }
            }
            means.push_back(static_cast<float>(sum));
        }
    }
    const double addedRms = momentsOf(added).rms;
    EXPECT_GT(addedRms, 30);
    EXPECT_LT(momentsOf(means).rms, 0.4 * addedRms);
    EXPECT_LT(std::abs(momentsOf(added).mean), 0.1 * addedRms);
}

TEST(Terrain, DetailIsNoneOnFlatGroundAndBoundedOnRough) {
    const HeightSource plain = test::formulaSource(
        [](const glm::dvec3& d) {
            return d.x > 0.3 ? 100.0 : 4000 * std::sin(41 * d.y) * std::cos(39 * d.z);
        },
        -4000, 4000, 1, 33);
    const HeightSource detailed = amplified(plain, {.strength = 8, .limitM = 250, .seaM = -10000}).value();
    EXPECT_EQ(largestDifference(sampledFace(plain, Face::PosX, 256), sampledFace(detailed, Face::PosX, 256)),
              0);
    const double most =
        largestDifference(sampledFace(plain, Face::NegX, 256), sampledFace(detailed, Face::NegX, 256));
    EXPECT_LE(most, 250.01);
    EXPECT_GT(most, 60);
    EXPECT_EQ(detailed.maxM, 4250);
    EXPECT_EQ(detailed.minM, -4250);
}

TEST(Terrain, DetailFadesOutUnderTheSea) {
    const HeightSource plain = roughSource();
    const HeightSource detailed = amplified(plain, {.seaM = 0, .coastM = 100}).value();
    const std::vector<float> a = sampledFace(plain, Face::PosX, 256);
    const std::vector<float> b = sampledFace(detailed, Face::PosX, 256);
    int changedOnLand = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] < -100) {
            ASSERT_EQ(a[i], b[i]);
        }
        if (a[i] > 100 && a[i] != b[i]) ++changedOnLand;
    }
    EXPECT_GT(changedOnLand, 10000);
}

TEST(Terrain, DetailGoesByTheReliefOfThePlace) {
    // Gentle on the north, rough on the south.
    const HeightSource plain = test::formulaSource(
        [](const glm::dvec3& d) { return (d.z > 0 ? 200 : 2000) * std::sin(31 * d.x) * std::cos(29 * d.y); },
        -2000, 2000, 1, 33);
    const HeightSource detailed = amplified(plain, {.flatM = 0, .seaM = -10000}).value();
    const auto addedRms = [&](Face face) {
        std::vector<float> a = sampledFace(plain, face, 256);
        const std::vector<float> b = sampledFace(detailed, face, 256);
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = b[i] - a[i];
        return momentsOf(a).rms;
    };
    EXPECT_GT(addedRms(Face::PosZ), 2);
    EXPECT_GT(addedRms(Face::NegZ), 4 * addedRms(Face::PosZ));
}

TEST(Terrain, DetailPassesOnTheErrorsOfItsSource) {
    HeightSource broken = roughSource();
    broken.sample = [](const SampleTile& tile, std::span<float>) -> Result<void> {
        if (tile.faceCells > 32) return {};
        return ioError("elevation.tif: row 7 cannot be read");
    };
    std::vector<float> out(9);
    const Result<void> sampled = amplified(broken, {}).value().sample({Face::PosX, 64, 0, 0, 3, 3}, out);
    ASSERT_FALSE(sampled);
    EXPECT_THAT(sampled.error().message, HasSubstr("row 7"));
}

TEST(Terrain, NamesAFaceThatBakesInMinutesUnlessAsked) {
    for (const std::string& text : oneOfEach) {
        const int size = mustOpen(text).naturalFaceSize;
        EXPECT_GE(size, 129) << text;
        EXPECT_LE(size, 2049) << text;
    }
    EXPECT_EQ(mustOpen("noise:fbm,octaves=3,feature_deg=90").naturalFaceSize, 129);
    EXPECT_EQ(amplified(roughSource(), {}).value().naturalFaceSize, 129);
    EXPECT_EQ(amplified(roughSource(), {.octaves = 1}).value().naturalFaceSize, 65);
}

TEST(TerrainText, GivesBackEverySetting) {
    for (const TerrainKind& kind : terrainKinds()) {
        TerrainSource source{kind.defaults, kind.name == "detail" ? "data/a,b=c.tif" : ""};
        EXPECT_EQ(terrainText(terrainFromText(terrainText(source)).value()), terrainText(source));
        double share = 0.1;
        for (const TerrainField& field : kind.fields) {
            const double value = field.least + share * (field.most - field.least);
            field.set(source.settings, field.whole ? std::floor(value) : value);
            share += 0.03;
        }
        if (auto* const faults = std::get_if<FaultTerrain>(&source.settings))
            std::swap(faults->minDeltaM, faults->maxDeltaM);
        const Result<TerrainSource> again = terrainFromText(terrainText(source));
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->of, source.of);
        for (const TerrainField& field : kind.fields) {
            EXPECT_EQ(field.get(again->settings), field.get(source.settings)) << kind.name << field.name;
        }
    }
}

TEST(TerrainText, DescriptionOpensTheSameTerrain) {
    for (const std::string& text : oneOfEach) {
        const HeightSource source = mustOpen(text);
        const HeightSource again = mustOpen(source.description);
        EXPECT_EQ(again.description, source.description);
        EXPECT_EQ(largestDifference(sampledFace(source, Face::PosX, 16), sampledFace(again, Face::PosX, 16)),
                  0);
    }
}

TEST(TerrainText, DetailOfAFileNamesItSoThatItIsFoundAgain) {
    const TemporaryFolder folder;
    writeImage(folder / "bumps, one.tif",
               Image<std::int16_t>(64, 32, [](int c, int r) { return noise(c, r, 4000); }));
    const std::string text = "detail:strength=2,of=" + (folder / "bumps, one.tif").string();
    const HeightSource source = mustOpen(text);
    EXPECT_TRUE(heightSourceExists(text));
    EXPECT_EQ(heightSourceFiles(text).files.size(), 1u);
    EXPECT_EQ(heightSourceFiles(text).stem, "bumps, one-detail");
    EXPECT_THAT(source.description, HasSubstr("of=" + (folder / "bumps, one.tif").string()));
    EXPECT_EQ(source.stepM, 0);
    const HeightSource ofNoise = mustOpen("detail:seed=4,of=noise:midpoint,seed=7");
    EXPECT_EQ(ofNoise.description, "detail:seed=4,of=noise:midpoint,seed=7");
    EXPECT_FALSE(heightSourceExists("detail:seed=4,of=nothing.tif"));
    EXPECT_FALSE(heightSourceExists("noise:fbn"));
    EXPECT_TRUE(heightSourceExists("noise:fbm"));
    EXPECT_EQ(heightSourceFiles("noise:fbm").stem, "fbm");
}

TEST(TerrainText, ErrorsTellWhatWouldBeRight) {
    EXPECT_THAT(errorOf("noise:rigded"), HasSubstr("did you mean noise:ridged? expected one of "));
    EXPECT_THAT(errorOf("noise:fbm,amplitud_m=3"), HasSubstr("did you mean amplitude_m? expected one of "));
    EXPECT_THAT(errorOf("noise:fbm,octaves=99"), HasSubstr("octaves is 99; expected an integer in [1, 24]"));
    EXPECT_THAT(errorOf("noise:fbm,octaves=2.5"), HasSubstr("an integer"));
    EXPECT_THAT(errorOf("noise:fbm,gain=nan"), HasSubstr("gain is nan"));
    EXPECT_THAT(errorOf("noise:fbm,gain=0.5x"), HasSubstr("gain is 0.5x; expected a number in [0, 0.95]"));
    EXPECT_THAT(errorOf("noise:fbm,gain="), HasSubstr("gain is empty"));
    EXPECT_THAT(errorOf("noise:fbm,gain=0.1,gain=0.2"), HasSubstr("gain is given twice"));
    EXPECT_THAT(errorOf("noise:faults,max_delta_m=5,min_delta_m=6"), HasSubstr("at most max_delta_m, 5 m"));
    EXPECT_THAT(errorOf("detail:strength=1"), HasSubstr("detail: has no source"));
    EXPECT_THAT(errorOf("detail:of=nothing.tif"), HasSubstr("nothing.tif: no such file"));
    EXPECT_THAT(errorOf("detail:strenght=1,of=x.tif"), HasSubstr("did you mean strength? expected one of "));
    HeightSourceSettings shifted;
    shifted.offsetM = 10;
    EXPECT_THAT(errorOf("noise:fbm", shifted), HasSubstr("is procedural terrain"));
    shifted.offsetM = 0;
    EXPECT_THAT(errorOf("noise:fbm", shifted), HasSubstr("is procedural terrain"));
}

TEST(Terrain, SettingsOutOfRangeAreToldByName) {
    for (const TerrainKind& kind : terrainKinds()) {
        for (const TerrainField& field : kind.fields) {
            TerrainSettings settings = kind.defaults;
            EXPECT_TRUE(checkTerrain(settings));
            if (field.whole && field.most > 4e9) continue;  // every seed is good
            field.set(settings, field.most * 2 + 1);
            const Result<void> checked = checkTerrain(settings);
            ASSERT_FALSE(checked) << field.name;
            EXPECT_THAT(checked.error().message, HasSubstr(std::string(field.name) + " is "));
        }
    }
    EXPECT_FALSE(makeTerrain(FractalTerrain{.gain = 2}));
    EXPECT_FALSE(makeTerrain(DetailTerrain{}));
    EXPECT_FALSE(amplified(roughSource(), {.strength = -1}));
}

}  // namespace
}  // namespace planet
