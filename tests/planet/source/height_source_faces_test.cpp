#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/planet/source/height_source_fixture.h"

namespace planet {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

// The value of a face's sample, row 0 at the top.
using FaceValue = std::function<double(Face face, int column, int row)>;

std::string rawBytes(int size, int bits, bool bigEndian, Face face, const FaceValue& value) {
    std::string bytes;
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const auto step = static_cast<std::uint16_t>(static_cast<int>(value(face, column, row)));
            const char low = static_cast<char>(step & 0xFF);
            const char high = static_cast<char>(step >> 8);
            if (bits == 16 && bigEndian) bytes += high;
            bytes += low;
            if (bits == 16 && !bigEndian) bytes += high;
        }
    }
    return bytes;
}

std::string faceFile(const std::string& stem, Face face, const std::string& extension) {
    return stem + "_" + std::string(faceName(face)) + extension;
}

struct RawFormat {
    int bits = 16;
    bool bigEndian = false;
};

void writeRawFaces(const TemporaryFolder& folder, const std::string& stem, int size, const FaceValue& value,
                   const RawFormat& format = {}) {
    for (const Face face : allFaces) {
        writeBytes(folder / faceFile(stem, face, ".raw"),
                   rawBytes(size, format.bits, format.bigEndian, face, value));
    }
}

template <class T>
void writeFaceImages(const TemporaryFolder& folder, const std::string& stem, const std::string& extension,
                     int size, const FaceValue& value, const Layout& layout = {}) {
    for (const Face face : allFaces) {
        writeImage(folder / faceFile(stem, face, extension),
                   Image<T>(size, size, [&](int column, int row) { return value(face, column, row); }),
                   layout);
    }
}

// Noise, different on every face but for the samples of the edges that faces share.
FaceValue rough(int size) {
    return [size](Face face, int column, int row) {
        const int last = size - 1;
        const FacePoint point =
            facePointFromCube(cubePoint(face, 2.0 * column / last - 1, 1 - 2.0 * row / last));
        const auto ownColumn = static_cast<int>(std::lround((point.u + 1) / 2 * last));
        const auto ownRow = static_cast<int>(std::lround((1 - point.v) / 2 * last));
        return std::floor(noise(ownColumn + 1000 * static_cast<int>(point.face), ownRow, 256));
    };
}

bool isOnEdge(int size, int column, int row) {
    return column == 0 || row == 0 || column == size - 1 || row == size - 1;
}

// One value on all edges of the cube.
FaceValue withEdgesOf(double edgeValue, int size, const FaceValue& inside) {
    return [=](Face face, int column, int row) {
        return isOnEdge(size, column, row) ? edgeValue : inside(face, column, row);
    };
}

FaceValue fieldOnFaces(int size) {
    return [size](Face face, int column, int row) {
        const double last = size - 1;
        return smoothField(sphereFromCube(cubePoint(face, 2 * column / last - 1, 1 - 2 * row / last)));
    };
}

void expectExactCopies(const HeightSource& source, int size, double offset = 0) {
    const FaceValue value = rough(size);
    for (const Face face : allFaces) {
        const std::vector<float> heights = sampledFace(source, face, size - 1);
        std::size_t at = 0;
        for (int row = 0; row < size; ++row) {
            for (int column = 0; column < size; ++column) {
                ASSERT_EQ(heights[at++], value(face, column, size - 1 - row) + offset)
                    << faceName(face) << " column " << column << " row " << row;
            }
        }
    }
}

TEST(HeightSourceFaces, GridOfTheSourcesOwnSizeIsAnExactCopy) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth65", 65, rough(65));
    const HeightSource source = mustOpen(folder / "earth65_z_pos.raw");
    EXPECT_EQ(source.description, "earth65, six faces of 65 x 65 uint16");
    EXPECT_EQ(source.naturalFaceSize, 65);
    EXPECT_EQ(source.sampleCount, 6u * 65u * 65u);
    EXPECT_EQ(source.stepM, 1);
    EXPECT_EQ(source.minM, 0);
    EXPECT_EQ(source.maxM, 255);
    expectExactCopies(source, 65);
}

TEST(HeightSourceFaces, EveryFormatGivesMetres) {
    const TemporaryFolder folder;
    HeightSourceSettings settings;
    settings.offsetM = -100;
    writeRawFaces(folder, "eight33", 33, rough(33), {.bits = 8});
    expectExactCopies(mustOpen(folder / "eight33", settings), 33, -100);
    writeRawFaces(folder, "little33", 33, rough(33));
    expectExactCopies(mustOpen(folder / "little33", settings), 33, -100);
    writeFaceImages<std::uint16_t>(folder, "png33", ".png", 33, rough(33));
    expectExactCopies(mustOpen(folder / "png33", settings), 33, -100);
    writeFaceImages<float>(folder, "float33", ".tif", 33, rough(33), {.tile = 16});
    expectExactCopies(mustOpen(folder / "float33", settings), 33, -100);
    writeFaceImages<std::int16_t>(folder, "noSizeInName", ".tif", 33, rough(33));
    expectExactCopies(mustOpen(folder / "noSizeInName", settings), 33, -100);
    writeRawFaces(folder, "big33", 33, rough(33), {.bigEndian = true});
    settings.rawBigEndian = true;
    expectExactCopies(mustOpen(folder / "big33", settings), 33, -100);
}

TEST(HeightSourceFaces, SignedRawStepsMayBeNegative) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "deep9", 9,
                  withEdgesOf(-8000, 9, [](Face, int column, int) { return -1000 * column; }));
    HeightSourceSettings settings;
    settings.rawSigned = true;
    const HeightSource source = mustOpen(folder / "deep9", settings);
    EXPECT_EQ(source.minM, -8000);
    EXPECT_EQ(sampledAt(source, Face::PosX, 8, 7, 4), -7000);
}

TEST(HeightSourceFaces, AnyFaceOrTheStemNamesThem) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth9", 9, rough(9));
    for (const Face face : allFaces)
        expectExactCopies(mustOpen(folder / faceFile("earth9", face, ".raw")), 9);
    expectExactCopies(mustOpen(folder / "earth9"), 9);
    expectExactCopies(mustOpen(folder / "earth9_y_neg"), 9);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    expectExactCopies(mustOpen("earth9"), 9);
    expectExactCopies(mustOpen("earth9_x_pos.raw"), 9);
    std::filesystem::current_path(before);
}

TEST(HeightSourceFaces, RawSizeComesFromTheLengthWhereTheNameHasNone) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "moon", 17, rough(17));
    writeRawFaces(folder, "ganymede", 17, rough(17), {.bits = 8});
    expectExactCopies(mustOpen(folder / "moon"), 17);
    expectExactCopies(mustOpen(folder / "ganymede"), 17);
}

TEST(HeightSourceFaces, SettingsOverrideTheName) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "apollo11", 17, rough(17));
    EXPECT_THAT(errorOf(folder / "apollo11"),
                AllOf(HasSubstr("is 578 bytes; 11 x 11 samples"),
                      EndsWith("; if the 11 in the name is not the size, use --raw-size 17")));
    HeightSourceSettings settings;
    settings.rawSize = 17;
    settings.rawBits = 16;
    expectExactCopies(mustOpen(folder / "apollo11", settings), 17);
}

TEST(HeightSourceFaces, nameThatEndsInANumberAndTheSizeSuggestsRawSize) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "noise17129", 129, rough(129), {.bits = 8});
    EXPECT_THAT(errorOf(folder / "noise17129"),
                EndsWith("the 17129 in the name is not the size, use --raw-size 129"));
    writeFaceImages<std::uint8_t>(folder, "moon2024", ".png", 9, rough(9));
    EXPECT_THAT(errorOf(folder / "moon2024"),
                EndsWith("the 2024 in the name is not the size, use --raw-size 9"));
    HeightSourceSettings settings;
    settings.rawSize = 9;
    EXPECT_EQ(mustOpen(folder / "moon2024", settings).naturalFaceSize, 9);
}

TEST(HeightSourceFaces, SharedEdgesAndCornersAreBitIdenticalThoughFacesAreRoundedDifferently) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "rough65", 65, [](Face face, int column, int row) {
        return rough(65)(face, column, row) + static_cast<int>(face) % 2;
    });
    const HeightSource source = mustOpen(folder / "rough65");
    for (const int cells : {1, 2, 16, 64, 128}) {
        const SharedPoints points = sharedPoints(source, cells);
        EXPECT_EQ(points.shared, pointsOnEdges(cells));
        EXPECT_EQ(points.different, 0) << cells;
    }
}

TEST(HeightSourceFaces, TilingDoesNotChangeABit) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "rough100", 100, rough(100));
    const HeightSource source = mustOpen(folder / "rough100");
    expectTilesAgree(source, 16, 12);
    expectTilesAgree(source, 128, 8);
}

TEST(HeightSourceFaces, SmoothFieldSurvivesFinerAndCoarserGridsEdgesIncluded) {
    const TemporaryFolder folder;
    writeFaceImages<float>(folder, "smooth", ".tif", 129, fieldOnFaces(129));
    const HeightSource source = mustOpen(folder / "smooth");
    EXPECT_EQ(source.stepM, 0);
    // Nowell's map has a kink across the cube's edges, of some 1 / 129 of a face's own slope there.
    EXPECT_LT(largestError(source, 512, smoothField), 2);
    EXPECT_LT(largestError(source, 128, smoothField), 1e-3);
    EXPECT_LT(largestError(source, 32, smoothField), 15);
}

TEST(HeightSourceFaces, SizesNeedNotBePowersOfTwo) {
    const TemporaryFolder folder;
    writeFaceImages<float>(folder, "smooth", ".tif", 100, fieldOnFaces(100));
    const HeightSource source = mustOpen(folder / "smooth");
    EXPECT_EQ(source.naturalFaceSize, 129);
    EXPECT_LT(largestError(source, 128, smoothField), 3);
}

TEST(HeightSourceFaces, CheckerboardFinerThanTheGridAveragesToGrey) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "checks257", 257,
                  [](Face, int column, int row) { return (column + row) % 2 * 200; }, {.bits = 8});
    EXPECT_LT(largestError(mustOpen(folder / "checks257"), 64, [](const glm::dvec3&) { return 100; }), 1);
}

TEST(HeightSourceFaces, LinearRampHasNoStairSteps) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "ramp17", 17,
                  withEdgesOf(128, 17, [](Face, int column, int) { return 16 * column; }), {.bits = 8});
    const std::vector<float> row = sampled(mustOpen(folder / "ramp17"), {Face::PosX, 1024, 128, 512, 769, 1});
    for (std::size_t i = 0; i < row.size(); ++i) {
        ASSERT_NEAR(row[i], static_cast<double>(i + 128) / 4, 1e-3) << i;
    }
}

TEST(HeightSourceFaces, FacesLargerThanTheCacheAreSampledRight) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "raw600", 600, rough(600));
    writeFaceImages<std::uint16_t>(folder, "png600", ".png", 600, rough(600));
    writeFaceImages<std::uint16_t>(folder, "tiled600", ".tif", 600, rough(600), {.tile = 128});
    const HeightSource whole = mustOpen(folder / "raw600");
    HeightSourceSettings settings;
    settings.cacheBytes = 600 << 10;  // of 8.6 MB
    for (const char* const name : {"raw600", "png600", "tiled600"}) {
        const HeightSource small = mustOpen(folder / name, settings);
        for (const Face face : allFaces) {
            const SampleTile tile{face, 512, 300, 400, 213, 113};
            EXPECT_EQ(sampled(small, tile), sampled(whole, tile)) << name;
        }
    }
}

TEST(HeightSourceFaces, MissingSamplesAreCountedOverAllFacesAndFilled) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "holes17", 17, [](Face, int column, int row) { return column == row ? 7 : 50; });
    HeightSourceSettings settings;
    settings.noDataValue = 7;
    settings.fillM = 20;
    const HeightSource source = mustOpen(folder / "holes17", settings);
    EXPECT_EQ(source.missingCount, 6u * 17u);
    EXPECT_EQ(source.minM, 20);
    EXPECT_EQ(source.maxM, 50);
    EXPECT_EQ(sampledAt(source, Face::PosX, 16, 5, 11), 20);  // rows of the source fall
    EXPECT_EQ(sampledAt(source, Face::PosX, 16, 5, 5), 50);
}

TEST(HeightSourceFaces, FacesThatDisagreeAlongAnEdgeAreRefused) {
    const TemporaryFolder folder;
    // The right column of +x is the left column of +y.
    writeRawFaces(folder, "torn17", 17, [](Face face, int column, int row) {
        return face == Face::PosY && column == 0 && row > 0 && row < 16 ? 100 + row : 100;
    });
    EXPECT_THAT(
        errorOf(folder / "torn17"),
        AllOf(HasSubstr("torn17: faces x_pos and y_pos differ by up to 15 m along their shared edge, the "
                        "right column of x_pos and the left column of y_pos: 100 m and 115 m at row 15 "
                        "of x_pos; 14 of 17 samples there and 1 of 12 edges differ"),
              HasSubstr("expected the same heights on both faces, to 1 m")));
    HeightSourceSettings settings;
    settings.metresPerUnit = 20;
    EXPECT_THAT(errorOf(folder / "torn17", settings), HasSubstr("differ by up to 300 m"));
    writeRawFaces(folder, "turned17", 17, [](Face face, int column, int row) {
        return face == Face::PosZ ? rough(17)(face, row, 16 - column) : rough(17)(face, column, row);
    });
    EXPECT_THAT(errorOf(folder / "turned17"), AllOf(HasSubstr("z_pos"), HasSubstr("4 of 12 edges differ")));
}

// Every edge and each direction along it: in turn one sample of one face is planted.
TEST(HeightSourceFaces, ASampleThatDisagreesIsFoundOnEveryEdge) {
    const TemporaryFolder folder;
    for (const Face planted : allFaces) {
        struct Place {
            int column, row;
            const char* side;
        };
        for (const Place& place : {Place{0, 3, "left column"}, Place{8, 3, "right column"},
                                   Place{3, 0, "top row"}, Place{3, 8, "bottom row"}}) {
            writeRawFaces(folder, "planted9", 9, [&](Face face, int column, int row) {
                const bool isPlanted = face == planted && column == place.column && row == place.row;
                return rough(9)(face, column, row) + (isPlanted ? 500 : 0);
            });
            EXPECT_THAT(errorOf(folder / "planted9"),
                        AllOf(HasSubstr("differ by up to 500 m"), HasSubstr("1 of 9 samples"),
                              HasSubstr(std::string(place.side) + " of " + std::string(faceName(planted)))));
        }
    }
}

TEST(HeightSourceFaces, FacesOfFloatsAgreeToRounding) {
    const TemporaryFolder folder;
    const auto apart = [](double byM) {
        return [byM](Face face, int column, int row) {
            return fieldOnFaces(33)(face, column, row) + (face == Face::NegZ ? byM : 0);
        };
    };
    writeFaceImages<float>(folder, "near", ".tif", 33, apart(0.001));
    EXPECT_EQ(errorOf(folder / "near"), "opened");
    writeFaceImages<float>(folder, "far", ".tif", 33, apart(0.5));
    EXPECT_THAT(errorOf(folder / "far"), HasSubstr("z_neg"));
}

TEST(HeightSourceFaces, FacesAtPixelCentresAreRefused) {
    const TemporaryFolder folder;
    writeFaceImages<float>(folder, "centres", ".tif", 64, [](Face face, int column, int row) {
        return smoothField(
            sphereFromCube(cubePoint(face, (2 * column + 1) / 64.0 - 1, 1 - (2 * row + 1) / 64.0)));
    });
    EXPECT_THAT(errorOf(folder / "centres"), AllOf(HasSubstr("12 of 12 edges differ"),
                                                   HasSubstr("resample faces whose samples lie at pixel")));
}

TEST(HeightSourceFaces, AMissingSampleAgreesWithAnyHeight) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "void9", 9,
                  [](Face face, int column, int) { return face == Face::PosY && column == 0 ? 9999 : 300; });
    EXPECT_THAT(errorOf(folder / "void9"), HasSubstr("differ by up to 9699 m"));
    HeightSourceSettings settings;
    settings.noDataValue = 9999;
    EXPECT_EQ(errorOf(folder / "void9", settings), "opened");
}

TEST(HeightSourceFaces, AllMissingFacesAreNamed) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth9", 9, rough(9));
    std::filesystem::remove(folder / "earth9_y_neg.raw");
    std::filesystem::remove(folder / "earth9_z_pos.raw");
    for (const char* const name : {"earth9", "earth9_x_pos.raw", "earth9_z_pos.raw"}) {
        EXPECT_THAT(errorOf(folder / name),
                    AllOf(HasSubstr("missing"), HasSubstr("earth9_y_neg.raw, earth9_z_pos.raw"),
                          Not(HasSubstr("earth9_x_neg.raw"))));
    }
}

TEST(HeightSourceFaces, RawLengthsThatFitNothingAreRefused) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth65", 65, rough(65));
    std::filesystem::resize_file(folder / "earth65_x_pos.raw", 8449);
    EXPECT_EQ(errorOf(folder / "earth65_x_pos.raw"),
              "earth65_x_pos.raw is 8449 bytes; 65 x 65 samples of 8 or 16 bits would be 4225 or 8450");
    writeRawFaces(folder, "mars", 9, rough(9));
    std::filesystem::resize_file(folder / "mars_x_pos.raw", 163);
    EXPECT_THAT(errorOf(folder / "mars"), HasSubstr("mars_x_pos.raw is 163 bytes, which no square"));
    writeRawFaces(folder, "io9", 9, rough(9));
    HeightSourceSettings settings;
    settings.rawBits = 8;
    EXPECT_EQ(errorOf(folder / "io9", settings),
              "io9_x_pos.raw is 162 bytes; 9 x 9 samples of 8 bits would be 81");
}

TEST(HeightSourceFaces, FacesOfDifferentSizesOrTypesAreRefused) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth9", 9, rough(9));
    std::filesystem::resize_file(folder / "earth9_y_pos.raw", 81);
    EXPECT_THAT(errorOf(folder / "earth9"),
                AllOf(HasSubstr("earth9_y_pos.raw is 81 bytes"), HasSubstr("earth9_x_pos.raw is 162")));
    writeFaceImages<std::uint8_t>(folder, "size", ".png", 9, rough(9));
    writeImage(folder / "size_z_neg.png", Image<std::uint8_t>(17, 17, [](int, int) { return 0; }));
    EXPECT_THAT(errorOf(folder / "size"),
                HasSubstr("size_z_neg.png is 17 x 17 uint8 but size_x_pos.png is 9"));
    writeFaceImages<std::uint8_t>(folder, "type", ".png", 9, rough(9));
    writeImage(folder / "type_z_neg.png", Image<std::uint16_t>(9, 9, [](int, int) { return 0; }));
    EXPECT_THAT(errorOf(folder / "type"),
                HasSubstr("type_z_neg.png is 9 x 9 uint16 but type_x_pos.png is 9 x 9 uint8"));
}

TEST(HeightSourceFaces, FacesOfTheWrongShapeAreRefused) {
    const TemporaryFolder folder;
    writeFaceImages<std::uint8_t>(folder, "flat", ".png", 9, rough(9));
    writeImage(folder / "flat_y_pos.png", Image<std::uint8_t>(18, 9, [](int, int) { return 0; }));
    EXPECT_THAT(errorOf(folder / "flat"),
                HasSubstr("flat_y_pos.png is 18 x 9 samples; expected a square cube face"));
    writeFaceImages<std::uint8_t>(folder, "named65", ".png", 9, rough(9));
    EXPECT_THAT(errorOf(folder / "named65"),
                HasSubstr("named65_x_pos.png is 9 x 9 samples; its name says 65 x 65"));
    writeRawFaces(folder, "dot1", 1, rough(1));
    EXPECT_THAT(errorOf(folder / "dot1"), HasSubstr("a face of 1 samples per side"));
}

TEST(HeightSourceFaces, APathStandsForItsFaces) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth9", 9, rough(9));
    writeBytes(folder / "earth9_notes.txt", "no face");
    for (const char* name : {"earth9", "earth9_y_pos.raw"}) {
        const HeightSourceFiles found = heightSourceFiles(folder / name);
        EXPECT_EQ(found.stem, "earth9") << name;
        EXPECT_EQ(found.files.size(), 6u) << name;
        EXPECT_TRUE(heightSourceExists(folder / name));
    }
    std::filesystem::remove(folder / "earth9_z_neg.raw");
    EXPECT_EQ(heightSourceFiles(folder / "earth9").files.size(), 5u) << "those that are there";
    writeBytes(folder / "earth.tif", "one image");
    EXPECT_EQ(heightSourceFiles(folder / "earth.tif").files.size(), 1u);
    writeBytes(folder / "earth.chk", "baked");
    EXPECT_FALSE(heightSourceExists(folder / "earth.chk"));
    EXPECT_FALSE(heightSourceExists(folder / "absent.tif"));
    EXPECT_FALSE(heightSourceExists(""));
}

TEST(HeightSourceFaces, ColourFacesAreRefused) {
    const TemporaryFolder folder;
    writeFaceImages<std::uint8_t>(folder, "colour", ".png", 9, rough(9), {.channels = 3});
    EXPECT_THAT(errorOf(folder / "colour"),
                AllOf(HasSubstr("colour_x_pos.png"), HasSubstr("has 3 channels")));
}

TEST(HeightSourceFaces, FileCutOffAfterOpeningIsAnError) {
    const TemporaryFolder folder;
    writeRawFaces(folder, "earth65", 65, rough(65));
    HeightSourceSettings settings;
    settings.cacheBytes = 0;  // nothing is kept of what opening has read
    const HeightSource source = mustOpen(folder / "earth65", settings);
    std::filesystem::resize_file(folder / "earth65_y_pos.raw", 100);
    std::vector<float> out(65 * 65);
    const Result<void> done = source.sample({Face::PosY, 64, 0, 0, 65, 65}, out);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("earth65_y_pos.raw: ended at byte 100"));
}

}  // namespace
}  // namespace planet
