#include "planet/source/height_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <string_view>
#include <thread>

#include "planet/source/height_geographic.h"
#include "tests/planet/source/height_source_fixture.h"

namespace planet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::filesystem::path earthElevation =
    std::filesystem::path(WORLDY_SOURCE_DIR) / "data/earth/elevation.tif";

Image<float> noiseImage(int width, double most = 1000) {
    return Image<float>(width, width / 2, [&](int column, int row) { return noise(column, row, most); });
}

// The direction of an image's sample.
glm::dvec3 directionOfPixel(int width, int column, int row) {
    return directionFromGeographic({std::numbers::pi * (0.5 - (row + 0.5) / (width / 2.0)),
                                    std::numbers::pi * ((column + 0.5) * 2 / width - 1)});
}

Image<float> smoothImage(int width) {
    return Image<float>(width, width / 2, [&](int column, int row) {
        return smoothField(directionOfPixel(width, column, row));
    });
}

TEST(HeightSource, EarthIsDescribedInMetres) {
    const HeightSource source = mustOpen(earthElevation);
    EXPECT_EQ(source.description, "elevation.tif, 4320 x 2160 int16, equirectangular");
    EXPECT_EQ(source.naturalFaceSize, 2049);
    EXPECT_EQ(source.stepM, 1);
    EXPECT_EQ(source.minM, -10133);
    EXPECT_EQ(source.maxM, 6849);
    EXPECT_EQ(source.sampleCount, 4320u * 2160u);
    EXPECT_EQ(source.missingCount, 0u);
}

// At the middle of the image's sample that holds a place.
float sampledAtPixelOf(const HeightSource& source, double latitudeDeg, double longitudeDeg) {
    const auto middle = [](double angleDeg) { return (std::floor(angleDeg * 12) + 0.5) / 12; };
    return sampledNear(source, 1 << 18, middle(latitudeDeg), middle(longitudeDeg));
}

TEST(HeightSource, EarthsMountainsAndCanyonsAreWhereTheyBelong) {
    const HeightSource source = mustOpen(earthElevation);
    EXPECT_NEAR(sampledAtPixelOf(source, 27.988, 86.925), 5843, 5);
    EXPECT_NEAR(sampledAtPixelOf(source, 36.1, -112.1), 1437, 5);
    // Between samples, where the cubic stands above the straight lines.
    EXPECT_NEAR(sampledNear(source, 1 << 18, 27.988, 86.925), 5961, 5);
    EXPECT_LT(sampledNear(source, 1 << 16, 11.35, 142.2), -8000);  // Mariana Trench
    EXPECT_GT(sampledNear(source, 1 << 16, -90, 0), 2000);         // Antarctica
    EXPECT_LT(sampledNear(source, 1 << 16, 90, 0), -3000);         // Arctic Ocean
}

TEST(HeightSource, GeographicRowsMatchTheLibrarysOwnAngles) {
    constexpr int cells = 256;
    std::vector<double> values(3 * (cells + 1));
    const std::span all(values);
    const GeographicRow row{all.first(cells + 1), all.subspan(cells + 1, cells + 1), all.last(cells + 1)};
    for (const Face face : allFaces) {
        const GeographicColumns columns(face, cells, 0, cells + 1);
        for (int j = 0; j <= cells; ++j) {
            columns.placesOfRow(j, row);
            for (int i = 0; i <= cells; ++i) {
                const Geographic exact = geographicFromDirection(directionAt(face, cells, i, j));
                const auto at = static_cast<std::size_t>(i);
                ASSERT_NEAR(row.latitudeRad[at], exact.latitudeRad, 3e-15);
                ASSERT_NEAR(row.longitudeRad[at], exact.longitudeRad, 3e-15);
                ASSERT_NEAR(row.ring[at], std::cos(exact.latitudeRad), 3e-15);
            }
        }
    }
}

TEST(HeightSource, SmoothFieldSurvivesAFinerGrid) {
    const TemporaryFolder folder;
    writeImage(folder / "smooth.tif", smoothImage(720));
    // A source step is 0.5 degrees: the cubic is off by some (0.0087 rad)^3 of the field's 3000 m.
    EXPECT_LT(largestError(mustOpen(folder / "smooth.tif"), 512, smoothField), 0.1);
}

TEST(HeightSource, SmoothFieldSurvivesACoarserGrid) {
    const TemporaryFolder folder;
    writeImage(folder / "smooth.tif", smoothImage(720));
    // Averaged over 2.8 degrees, 5.6 samples each way; towards the poles in longitude alike.
    EXPECT_LT(largestError(mustOpen(folder / "smooth.tif"), 32, smoothField), 3);
}

TEST(HeightSource, CheckerboardFinerThanTheGridAveragesToGrey) {
    const TemporaryFolder folder;
    writeImage(folder / "checks.png",
               Image<std::uint8_t>(1024, 512, [](int column, int row) { return (column + row) % 2 * 255; }));
    EXPECT_LT(largestError(mustOpen(folder / "checks.png"), 64, [](const glm::dvec3&) { return 127.5; }), 1);
}

TEST(HeightSource, LinearRampHasNoStairSteps) {
    const TemporaryFolder folder;
    // 5.6 degrees a row, 100 m a row.
    writeImage(folder / "ramp.tif",
               Image<std::int16_t>(64, 32, [](int, int row) { return 100 * row - 1550; }));
    const HeightSource source = mustOpen(folder / "ramp.tif");
    constexpr int cells = 1024;
    const std::vector<float> heights =
        sampled(source, {Face::PosX, cells, cells / 2, cells / 8, 1, cells * 3 / 4});
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const double latitude =
            std::asin(directionAt(Face::PosX, cells, cells / 2, cells / 8 + static_cast<int>(i)).z);
        ASSERT_NEAR(heights[i], -latitude / std::numbers::pi * 3200, 2e-3) << i;
    }
}

TEST(HeightSource, ConstantImageStaysConstantUpToThePoles) {
    const TemporaryFolder folder;
    writeImage(folder / "plain.tif", Image<float>(360, 180, [](int, int) { return 1234.5; }));
    const HeightSource source = mustOpen(folder / "plain.tif");
    for (const int cells : {1, 2, 8, 128, 1024}) {
        EXPECT_LT(largestError(source, std::min(cells, 128), [](const glm::dvec3&) { return 1234.5; }), 1e-3);
    }
}

TEST(HeightSource, PoleIsTheAverageOfItsWholeRow) {
    const TemporaryFolder folder;
    const Image<float> image = noiseImage(256);
    writeImage(folder / "noise.tif", image);
    const HeightSource source = mustOpen(folder / "noise.tif");
    const auto averageOfRow = [&](int row) {
        double sum = 0;
        for (int i = 0; i < 256; ++i) sum += image.samples[static_cast<std::size_t>(256 * row + i)];
        return sum / 256;
    };
    constexpr int cells = 512;
    // Half-way between a row and its own mirror image: weights -1/16, 9/16, 9/16, -1/16.
    EXPECT_NEAR(sampledAt(source, Face::PosZ, cells, cells / 2, cells / 2),
                (9 * averageOfRow(0) - averageOfRow(1)) / 8, 1e-2);
    EXPECT_NEAR(sampledAt(source, Face::NegZ, cells, cells / 2, cells / 2),
                (9 * averageOfRow(127) - averageOfRow(126)) / 8, 1e-2);
}

// The largest difference between samples beside each other, in a square about a grid's middle.
double largestStep(const HeightSource& source, Face face, int cells, int side) {
    const SampleTile tile{face, cells, (cells - side) / 2, (cells - side) / 2, side + 1, side + 1};
    const std::vector<float> heights = sampled(source, tile);
    double largest = 0;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const auto at = static_cast<std::size_t>(row * (side + 1) + column);
            largest = std::max(largest, std::abs(double(heights[at]) - heights[at + 1]));
            largest = std::max(
                largest, std::abs(double(heights[at]) - heights[at + static_cast<std::size_t>(side) + 1]));
        }
    }
    return largest;
}

TEST(HeightSource, PolesAndDateLineAreAsSmoothAsTheField) {
    const TemporaryFolder folder;
    writeImage(folder / "smooth.tif", smoothImage(256));
    const HeightSource source = mustOpen(folder / "smooth.tif");
    // The field climbs less than 4000 m a radian, and a grid step is at most 2 / 4096 radians.
    for (const Face face : {Face::PosX, Face::NegX, Face::PosZ, Face::NegZ}) {
        EXPECT_LT(largestStep(source, face, 4096, 256), 4000 * 2.0 / 4096) << faceName(face);
    }
}

TEST(HeightSource, DateLineIsALongitudeLikeAnyOther) {
    const TemporaryFolder folder;
    writeImage(folder / "here.tif", noiseImage(256));
    writeImage(folder / "turned.tif", Image<float>(256, 128, [](int column, int row) {
                   return noise((column + 128) % 256, row, 1000);
               }));
    const HeightSource here = mustOpen(folder / "here.tif");
    const HeightSource turned = mustOpen(folder / "turned.tif");
    // Half a turn about the poles takes +x to -x, sample by sample.
    const std::vector<float> atDateLine = sampledFace(here, Face::NegX, 128);
    const std::vector<float> atMeridian = sampledFace(turned, Face::PosX, 128);
    for (std::size_t i = 0; i < atDateLine.size(); ++i) ASSERT_NEAR(atDateLine[i], atMeridian[i], 1e-2) << i;
}

TEST(HeightSource, SharedEdgesAndCornersAreBitIdentical) {
    const TemporaryFolder folder;
    writeImage(folder / "noise.tif", noiseImage(512));
    const HeightSource source = mustOpen(folder / "noise.tif");
    for (const int cells : {1, 2, 16, 64, 256}) {  // from stretched kernels to plain interpolation
        const SharedPoints points = sharedPoints(source, cells);
        EXPECT_EQ(points.shared, pointsOnEdges(cells));
        EXPECT_EQ(points.different, 0) << cells;
    }
}

TEST(HeightSource, TilingDoesNotChangeABit) {
    const TemporaryFolder folder;
    writeImage(folder / "noise.tif", noiseImage(512));
    const HeightSource source = mustOpen(folder / "noise.tif");
    expectTilesAgree(source, 32, 12);
    expectTilesAgree(source, 256, 6);
}

TEST(HeightSource, ReadingInBandsDoesNotChangeABit) {
    const TemporaryFolder folder;
    writeImage(folder / "large.tif",
               Image<std::uint8_t>(4096, 2048, [](int column, int row) { return noise(column, row, 256); }),
               {.tile = 256});
    const HeightSource source = mustOpen(folder / "large.tif");
    constexpr int cells = 64;  // the tile takes in all of the image's width and half its height
    const std::vector<float> whole = sampled(source, {Face::PosZ, cells, 8, 8, 49, 49});
    for (const auto& [column, row] : {std::pair{8, 8}, {32, 32}, {31, 32}, {40, 20}, {56, 50}}) {
        const float single = sampledAt(source, Face::PosZ, cells, column, row);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(single),
                  std::bit_cast<std::uint32_t>(whole[static_cast<std::size_t>((row - 8) * 49 + column - 8)]));
        EXPECT_NEAR(single, 127.5, 8);
    }
}

TEST(HeightSource, ThreadsAgreeToTheBit) {
    const TemporaryFolder folder;
    writeImage(folder / "noise.tif", noiseImage(512), {.tile = 32});
    HeightSourceSettings settings;
    settings.cacheBytes = 40 << 10;  // ten tiles of 128: they fight for it
    const HeightSource source = mustOpen(folder / "noise.tif", settings);
    std::array<std::vector<float>, faceCount> alone;
    for (const Face face : allFaces) alone[static_cast<std::size_t>(face)] = sampledFace(source, face, 128);
    std::array<int, 4> wrong{};
    std::vector<std::thread> threads;
    for (std::size_t thread = 0; thread < wrong.size(); ++thread) {
        threads.emplace_back([&, thread] {
            for (std::size_t i = 0; i < faceCount; ++i) {
                const Face face = allFaces[(i + thread) % faceCount];
                if (sampledFace(source, face, 128) != alone[static_cast<std::size_t>(face)]) ++wrong[thread];
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(wrong, ::testing::Each(0));
}

TEST(HeightSource, TiledImageLargerThanItsCacheIsSampledRight) {
    const TemporaryFolder folder;
    writeImage(folder / "rows.tif", noiseImage(1024));
    writeImage(folder / "tiles.tif", noiseImage(1024), {.tile = 64});
    HeightSourceSettings settings;
    settings.cacheBytes = 64 << 10;  // of 2 MB
    const HeightSource whole = mustOpen(folder / "rows.tif");
    const HeightSource tiles = mustOpen(folder / "tiles.tif", settings);
    for (const Face face : allFaces) EXPECT_EQ(sampledFace(tiles, face, 256), sampledFace(whole, face, 256));
    EXPECT_EQ(tiles.minM, whole.minM);
    EXPECT_EQ(tiles.maxM, whole.maxM);
}

TEST(HeightSource, UntiledImageLargerThanItsCacheIsSampledRightAndLeavesNoFile) {
    const TemporaryFolder folder;
    const TemporaryFolder temporary;
    const char* const before = std::getenv("TMPDIR");
    const std::string restore = before ? before : "";
    ::setenv("TMPDIR", temporary.path().c_str(), 1);
    for (const char* const name : {"noise.png", "noise.tif"}) {
        writeImage(folder / name, Image<std::uint16_t>(1000, 499, [](int column, int row) {
                       return noise(column, row, 65536);
                   }));
        HeightSourceSettings settings;
        const HeightSource whole = mustOpen(folder / name);
        settings.cacheBytes = 256 << 10;  // of 2 MB
        const HeightSource spilled = mustOpen(folder / name, settings);
        EXPECT_TRUE(std::filesystem::is_empty(temporary.path()));
        for (const Face face : allFaces) {
            EXPECT_EQ(sampledFace(spilled, face, 256), sampledFace(whole, face, 256)) << name;
        }
    }
    before ? ::setenv("TMPDIR", restore.c_str(), 1) : ::unsetenv("TMPDIR");
}

template <class T>
void expectMetres(const TemporaryFolder& folder, const std::string& name, const Layout& layout,
                  bool isFloat) {
    const auto value = [](int column, int row) { return std::floor(noise(column, row, 100)); };
    writeImage(folder / name, Image<T>(64, 32, value), layout);
    writeImage(folder / "metres.tif",
               Image<float>(64, 32, [&](int column, int row) { return 0.5 * value(column, row) - 50; }));
    HeightSourceSettings settings;
    settings.metresPerUnit = 0.5;
    settings.offsetM = -50;
    const HeightSource source = mustOpen(folder / name, settings);
    const HeightSource metres = mustOpen(folder / "metres.tif");
    EXPECT_EQ(source.stepM, isFloat ? 0 : 0.5) << name;
    EXPECT_LE(source.minM, metres.minM) << name;
    EXPECT_GE(source.maxM, metres.maxM) << name;
    for (const Face face : {Face::PosX, Face::NegX, Face::PosZ}) {
        const std::vector<float> found = sampledFace(source, face, 32);
        const std::vector<float> expected = sampledFace(metres, face, 32);
        for (std::size_t i = 0; i < found.size(); ++i) {
            // The one is held to its type's range, the other to what it holds: overshoots may differ.
            ASSERT_NEAR(std::clamp(double(found[i]), metres.minM, metres.maxM), expected[i], 1e-5) << name;
        }
    }
}

TEST(HeightSource, EveryTypeAndFormatGivesMetres) {
    const TemporaryFolder folder;
    expectMetres<std::uint8_t>(folder, "u8.png", {}, false);
    expectMetres<std::uint8_t>(folder, "u8.tif", {}, false);
    expectMetres<std::int8_t>(folder, "i8.tif", {}, false);
    expectMetres<std::uint16_t>(folder, "u16.png", {}, false);
    expectMetres<std::uint16_t>(folder, "u16.tif", {.tile = 16}, false);
    expectMetres<std::int16_t>(folder, "i16.tif", {}, false);
    expectMetres<std::int16_t>(folder, "i16tiled.tif", {.tile = 16}, false);
    expectMetres<std::uint32_t>(folder, "u32.tif", {}, false);
    expectMetres<std::int32_t>(folder, "i32.tif", {}, false);
    expectMetres<float>(folder, "f32.tif", {.tile = 16}, true);
    expectMetres<double>(folder, "f64.tif", {}, true);
    expectMetres<float>(folder, "f16.exr", {.asHalf = true}, true);
    expectMetres<float>(folder, "f32.exr", {.tile = 16}, true);
}

TEST(HeightSource, WideTypesAndFloatsAreScannedForTheirRange) {
    const TemporaryFolder folder;
    writeImage(folder / "wide.tif",
               Image<std::int32_t>(8, 4, [](int column, int row) { return column - 100 * row; }));
    writeImage(folder / "float.tif",
               Image<float>(8, 4, [](int column, int row) { return column - 100.5 * row; }));
    HeightSourceSettings settings;
    settings.metresPerUnit = -2;
    const HeightSource wide = mustOpen(folder / "wide.tif", settings);
    EXPECT_EQ(wide.minM, -14);
    EXPECT_EQ(wide.maxM, 600);
    EXPECT_EQ(wide.stepM, 2);
    const HeightSource floats = mustOpen(folder / "float.tif");
    EXPECT_EQ(floats.minM, -301.5);
    EXPECT_EQ(floats.maxM, 7);
}

TEST(HeightSource, SamplesStayWithinTheRange) {
    const TemporaryFolder folder;
    writeImage(folder / "cliff.tif",
               Image<float>(64, 32, [](int column, int) { return column < 32 ? 0 : 100; }));
    const HeightSource source = mustOpen(folder / "cliff.tif");
    for (const Face face : allFaces) {
        EXPECT_THAT(sampledFace(source, face, 256),
                    ::testing::Each(AllOf(::testing::Ge(source.minM), ::testing::Le(source.maxM))));
    }
}

template <class T>
void expectMissingIsFilled(const TemporaryFolder& folder, T missing, std::optional<double> noDataValue,
                           const Layout& layout) {
    const auto isMissing = [](int column, int row) { return (column * 7 + row * 3) % 11 == 0; };
    const auto value = [](int column, int row) { return std::floor(noise(column, row, 100)) + 1; };
    std::uint64_t count = 0;
    Image<T> holed(64, 32, value);
    for (int row = 0; row < 32; ++row) {
        for (int column = 0; column < 64; ++column) {
            if (!isMissing(column, row)) continue;
            holed.samples[static_cast<std::size_t>(64 * row + column)] = missing;
            ++count;
        }
    }
    writeImage(folder / "holed.tif", holed, layout);
    writeImage(folder / "filled.tif", Image<float>(64, 32, [&](int column, int row) {
                   return isMissing(column, row) ? -7 : value(column, row);
               }));
    HeightSourceSettings settings;
    settings.noDataValue = noDataValue;
    settings.fillM = -7;
    const HeightSource source = mustOpen(folder / "holed.tif", settings);
    EXPECT_EQ(source.missingCount, count);
    EXPECT_EQ(source.minM, -7);
    EXPECT_LE(source.maxM, 100);
    const HeightSource expected = mustOpen(folder / "filled.tif");
    for (const Face face : allFaces)
        EXPECT_EQ(sampledFace(source, face, 64), sampledFace(expected, face, 64));
}

TEST(HeightSource, MissingSamplesAreCountedAndFilledBeforeFiltering) {
    const TemporaryFolder folder;
    expectMissingIsFilled<std::int16_t>(folder, -32768, -32768, {});
    expectMissingIsFilled<std::int16_t>(folder, -32768, -32768, {.tile = 16});
    expectMissingIsFilled<std::uint8_t>(folder, 0, 0, {});
    expectMissingIsFilled<float>(folder, std::numeric_limits<float>::quiet_NaN(), {}, {});
    expectMissingIsFilled<float>(folder, std::numeric_limits<float>::quiet_NaN(), -9999, {.tile = 16});
    expectMissingIsFilled<float>(folder, -9999.9f, -9999.9, {});
    expectMissingIsFilled<float>(folder, std::numeric_limits<float>::infinity(), {}, {});
    expectMissingIsFilled<double>(folder, -1.7976931348623157e308, -1.7976931348623157e308, {});
}

TEST(HeightSource, NaturalFaceSizeLosesNoResolution) {
    const TemporaryFolder folder;
    // A grid step covers up to 2 / cells radians, a source step 2 pi / width.
    for (const auto& [width, size] : {std::pair{100, 33}, {102, 65}, {200, 65}, {402, 129}}) {
        writeImage(folder / "plain.png", Image<std::uint8_t>(width, width / 2, [](int, int) { return 0; }));
        EXPECT_EQ(mustOpen(folder / "plain.png").naturalFaceSize, size) << width;
    }
}

TEST(HeightSource, SmallestImagesAreSampled) {
    const TemporaryFolder folder;
    writeImage(folder / "two.tif", Image<float>(2, 1, [](int column, int) { return column; }));
    const HeightSource two = mustOpen(folder / "two.tif");
    for (const int cells : {1, 4}) EXPECT_EQ(sharedPoints(two, cells).different, 0);
    EXPECT_NEAR(sampledAt(two, Face::PosZ, 4, 2, 2), 0.5, 1e-6);
    EXPECT_NEAR(sampledAt(two, Face::PosY, 4, 2, 2), 1, 1e-6);  // 90 east is the middle of the eastern half
    EXPECT_NEAR(sampledAt(two, Face::NegY, 4, 2, 2), 0, 1e-6);
}

TEST(HeightSource, OddWidthsAreSampled) {
    const TemporaryFolder folder;
    // No column is half a turn on from another: off by half a sample beyond the poles.
    writeImage(
        folder / "grid.tif", Image<float>(723, 361, [](int column, int row) {
            return smoothField(directionFromGeographic({std::numbers::pi * (0.5 - (row + 0.5) / 361),
                                                        std::numbers::pi * ((column + 0.5) * 2 / 723 - 1)}));
        }));
    EXPECT_LT(largestError(mustOpen(folder / "grid.tif"), 128, smoothField), 2);
}

TEST(HeightSource, MoreThanOneChannelIsRefused) {
    const TemporaryFolder folder;
    const Image<std::uint8_t> grey(8, 4, [](int, int) { return 1; });
    writeImage(folder / "rgb.png", grey, {.channels = 3});
    writeImage(folder / "alpha.tif", grey, {.channels = 2});
    EXPECT_THAT(
        errorOf(folder / "rgb.png"),
        AllOf(HasSubstr("rgb.png"), HasSubstr("has 3 channels (R, G, B); expected one grey channel")));
    EXPECT_THAT(errorOf(folder / "alpha.tif"), HasSubstr("has 2 channels (Y, A); expected one grey channel"));
}

TEST(HeightSource, WrongShapesAreRefused) {
    const TemporaryFolder folder;
    writeImage(folder / "square.png", Image<std::uint8_t>(64, 64, [](int, int) { return 1; }));
    writeImage(folder / "thin.png", Image<std::uint8_t>(1, 1, [](int, int) { return 1; }));
    EXPECT_THAT(
        errorOf(folder / "square.png"),
        AllOf(HasSubstr("is 64 x 64 samples; expected an equirectangular image of the whole planet, twice "
                        "as wide as high"),
              HasSubstr("heights of a region need a coordinate reference system")));
    EXPECT_THAT(errorOf(folder / "thin.png"), HasSubstr("is 1 x 1 samples"));
}

TEST(HeightSource, SamplesOfUnevenBitsAreRefused) {
    const TemporaryFolder folder;
    const Image<std::uint8_t> grey(8, 4, [](int, int) { return 1; });
    writeImage(folder / "four.tif", grey, {.bitsPerSample = 4});
    EXPECT_THAT(errorOf(folder / "four.tif"), HasSubstr("four.tif: has 4 bits per sample"));
    // 2 x 1 samples of 4 bits.
    constexpr std::string_view png(
        "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x01\x04\0\0\0\0\x14\xb9\xcd\x57\0\0\0\x0aIDAT"
        "\x08\xd7\x63\x28\x07\0\0\x79\0\x78\xf9\xbd\xf9\xbc\0\0\0\0IEND\xae\x42\x60\x82",
        67);
    writeBytes(folder / "four.png", std::string(png));
    EXPECT_THAT(errorOf(folder / "four.png"), HasSubstr("four.png: has 4 bits per sample"));
}

TEST(HeightSource, UnreadableFilesAreRefused) {
    const TemporaryFolder folder;
    writeBytes(folder / "empty.tif", "");
    writeBytes(folder / "noise.tif", "this is no image at all");
    EXPECT_THAT(errorOf(folder / "none.tif"), AllOf(HasSubstr("none.tif"), HasSubstr("no such file")));
    EXPECT_EQ(openHeightSource(folder / "none.tif", {}).error().kind, ErrorKind::Io);
    EXPECT_THAT(errorOf(folder / "empty.tif"), HasSubstr("empty.tif: is empty"));
    const std::string noise = errorOf(folder / "noise.tif");
    EXPECT_THAT(noise, HasSubstr("noise.tif: is not a readable image; expected GeoTIFF, TIFF, PNG, JPEG"));
    EXPECT_THAT(noise, Not(HasSubstr("format reader")));
    EXPECT_THAT(errorOf(folder.path()), HasSubstr("is not a file"));
}

TEST(HeightSource, CutOffImagesAreErrorsNotHeights) {
    const TemporaryFolder folder;
    // No PNG: libpng leaves its reading of a cut-off file by a long jump, over strings of its caller.
    writeImage(folder / "rows.tif", noiseImage(512));
    writeImage(folder / "tiles.tif", noiseImage(512), {.tile = 64});
    writeImage(folder / "tiles16.tif",
               Image<std::uint16_t>(512, 256, [](int column, int row) { return noise(column, row, 65536); }),
               {.tile = 64});
    for (const char* const name : {"rows.tif", "tiles.tif", "tiles16.tif"}) {
        std::filesystem::resize_file(folder / name, std::filesystem::file_size(folder / name) * 2 / 3);
        const Result<HeightSource> source = openHeightSource(folder / name, {});
        if (!source) {
            EXPECT_THAT(source.error().message, HasSubstr(name));
            continue;
        }
        int failed = 0;
        for (const Face face : allFaces) {
            std::vector<float> out(65 * 65);
            const Result<void> done = source->sample({face, 64, 0, 0, 65, 65}, out);
            if (done) continue;
            ++failed;
            EXPECT_THAT(done.error().message, HasSubstr(name));
            EXPECT_THAT(done.error().message, Not(HasSubstr("4294967295")));
        }
        EXPECT_GT(failed, 0) << name;
    }
}

TEST(HeightSource, SettingsOutOfRangeAreRefused) {
    HeightSourceSettings settings;
    settings.metresPerUnit = 0;
    EXPECT_THAT(errorOf(earthElevation, settings), HasSubstr("metresPerUnit is 0"));
    settings.metresPerUnit = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(errorOf(earthElevation, settings), HasSubstr("metresPerUnit is nan"));
    settings = {};
    settings.offsetM = std::numeric_limits<double>::infinity();
    EXPECT_THAT(errorOf(earthElevation, settings), HasSubstr("offsetM is inf"));
    settings = {};
    settings.fillM = 1e10;
    EXPECT_THAT(errorOf(earthElevation, settings), HasSubstr("fillM is"));
    settings = {};
    settings.rawBits = 12;
    EXPECT_THAT(errorOf(earthElevation, settings), HasSubstr("rawBits is 12; expected 8 or 16"));
    settings = {};
    settings.rawSize = 1;
    EXPECT_THAT(errorOf(earthElevation, settings), HasSubstr("rawSize is 1"));
}

}  // namespace
}  // namespace planet
