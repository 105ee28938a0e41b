// Bakes of sources whose parts know their heights more or less finely: centimetres of lidar in metres of a planet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "planet/bake/bake.h"
#include "planet/bake/bake_tile.h"
#include "planet/bake/file_report.h"
#include "planet/bake/quantise.h"
#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"
#include "planet/planet.h"
#include "planet/source/height_quanta.h"
#include "planet/source/height_source.h"
#include "planet/source/sample_tiles.h"
#include "tests/planet/source/raster_fixture.h"
#include "tests/support/chunks_of_file.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::Chunks;
using test::chunksOf;
using testing::HasSubstr;
using ::tests::contentOf;
using ::tests::TemporaryFolder;

constexpr int utm33 = 32633;
constexpr double edgeDeg = 45;         // a meridian with an edge of the cube
constexpr double cornerDeg = 35.2644;  // and the latitude of a corner on it
const test::RasterFile centimetres{.type = GDT_Int16, .scale = 0.01};

// Metres for the whole planet, and lidar with samples a metre apart.
class FractionBake : public testing::Test {
protected:
    FractionBake() {
        test::writeRaster(folder_ / "planet.tif", {4326, 360, 180, -179.5, 89.5, 1},
                          [](double longitude, double latitude) {
                              return std::round(4000 * std::sin(0.05 * (longitude - 14)) *
                                                std::cos(0.07 * (latitude - 45)));
                          },
                          {.type = GDT_Int16});
    }

    // Lidar around a place: hills of 40 m, and 5 cm of roughness.
    void addLidar(const std::string& name, double longitudeDeg, double latitudeDeg, int side,
                  const test::RasterFile& file) {
        const test::SampleGrid grid = test::gridAround(utm33, longitudeDeg, latitudeDeg, side, side, 1);
        std::mt19937 random(17);
        std::uniform_real_distribution<double> rough(-0.05, 0.05);
        std::vector<float> samples;
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const double heightM = 200 + 20 * std::sin(0.031 * column) + 20 * std::cos(0.023 * row);
                samples.push_back(static_cast<float>((heightM + rough(random)) / file.scale.value_or(1)));
            }
        }
        for (float& sample : samples) sample = file.scale ? std::round(sample) : sample;
        test::writeRaster(folder_ / name, grid, samples, file);
    }

    HeightSource worldOf(const std::vector<std::string>& layers, const std::string& more = "") {
        std::string toml;
        for (const std::string& layer : layers) toml += "[[elevation]]\nfiles = \"" + layer + "\"\n" + more;
        std::ofstream(folder_ / "world.toml") << toml;
        auto source = openHeightSource(folder_ / "world.toml", {});
        EXPECT_TRUE(source) << (source ? "" : source.error().message);
        return source.value();
    }

    BakeReport baked(const HeightSource& source, const std::string& name, const BakeSettings& settings = {}) {
        const auto report = bake(source, settings, folder_ / name);
        EXPECT_TRUE(report) << (report ? "" : report.error().message);
        return report.value();
    }
    ChunkFile opened(const std::string& name) { return ChunkFile::open(folder_ / name).value(); }

    const TemporaryFolder folder_;
};

// The errors of the stored heights, by whether they need a fraction of the file's quantum.
struct Errors {
    std::uint64_t fine = 0;  // samples
    double worstFineM = 0;
    double worstCoarseM = 0;
};

Errors errorsOf(const HeightSource& source, const PlanetShape& shape, const Chunks& chunks) {
    Errors errors;
    for (const auto& [id, chunk] : chunks) {
        if (chunk.children.exists()) continue;
        std::vector<float> heightsM(chunk.heights.size());
        std::vector<float> neededM(chunk.heights.size());
        EXPECT_TRUE(sampleWithQuanta(source, tileOf(shape, id, id.level), shape.radiusM, heightsM, neededM));
        for (std::size_t i = 0; i < heightsM.size(); ++i) {
            const double errorM =
                std::abs(heightM(shape, chunk.heights[i]) - static_cast<double>(heightsM[i]));
            const bool isFine = static_cast<double>(neededM[i]) < fileQuantumM(shape);
            errors.fine += isFine;
            double& worstM = isFine ? errors.worstFineM : errors.worstCoarseM;
            worstM = std::max(worstM, errorM);
        }
    }
    return errors;
}

TEST_F(FractionBake, lidarKeepsItsCentimetresInAPlanetOfMetres) {
    addLidar("int16.tif", 15, 45, 300, centimetres);
    addLidar("float.tif", 15, 45, 300, {});
    for (const std::string lidar : {"int16.tif", "float.tif"}) {
        const HeightSource source = worldOf({"planet.tif", lidar}, "feather_m = 20\n");
        const BakeReport report = baked(source, "a.chk");
        const ChunkFile file = opened("a.chk");
        const PlanetShape& shape = file.info().shape;
        EXPECT_EQ(fileQuantumM(shape), 0.2) << lidar;
        EXPECT_EQ(report.shape.quantumM, shape.quantumM);
        EXPECT_LE(shape.quantumM, 0.016) << lidar;
        EXPECT_GE(shape.quantumM, 0.005) << lidar;
        const Errors errors = errorsOf(source, shape, chunksOf(file));
        EXPECT_GT(errors.fine, 10'000u) << lidar;
        EXPECT_LE(errors.worstFineM, shape.quantumM / 2 * 1.001) << lidar;
        EXPECT_GT(errors.worstFineM, shape.quantumM / 2 * 0.9) << lidar;
        EXPECT_LE(errors.worstCoarseM, fileQuantumM(shape) / 2 * 1.001) << lidar;
        EXPECT_GT(errors.worstCoarseM, fileQuantumM(shape) / 2 * 0.9) << lidar;
    }
}

TEST_F(FractionBake, verifiesAgainstItsSourceAndOpens) {
    addLidar("lidar.tif", 15, 45, 200, centimetres);
    const HeightSource source = worldOf({"planet.tif", "lidar.tif"});
    baked(source, "a.chk");
    const VerifyReport report = verifyFile(opened("a.chk"), &source).value();
    EXPECT_EQ(report.problemCount, 0u) << report.problems[0];
    EXPECT_GT(report.leafSamples, 100'000u);
    const auto planet = Planet::open(folder_ / "a.chk", {}).value();
    const double radiusM = planet->tree().shape.radiusM;
    const View view =
        viewFromPose({.latitudeDeg = 45, .longitudeDeg = 15, .altitudeM = 500}, radiusM, 1, 640, 480);
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    EXPECT_TRUE(planet->settle(view, settings, noUpload, 60));
    EXPECT_TRUE(planet->takeProblems().empty());
    const glm::dvec3 middle = directionFromGeographic({glm::radians(45.0), glm::radians(15.0)});
    EXPECT_NEAR(sampledHeightM(planet->tree(), middle), 200, 41);
}

// Every place has one height, in all chunks of all levels and faces that have a vertex there: at the rim of the lidar,
// across an edge and around a corner of the cube too.
TEST_F(FractionBake, sharedVerticesAreBitIdenticalEverywhere) {
    addLidar("lidar.tif", edgeDeg, cornerDeg, 200, centimetres);
    const HeightSource source = worldOf({"planet.tif", "lidar.tif"}, "feather_m = 30\n");
    baked(source, "a.chk");
    const ChunkFile file = opened("a.chk");
    ASSERT_GT(file.info().shape.fractionBits, 0);
    std::map<std::array<double, 3>, std::int32_t> steps;
    std::uint64_t shared = 0;
    std::uint64_t sharedFine = 0;
    std::array<std::uint64_t, faceCount> fineOnFace{};
    const int coarse = 1 << file.info().shape.fractionBits;
    const int cells = chunkCells(file.info().shape);
    for (const auto& [id, chunk] : chunksOf(file)) {
        const FaceSquare square = faceSquareOf(id);
        for (int at = 0; at < (cells + 1) * (cells + 1); ++at) {
            const glm::dvec3 cube = cubePoint(id.face, square.u + square.side * (at % (cells + 1)) / cells,
                                              square.v + square.side * (at / (cells + 1)) / cells);
            const std::int32_t step = chunk.heights[static_cast<std::size_t>(at)];
            const auto [found, isFirst] = steps.try_emplace({cube.x, cube.y, cube.z}, step);
            ASSERT_EQ(found->second, step) << toString(id) << " " << at;
            shared += !isFirst;
            sharedFine += !isFirst && step % coarse != 0;
            fineOnFace[static_cast<std::size_t>(id.face)] += step % coarse != 0;
        }
    }
    EXPECT_GT(shared, 10'000u);
    EXPECT_GT(sharedFine, 1000u);
    EXPECT_EQ(std::ranges::count_if(fineOnFace, [](std::uint64_t fine) { return fine > 0; }), 3);
}

// Returns the bytes of the blocks of some levels: [first, last].
double bytesOfLevels(const ChunkFile& file, int first, int last) {
    double bytes = 0;
    const FileReport report = reportFile(file).value();
    for (const LevelReport& level : report.levels) {
        if (level.level >= first && level.level <= last) bytes += static_cast<double>(level.bytes);
    }
    return bytes;
}

// Counts the bytes of blocks in two parts.
struct PartBytes {
    std::size_t index = 0;
    std::size_t entries = 0;  // of the index
    std::size_t heights = 0;  // with the checksums

    void add(const ChunkFile& file, BlockLocation block, int chunks, bool mayHaveChildren) {
        std::vector<std::byte> start(std::min<std::size_t>(block.size, largestIndexBytes));
        ASSERT_TRUE(file.readBytes(block.offset, start));
        const BlockIndex read = indexFrom(start, chunks, mayHaveChildren, block.offset).value();
        index += read.bytes;
        heights += block.size - read.bytes;
        entries += static_cast<std::size_t>(
            std::ranges::count_if(read.entries, [](const ChunkEntry& e) { return e.children.exists(); }));
    }
};

// Returns the bytes of the blocks of the coarsest levels: [0, last].
PartBytes partBytes(const ChunkFile& file, int last) {
    PartBytes bytes;
    const int deepest = deepestLevelOf(file.info().shape);
    for (const BlockLocation& root : file.info().roots) bytes.add(file, root, 1, deepest > 0);
    for (const auto& [id, chunk] : chunksOf(file))
        if (chunk.children.exists() && id.level < last)
            bytes.add(file, chunk.children, quadrantCount, id.level + 1 < deepest);
    return bytes;
}

TEST_F(FractionBake, aPlanetAroundLidarCostsHardlyMoreThanBothAlone) {
    addLidar("lidar.tif", 15, 45, 500, centimetres);
    const HeightSource world = worldOf({"planet.tif", "lidar.tif"});
    const BakeReport report = baked(world, "world.chk");
    const double fileM = fileQuantumM(report.shape);
    EXPECT_EQ(baked(world, "coarse.chk", {.quantumM = fileM}).shape.fractionBits, 0);
    const double fineM = report.shape.quantumM;
    EXPECT_EQ(baked(worldOf({"lidar.tif"}), "lidar.chk", {.quantumM = fineM}).shape.fractionBits, 0);
    const ChunkFile file = opened("world.chk");
    const int planetLevel = file.info().coarsestLeafLevel;  // of the leaves without lidar
    const double lidarBytes = bytesOfLevels(opened("lidar.chk"), planetLevel + 1, maxLevel);
    const double insetBytes = bytesOfLevels(file, planetLevel + 1, maxLevel);
    RecordProperty("lidarBytes", std::to_string(lidarBytes));
    RecordProperty("insetBytes", std::to_string(insetBytes));
    EXPECT_GT(lidarBytes, 300'000);
    EXPECT_LE(insetBytes, 1.1 * lidarBytes);
    const PartBytes whole = partBytes(file, planetLevel);
    const PartBytes coarse = partBytes(opened("coarse.chk"), planetLevel);
    EXPECT_EQ(static_cast<double>(whole.index + whole.heights), bytesOfLevels(file, 0, planetLevel));
    // The levels above cost as much as without fractions, but for the corners of the roots in 32 bits instead of 16.
    constexpr std::size_t cornerBytes = faceCount * 4 * (sizeof(std::int32_t) - sizeof(std::int16_t));
    EXPECT_EQ(whole.heights, coarse.heights + cornerBytes);
    // The index has larger numbers, of steps that are 32 times as fine.
    EXPECT_EQ(report.shape.fractionBits, 5);
    EXPECT_EQ(whole.entries, coarse.entries);
    EXPECT_LE(static_cast<double>(whole.index), 1.03 * static_cast<double>(coarse.index));
}

TEST_F(FractionBake, aPlanetOfMetresHasNoFractions) {
    EXPECT_EQ(baked(worldOf({"planet.tif"}), "a.chk").shape.fractionBits, 0);
    EXPECT_EQ(opened("a.chk").info().shape.fractionBits, 0);
    addLidar("lidar.tif", 15, 45, 100, centimetres);
    const HeightSource alone = openHeightSource(folder_ / "lidar.tif", {}).value();
    const BakeReport report = baked(alone, "b.chk");
    EXPECT_EQ(report.shape.fractionBits, 0) << "16 bits hold the centimetres of lidar alone";
    EXPECT_EQ(report.shape.quantumM, 0.01);
}

TEST_F(FractionBake, aQuantumThatIsAskedForCountsForAllUnlessAFinestOneIsToo) {
    addLidar("lidar.tif", 15, 45, 100, centimetres);
    const HeightSource source = worldOf({"planet.tif", "lidar.tif"});
    EXPECT_EQ(baked(source, "a.chk", {.quantumM = 1}).shape.fractionBits, 0);
    const PlanetShape both = baked(source, "b.chk", {.quantumM = 1, .finestQuantumM = 0.02}).shape;
    EXPECT_EQ(both.fractionBits, 6);
    EXPECT_EQ(both.quantumM, 1.0 / 64);
    EXPECT_EQ(baked(source, "c.chk", {.finestQuantumM = 0.1}).shape.fractionBits, 1);
    const auto wrong = bake(source, {.finestQuantumM = 0}, folder_ / "d.chk");
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message, HasSubstr("finest quantum: 0 m is out of range"));
}

TEST_F(FractionBake, aNoticeSaysThatStepsAllowNoFinerQuantum) {
    test::writeRaster(folder_ / "deep.tif", {4326, 36, 18, -175, 85, 10},
                      [](double longitude, double) { return longitude > 0 ? 0 : -3e5; }, {.type = GDT_Int32});
    addLidar("lidar.tif", 15, 45, 50, centimetres);
    const BakeReport report = baked(worldOf({"deep.tif", "lidar.tif"}), "a.chk", {.radiusM = 1e7});
    EXPECT_EQ(fileQuantumM(report.shape), 5);
    EXPECT_EQ(report.shape.quantumM, 5.0 / 128);
    EXPECT_THAT(report.quantumNotice, HasSubstr("need a quantum of 0.01 m, but heights in"));
    EXPECT_THAT(report.quantumNotice, HasSubstr("allow no finer one than 0.0390625 m"));
    EXPECT_EQ(baked(worldOf({"planet.tif", "lidar.tif"}), "b.chk").quantumNotice, "");
}

TEST_F(FractionBake, reuseGivesTheBytesOfAWholeBake) {
    addLidar("lidar.tif", 15, 45, 200, centimetres);
    addLidar("more.tif", 15, 47, 100, centimetres);
    baked(worldOf({"planet.tif", "lidar.tif"}), "old.chk");
    const HeightSource changed = worldOf({"planet.tif", "lidar.tif", "more.tif"});
    const BakeReport copied = baked(changed, "copied.chk", {.reuse = folder_ / "old.chk"});
    EXPECT_GT(copied.copiedChunks, 0u);
    EXPECT_EQ(copied.reuseNotice, "");
    baked(changed, "whole.chk");
    EXPECT_EQ(contentOf(folder_ / "copied.chk"), contentOf(folder_ / "whole.chk"));
}

TEST_F(FractionBake, nothingIsCopiedFromABakeWithOtherFractions) {
    addLidar("lidar.tif", 15, 45, 100, centimetres);
    baked(worldOf({"planet.tif"}), "old.chk");
    const BakeReport report =
        baked(worldOf({"planet.tif", "lidar.tif"}), "new.chk", {.reuse = folder_ / "old.chk"});
    EXPECT_EQ(report.copiedChunks, 0u);
    EXPECT_THAT(report.reuseNotice,
                HasSubstr("its finest quantum is 0.2 m, and that of the new bake 0.00625 m"));
}

// A source of two halves, of which the northern one needs centimetres.
HeightSource halves(double rangeM) {
    HeightSource source =
        test::formulaSource([](const glm::dvec3& d) { return 100 * d.x + d.z; }, -rangeM, rangeM, 0);
    source.finestQuantumM = [](double) { return 0.01; };
    return source;
}

TEST(Fractions, areAsManyAsTheFinestPartNeedsAndNoMoreThanStepsAllow) {
    PlanetShape shape;
    shape.quantumM = 0.5;
    chooseFractions(halves(9000), 0, shape);
    EXPECT_EQ(shape.fractionBits, 6);
    EXPECT_EQ(shape.quantumM, 0.5 / 64);
    EXPECT_EQ(fileQuantumM(shape), 0.5);

    shape.fractionBits = 0;
    shape.quantumM = 32;
    chooseFractions(halves(1e6), 0, shape);
    EXPECT_EQ(shape.fractionBits, 8) << "1e6 m at 0.125 m are 8,000,000 steps, and at half of that too many";

    shape.fractionBits = 0;
    shape.quantumM = 0.01;
    chooseFractions(halves(100), 0, shape);
    EXPECT_EQ(shape.fractionBits, 0) << "as fine as the part already";
}

TEST(Fractions, heightsAreRoundedToTheFractionThatTheyNeed) {
    PlanetShape shape;
    shape.quantumM = 1.0 / 64;
    shape.fractionBits = 6;
    EXPECT_EQ(fractionBitsFor(shape, noQuantumM), 0);
    EXPECT_EQ(fractionBitsFor(shape, 1), 0);
    EXPECT_EQ(fractionBitsFor(shape, 0.3), 2);
    EXPECT_EQ(fractionBitsFor(shape, 1e-9), 6);
    const HeightSource source = halves(10'000);
    const std::vector<float> heights(5, 1000.3f);
    const std::vector<float> needed = {static_cast<float>(noQuantumM), 1, 0.5f, 0.25f, 0.001f};
    std::vector<std::int32_t> steps(5);
    ASSERT_TRUE(quantise(shape, source, heights, needed, steps));
    EXPECT_EQ(steps, (std::vector<std::int32_t>{64000, 64000, 64032, 64016, 64019}));
    ASSERT_TRUE(quantise(shape, source, heights, {}, steps));
    EXPECT_EQ(steps, std::vector<std::int32_t>(5, 64000));
}

TEST(Fractions, roundingWithoutFractionsIsThatOfTheSameQuantum) {
    PlanetShape whole;
    whole.quantumM = 0.5;
    whole.baseHeightM = 0.3;
    PlanetShape fine = whole;
    fine.fractionBits = 7;
    fine.quantumM = whole.quantumM / 128;
    const HeightSource source = halves(9000);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(-9000, 9000);
    std::vector<float> heights(10'000);
    for (float& height : heights) height = any(random);
    std::vector<std::int32_t> steps(heights.size());
    std::vector<std::int32_t> fineSteps(heights.size());
    ASSERT_TRUE(quantise(whole, source, heights, {}, steps));
    ASSERT_TRUE(quantise(fine, source, heights, {}, fineSteps));
    for (std::size_t i = 0; i < steps.size(); ++i) ASSERT_EQ(fineSteps[i], 128 * steps[i]);
}

}  // namespace
}  // namespace planet
