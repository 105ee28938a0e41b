#include "planet/bake/bake_estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>

#include "planet/source/height_source.h"
#include "tests/support/sanitized.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::formulaSource;
using test::hillsSource;

// Flat over one half of the planet and rough over the other, as an Earth with an ocean is.
HeightSource halfRoughSource(int naturalFaceSize) {
    return formulaSource(
        [](const glm::dvec3& d) {
            return d.x < 0 ? 0.0 : test::hillsM(d) + std::round(25 * std::sin(1900 * d.y + 1700 * d.z));
        },
        -4000, 4000, 1, naturalFaceSize);
}

double sizeRatio(const HeightSource& source, const BakeSettings& settings) {
    const tests::TemporaryFolder folder;
    const Result<BakeReport> real = bake(source, settings, folder / "real.chk");
    const Result<BakeEstimate> estimate = estimateBake(source, settings);
    EXPECT_TRUE(real && estimate);
    if (!real || !estimate) return 0;
    EXPECT_EQ(estimate->samples, real->samples);
    EXPECT_EQ(estimate->chunks, real->chunks);
    EXPECT_GT(estimate->seconds, 0);
    return estimate->fileBytes / static_cast<double>(real->fileBytes);
}

void expectWithinHalf(double ratio) {
    EXPECT_GT(ratio, 1 / 1.5);
    EXPECT_LT(ratio, 1.5);
}

TEST(BakeEstimate, sizeIsWithinAFactorOfOneAndAHalfForSmallChunks) {
    expectWithinHalf(sizeRatio(halfRoughSource(513), {.chunkSize = 17}));
}

TEST(BakeEstimate, sizeIsWithinAFactorOfOneAndAHalfForLargeChunks) {
    expectWithinHalf(sizeRatio(halfRoughSource(513), {.chunkSize = 65}));
}

TEST(BakeEstimate, uncompressedBlocksAreEstimatedAlmostExactly) {
    const double ratio = sizeRatio(hillsSource(257), {.chunkSize = 33, .compressionLevel = 0});
    EXPECT_NEAR(ratio, 1, 0.02);
}

TEST(BakeEstimate, planetsOfOneAndTwoLevelsAreEstimatedToo) {
    expectWithinHalf(sizeRatio(hillsSource(33), {.chunkSize = 33}));
    expectWithinHalf(sizeRatio(hillsSource(65), {.chunkSize = 33}));
}

TEST(BakeEstimate, givesTheSameSizeEachTime) {
    const HeightSource source = hillsSource(257);
    const Result<BakeEstimate> once = estimateBake(source, {.threads = 1});
    const Result<BakeEstimate> again = estimateBake(source, {.threads = 3});
    ASSERT_TRUE(once && again);
    EXPECT_EQ(once->fileBytes, again->fileBytes);
}

TEST(BakeEstimate, refusesWhatTheBakeRefuses) {
    const tests::TemporaryFolder folder;
    for (const BakeSettings& settings : {BakeSettings{.chunkSize = 34}, BakeSettings{.faceSize = 1000},
                                         BakeSettings{.compressionLevel = 9}}) {
        const Result<BakeEstimate> estimate = estimateBake(hillsSource(), settings);
        const Result<BakeReport> real = bake(hillsSource(), settings, folder / "never.chk");
        ASSERT_FALSE(estimate);
        ASSERT_FALSE(real);
        EXPECT_EQ(estimate.error().message, real.error().message);
    }
}

TEST(BakeEstimate, aSourceThatCannotBeReadIsAnError) {
    HeightSource source = hillsSource();
    source.sample = [](const SampleTile&, std::span<float>) -> Result<void> {
        return ioError("hills.tif: cannot be read");
    };
    const Result<BakeEstimate> estimate = estimateBake(source, {});
    ASSERT_FALSE(estimate);
    EXPECT_EQ(estimate.error().message, "hills.tif: cannot be read");
}

TEST(BakeEstimate, stopsWhenToldTo) {
    int asked = 0;
    const Result<BakeEstimate> estimate =
        estimateBake(hillsSource(513), {.threads = 1}, [&] { return ++asked < 3; });
    ASSERT_FALSE(estimate);
    EXPECT_EQ(estimate.error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(asked, 3);
}

TEST(BakeEstimate, coloursAreEstimatedBesideTheHeights) {
    const tests::TemporaryFolder folder;
    const ColourSource colours = test::mottledColours(513);
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        const BakeSettings settings{.faceSize = 65, .chunkSize = 17, .colour = {.format = format}};
        const Result<BakeReport> real = bake(hillsSource(), settings, folder / "real.chk", {}, &colours);
        const Result<BakeEstimate> estimate = estimateBake(hillsSource(), settings, {}, &colours);
        const Result<BakeEstimate> without = estimateBake(hillsSource(), settings);
        ASSERT_TRUE(real && estimate && without);
        ASSERT_TRUE(estimate->colour);
        EXPECT_FALSE(without->colour);
        EXPECT_EQ(estimate->colour->faceSize, 513);
        EXPECT_EQ(estimate->colour->levels, 2);
        EXPECT_EQ(estimate->colour->tiles, real->colourTiles);
        EXPECT_EQ(estimate->colour->residentBytes, real->colourTiles * colourTileBytes(format));
        EXPECT_GT(estimate->colour->seconds, 0);
        EXPECT_GT(estimate->seconds, estimate->colour->seconds);
        expectWithinHalf(estimate->colour->fileBytes / static_cast<double>(real->colourBytes));
        EXPECT_DOUBLE_EQ(estimate->fileBytes, without->fileBytes + estimate->colour->fileBytes);
    }
}

// Bakes a file, and ends the process: with 0 if the estimate of the memory is within a factor of two.
void exitByMemory(const std::filesystem::path& file, const std::filesystem::path& output) {
    // getrusage() would count the memory of the process that started this one.
    const auto peakBytes = [] {
        std::ifstream status("/proc/self/status");
        constexpr std::string_view name = "VmHWM:";
        for (std::string line; std::getline(status, line);)
            if (line.starts_with(name)) return 1024 * std::stod(line.substr(name.size()));
        return 0.0;
    };
    const BakeSettings settings{.threads = 2};
    const double before = peakBytes();
    bool isWithin = false;
    {
        const HeightSource source = openHeightSource(file, {}).value();
        const bool isBaked = bake(source, settings, output).has_value();
        const double grown = peakBytes() - before;
        const double ratio = static_cast<double>(estimateBake(source, settings)->bakeBytes) / grown;
        isWithin = isBaked && ratio > 0.5 && ratio < 2;
        std::cerr << "grown by " << grown << " bytes, estimated at " << ratio << " of it\n";
    }
    std::quick_exit(isWithin ? 0 : 1);
}

// Each bake has a process of its own, whose memory nothing else has used.
TEST(BakeEstimate, memoryIsWithinAFactorOfTwo) {
    if (::tests::sanitized) GTEST_SKIP() << "a sanitizer keeps freed memory";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const tests::TemporaryFolder folder;
    const std::filesystem::path data = std::filesystem::path(WORLDY_SOURCE_DIR) / "data";
    std::ofstream(folder / "world.toml")
        << "[[elevation]]\nfiles = \"" << (data / "earth/elevation.tif").string()
        << "\"\n[[elevation]]\nfiles = \"" << (data / "regions/S33W071.tif").string() << "\"\n";
    for (const std::filesystem::path& file :
         {data / "earth/elevation.tif", data / "regions/N49W123.tif", folder / "world.toml"}) {
        EXPECT_EXIT(exitByMemory(file, folder / "real.chk"), testing::ExitedWithCode(0), "grown by") << file;
    }
}

TEST(BakeEstimate, refusesTheColoursThatTheBakeRefuses) {
    const tests::TemporaryFolder folder;
    const ColourSource colours = test::mottledColours();
    for (const int faceSize : {256, 1000, 1 << 20}) {
        const BakeSettings settings{.faceSize = 65, .chunkSize = 17, .colour = {.faceSize = faceSize}};
        const Result<BakeEstimate> estimate = estimateBake(hillsSource(), settings, {}, &colours);
        const Result<BakeReport> real = bake(hillsSource(), settings, folder / "never.chk", {}, &colours);
        ASSERT_FALSE(estimate);
        ASSERT_FALSE(real);
        EXPECT_EQ(estimate.error().message, real.error().message);
    }
    ColourSource unreadable = colours;
    unreadable.sample = [](const SampleTile&, std::span<glm::vec3>) -> Result<void> {
        return ioError("map.jpg: cannot be read");
    };
    const Result<BakeEstimate> estimate =
        estimateBake(hillsSource(), {.faceSize = 65, .chunkSize = 17}, {}, &unreadable);
    ASSERT_FALSE(estimate);
    EXPECT_EQ(estimate.error().message, "map.jpg: cannot be read");
}

}  // namespace
}  // namespace planet
