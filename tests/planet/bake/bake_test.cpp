#include "planet/bake/bake.h"

#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include <atomic>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <random>

#include "planet/bake/file_report.h"
#include "planet/bake/quantise.h"
#include "planet/format/chunk_file.h"
#include "planet/sphere/chunk_surface.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using ::tests::contentOf;
using ::tests::TemporaryFolder;

// Every chunk of a file, parents before children.
void visitAll(const ChunkFile& file, const ChunkData& chunk,
              const std::function<void(const ChunkData&)>& visit) {
    visit(chunk);
    if (chunk.id.level == deepestLevelOf(file.info().shape)) return;
    const auto children = file.readChildren(chunk.id, chunk.children, chunk.heights);
    ASSERT_TRUE(children) << children.error().message;
    for (const ChunkData& child : *children) visitAll(file, child, visit);
}
void visitAll(const ChunkFile& file, const std::function<void(const ChunkData&)>& visit) {
    for (const Face face : allFaces) {
        const auto root = file.readRoot(face);
        ASSERT_TRUE(root) << root.error().message;
        visitAll(file, *root, visit);
    }
}

TEST(Bake, everyChunkAndFaceSizeHoldsTheSourcesHeightsAtEveryLevel) {
    const TemporaryFolder folder;
    for (const auto& sizes : {std::pair{17, 17}, {17, 129}, {33, 65}, {33, 257}, {65, 257}, {129, 257}}) {
        const int chunk = sizes.first;
        const int face = sizes.second;
        const auto path = folder / "a.chk";
        const auto report =
            bake(test::hillsSource(), BakeSettings{.faceSize = face, .chunkSize = chunk}, path);
        ASSERT_TRUE(report) << report.error().message;
        const auto file = ChunkFile::open(path);
        ASSERT_TRUE(file) << file.error().message;
        const PlanetShape& shape = file->info().shape;
        EXPECT_EQ(faceCells(shape) + 1, face);
        EXPECT_EQ(chunkSize(shape), chunk);
        std::uint64_t chunks = 0;
        visitAll(*file, [&](const ChunkData& data) {
            ++chunks;
            const FaceSquare square = faceSquareOf(data.id);
            const double step = square.side / chunkCells(shape);
            for (int j = 0; j < chunk; ++j) {
                for (int i = 0; i < chunk; ++i) {
                    const double expected = test::hillsM(
                        sphereFromCube(cubePoint(data.id.face, square.u + step * i, square.v + step * j)));
                    const std::int32_t stored = data.heights[static_cast<std::size_t>(j * chunk + i)];
                    ASSERT_EQ(heightM(shape, stored), expected) << toString(data.id) << " " << i << "," << j;
                }
            }
        });
        EXPECT_EQ(chunks, report->chunks);
    }
}

TEST(Bake, verifyFindsNothingWrongAndTheSourceMatches) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    const HeightSource source = test::hillsSource();
    ASSERT_TRUE(bake(source, BakeSettings{.chunkSize = 17}, path));
    const auto file = ChunkFile::open(path);
    const auto report = verifyFile(*file, &source);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->problemCount, 0u) << report->problems.front();
    EXPECT_EQ(report->chunks, 6u * (1 + 4 + 16 + 64));
    EXPECT_EQ(report->edges,
              report->chunks * 2);  // each chunk has four, each shared by two: faces' edges too
    EXPECT_EQ(report->leafSamples, 6u * 64 * 17 * 17);
}

TEST(Bake, verifySeesAnotherSource) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.chunkSize = 17}, path));
    const HeightSource other = test::formulaSource(
        [](const glm::dvec3& d) {
            return test::hillsM(d) + (glm::length(d - glm::dvec3(0, 0, 1)) < 0.1 ? 3 : 0);
        },
        -3000, 3000);
    const auto report = verifyFile(*ChunkFile::open(path), &other);
    ASSERT_TRUE(report);
    ASSERT_GT(report->problemCount, 0u);
    EXPECT_NE(report->problems.front().find("differ from the source by up to 3 m"), std::string::npos);
    EXPECT_NE(report->problems.front().find("z_pos"), std::string::npos);
}

TEST(Bake, verifySeesEdgesThatDisagreeBetweenFaces) {
    // A source that breaks its promise: what it says depends on the face it is asked through.
    HeightSource source = test::hillsSource();
    source.sample = [inner = source.sample](const SampleTile& tile, std::span<float> out) -> Result<void> {
        auto result = inner(tile, out);
        if (tile.face == Face::NegY) {
            for (float& height : out) height += 1;
        }
        return result;
    };
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bake(source, BakeSettings{.chunkSize = 17}, path));
    const auto report = verifyFile(*ChunkFile::open(path), nullptr);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->problemCount, 4u * (1 + 2 + 4 + 8));  // all edges of that face, at each level
    EXPECT_NE(report->problems.front().find("edge differs"), std::string::npos);
}

TEST(Bake, deltaBoundsTheDistanceToTheFinestSurfaceEverywhere) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.faceSize = 257, .chunkSize = 17}, path));
    const auto file = ChunkFile::open(path);
    const PlanetShape& shape = file->info().shape;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(0, chunkCells(shape));
    // The drawn point of a chunk at (x, y) cells: flat on the triangle, not on the sphere.
    const auto surfacePoint = [&](const ChunkData& chunk, double x, double y) {
        const FaceSquare square = faceSquareOf(chunk.id);
        const double step = square.side / chunkCells(shape);
        const auto vertex = [&](double i, double j) {
            const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(chunkSize(shape)) +
                            static_cast<std::size_t>(i);
            return positionM(
                shape, sphereFromCube(cubePoint(chunk.id.face, square.u + step * i, square.v + step * j)),
                heightM(shape, chunk.heights[at]));
        };
        const double i = std::min(std::floor(x), chunkCells(shape) - 1.0);
        const double j = std::min(std::floor(y), chunkCells(shape) - 1.0);
        const double s = x - i;
        const double t = y - j;
        const glm::dvec3 sw = vertex(i, j);
        const glm::dvec3 ne = vertex(i + 1, j + 1);
        const glm::dvec3 corner = s >= t ? vertex(i + 1, j) : vertex(i, j + 1);
        return s >= t ? sw + s * (corner - sw) + t * (ne - corner)
                      : sw + t * (corner - sw) + s * (ne - corner);
    };
    double tightest = 0;
    for (const Face face : {Face::PosX, Face::NegY, Face::PosZ}) {
        for (int trial = 0; trial < 300; ++trial) {
            std::vector<ChunkData> chain = {*file->readRoot(face)};
            std::vector<std::pair<double, double>> places = {{any(random), any(random)}};
            while (chain.back().id.level < deepestLevelOf(shape)) {
                auto [x, y] = places.back();
                const int quadrant =
                    (x >= chunkCells(shape) / 2.0 ? 1 : 0) + (y >= chunkCells(shape) / 2.0 ? 2 : 0);
                places.push_back({2 * x - (quadrant & 1) * chunkCells(shape),
                                  2 * y - (quadrant >> 1) * chunkCells(shape)});
                auto children =
                    file->readChildren(chain.back().id, chain.back().children, chain.back().heights);
                chain.push_back((*children)[static_cast<std::size_t>(quadrant)]);
            }
            const glm::dvec3 truth = surfacePoint(chain.back(), places.back().first, places.back().second);
            for (std::size_t level = 0; level + 1 < chain.size(); ++level) {
                const double distance = glm::length(
                    surfacePoint(chain[level], places[level].first, places[level].second) - truth);
                ASSERT_LE(distance, chain[level].deltaCM * (1 + 1e-6)) << toString(chain[level].id);
                tightest = std::max(tightest, distance / chain[level].deltaCM);
            }
        }
    }
    EXPECT_GT(tightest, 0.3);  // a bound, not a wild guess
}

TEST(Bake, sameBytesWhateverTheThreads) {
    const TemporaryFolder folder;
    ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.faceSize = 257, .chunkSize = 17, .threads = 1},
                     folder / "1.chk"));
    ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.faceSize = 257, .chunkSize = 17, .threads = 5},
                     folder / "5.chk"));
    EXPECT_EQ(contentOf(folder / "1.chk"), contentOf(folder / "5.chk"));
}

TEST(Bake, progressGrowsToTheWholeAndReportsRates) {
    const TemporaryFolder folder;
    std::vector<BakeProgress> seen;
    ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.chunkSize = 17}, folder / "a.chk",
                     [&](const BakeProgress& progress) {
                         seen.push_back(progress);
                         return true;
                     }));
    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(seen.back().samplesDone, seen.back().samplesTotal);
    EXPECT_EQ(seen.back().samplesTotal, 6u * 128 * 128);
    EXPECT_GT(seen.back().samplesPerS, 0);
    EXPECT_EQ(seen.back().remainingS, 0);
}

TEST(Bake, cancelledLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.chk") << "old";
    // Slow enough that the first report comes before the end.
    HeightSource source = test::hillsSource(1025);
    std::atomic<int> reports = 0;
    const auto result =
        bake(source, BakeSettings{}, folder / "a.chk", [&](const BakeProgress&) { return ++reports < 1; });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(reports, 1);
    EXPECT_EQ(contentOf(folder / "a.chk"), "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Bake, sourceErrorIsHandedOnAndLeavesNothing) {
    const TemporaryFolder folder;
    HeightSource source = test::hillsSource();
    source.sample = [](const SampleTile&, std::span<float>) -> Result<void> {
        return ioError("tiles.tif: tile 7 is damaged");
    };
    const auto result = bake(source, BakeSettings{.chunkSize = 17}, folder / "a.chk");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "tiles.tif: tile 7 is damaged");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Bake, badSettingsSayWhatWouldBeRight) {
    const TemporaryFolder folder;
    const auto messageOf = [&](const BakeSettings& settings) {
        const auto result = bake(test::hillsSource(), settings, folder / "a.chk");
        return result ? "" : result.error().message;
    };
    EXPECT_NE(messageOf({.faceSize = 1000}).find("2^n + 1"), std::string::npos);
    EXPECT_NE(messageOf({.faceSize = 17, .chunkSize = 33}).find("is out of range; expected [33, "),
              std::string::npos);
    EXPECT_NE(messageOf({.faceSize = (1 << 30) + 1}).find("face size"), std::string::npos);
    EXPECT_NE(messageOf({.chunkSize = 32}).find("17, 33, 65 or 129"), std::string::npos);
    EXPECT_NE(messageOf({.radiusM = 0}).find("radius"), std::string::npos);
    EXPECT_NE(messageOf({.radiusM = 1000}).find("below the centre"), std::string::npos);
    EXPECT_NE(messageOf({.quantumM = -1}).find("quantum"), std::string::npos);
    EXPECT_NE(messageOf({.quantumM = 0.05}).find("quantum"), std::string::npos);
    EXPECT_NE(messageOf({.threads = -1}).find("threads"), std::string::npos);
    EXPECT_NE(messageOf({.compressionLevel = 99}).find("compression level"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Bake, debugLevelsAreImagesOfEachLevelAndFace) {
    const TemporaryFolder folder;
    BakeSettings settings{.faceSize = 65, .chunkSize = 17};
    settings.debugLevelsFolder = folder / "levels";
    // Brightest at the north pole, the middle of +z; in +x the first row is the northernmost.
    const auto source =
        test::formulaSource([](const glm::dvec3& d) { return std::round(1000 * d.z); }, -1000, 1000);
    ASSERT_TRUE(bake(source, settings, folder / "a.chk"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "levels"), {}), 6 * 3);
    for (int level = 0; level < 3; ++level) {
        const int side = (16 << level) + 1;
        const auto image =
            OIIO::ImageInput::open((folder / "levels" / fmt::format("x_pos_level{:02}.png", level)).string());
        ASSERT_TRUE(image);
        ASSERT_EQ(image->spec().width, side);
        ASSERT_EQ(image->spec().height, side);
        std::vector<std::uint16_t> pixels(static_cast<std::size_t>(side * side));
        ASSERT_TRUE(image->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, pixels.data()));
        for (int row = 0; row < side; ++row) {
            const double z = sphereFromCube(cubePoint(Face::PosX, 0, 1 - 2.0 * row / (side - 1))).z;
            const auto grey = pixels[static_cast<std::size_t>(row * side + side / 2)];
            EXPECT_NEAR(grey, 65535 * (z + 1) / 2, 65) << row;
        }
    }
}

TEST(Quantise, integerSourcesKeepTheirOwnStepsExactly) {
    struct Case {
        double minM, maxM, stepM;
    };
    for (const Case& c : {Case{-32768, 32767, 1}, Case{0, 65535, 1}, Case{0, 255, 1},
                          Case{-3000.25, 3552.75, 0.1}, Case{-0.5 * 32768 + 100, 0.5 * 32767 + 100, 0.5}}) {
        const auto source =
            test::formulaSource([](const glm::dvec3&) { return 0.0; }, c.minM, c.maxM, c.stepM);
        PlanetShape shape;
        ASSERT_TRUE(chooseQuantum(source, std::nullopt, shape));
        EXPECT_EQ(shape.quantumM, c.stepM);
        for (double value = c.minM; value <= c.maxM; value += c.stepM * 997) {
            const std::vector<float> heights = {static_cast<float>(value)};
            std::vector<std::int32_t> steps(1);
            ASSERT_TRUE(quantise(shape, source, heights, {}, steps));
            EXPECT_NEAR(heightM(shape, steps[0]), value, c.stepM * 0.01);
        }
    }
}

TEST(Quantise, floatSourcesGetTheFinestStepThatHoldsTheirRange) {
    const auto source = test::formulaSource([](const glm::dvec3&) { return 0.0; }, -10000, 8800, 0);
    PlanetShape shape;
    ASSERT_TRUE(chooseQuantum(source, std::nullopt, shape));
    EXPECT_EQ(shape.quantumM, 0.5);
    ASSERT_TRUE(chooseQuantum(source, 2.0, shape));
    EXPECT_EQ(shape.quantumM, 2);
    const auto tooFine = chooseQuantum(source, 0.01, shape);
    ASSERT_FALSE(tooFine);
    EXPECT_NE(tooFine.error().message.find("at least 0.5 m"), std::string::npos);
}

TEST(Quantise, overshootIsCutToTheSourcesRangeAndRealHeightsThatDoNotFitAreErrors) {
    const auto source = test::formulaSource([](const glm::dvec3&) { return 0.0; }, -32768, 32767, 1);
    PlanetShape shape;
    ASSERT_TRUE(chooseQuantum(source, std::nullopt, shape));
    std::vector<std::int32_t> steps(2);
    ASSERT_TRUE(quantise(shape, source, std::vector<float>{40000.f, -40000.f}, {}, steps));
    EXPECT_EQ(steps[0], 32767);
    EXPECT_EQ(steps[1], -32768);
    // An int16 image at a quantum of 10 cm: what lies within 3276 m is kept, Everest is an error that says
    // so.
    ASSERT_TRUE(chooseQuantum(source, 0.1, shape));
    EXPECT_TRUE(quantise(shape, source, std::vector<float>{3000.f, -3000.f}, {}, steps));
    EXPECT_EQ(steps[0], 30000);
    const auto everest = quantise(shape, source, std::vector<float>{8848.f, 0.f}, {}, steps);
    ASSERT_FALSE(everest);
    EXPECT_NE(everest.error().message.find("8848"), std::string::npos);
}

TEST(Probe, givesTheFinestHeightAndTheWholeChain) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    const auto smooth = [](const glm::dvec3& d) { return std::round(2000 * d.z + 500 * d.x); };
    ASSERT_TRUE(
        bake(test::formulaSource(smooth, -3000, 3000), BakeSettings{.faceSize = 257, .chunkSize = 17}, path));
    const auto file = ChunkFile::open(path);
    for (const auto& [latitude, longitude] : {std::pair{0.1, 0.2}, {1.5, -2.0}, {-1.57, 3.1}, {0.6, -0.8}}) {
        const auto probe = probeFile(*file, {latitude, longitude});
        ASSERT_TRUE(probe);
        EXPECT_NEAR(probe->heightM, smooth(directionFromGeographic({latitude, longitude})), 2);
        ASSERT_EQ(probe->chain.size(), 5u);
        for (std::size_t level = 1; level < probe->chain.size(); ++level) {
            EXPECT_EQ(parentOf(probe->chain[level].id), probe->chain[level - 1].id);
            EXPECT_LE(probe->chain[level].deltaCM, probe->chain[level - 1].deltaCM);
        }
        EXPECT_EQ(probe->chain.back().deltaCM, 0);
    }
}

TEST(Report, countsChunksAndBytesOfEachLevel) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.faceSize = 129, .chunkSize = 17}, path));
    const auto file = ChunkFile::open(path);
    const auto report = reportFile(*file);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->levels.size(), 4u);
    std::uint64_t bytes = chunkFileHeaderBytes;
    for (const LevelReport& level : report->levels) {
        EXPECT_EQ(level.chunks, 6u << (2 * level.level));
        EXPECT_LE(level.minDeltaM, level.medianDeltaM);
        EXPECT_LE(level.medianDeltaM, level.maxDeltaM);
        bytes += level.bytes;
    }
    EXPECT_EQ(bytes, report->fileBytes);
    EXPECT_EQ(report->levels.back().maxDeltaM, 0);
    EXPECT_GT(report->levels.front().minDeltaM, report->levels[2].maxDeltaM);
}

}  // namespace
}  // namespace planet
