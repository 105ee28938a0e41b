// Bakes of sources that are fine in some places only: the tree, the heights and the errors of their files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "planet/bake/bake.h"
#include "planet/bake/bake_estimate.h"
#include "planet/bake/bake_tree.h"
#include "planet/bake/file_report.h"
#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"
#include "planet/select/drawn_surface.h"
#include "planet/source/height_source.h"
#include "planet/source/sample_tiles.h"
#include "tests/planet/source/raster_fixture.h"
#include "tests/support/chunks_of_file.h"
#include "tests/support/sparse_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::Chunks;
using test::chunksOf;
using test::unmorphed;
using testing::HasSubstr;
using ::tests::contentOf;
using ::tests::TemporaryFolder;

struct BakedTree {
    TemporaryFolder folder;
    BakeReport report;
    ChunkFileInfo info;
    PlanetShape shape;
    Chunks chunks;

    BakedTree(const HeightSource& source, const BakeSettings& settings) {
        const auto baked = bake(source, settings, path());
        EXPECT_TRUE(baked) << (baked ? "" : baked.error().message);
        report = baked.value();
        const ChunkFile file = ChunkFile::open(path()).value();
        info = file.info();
        shape = info.shape;
        chunks = chunksOf(file);
    }
    std::filesystem::path path() const { return folder / "a.chk"; }
};

// Calls visit for each leaf at or under a chunk.
void forEachLeaf(const Chunks& chunks, const ChunkId& id,
                 const std::function<void(const ChunkData&)>& visit) {
    const ChunkData& chunk = chunks.at(id);
    if (!chunk.children.exists()) return visit(chunk);
    for (int q = 0; q < quadrantCount; ++q) forEachLeaf(chunks, childOf(id, q), visit);
}

// Returns the largest distance of the samples of all leaves under a chunk from its surface.
double farthestSampleM(const BakedTree& baked, const ChunkData& chunk) {
    const int cells = chunkCells(baked.shape);
    const DrawnGrid drawn = unmorphed(baked.shape, chunk);
    double most = 0;
    forEachLeaf(baked.chunks, chunk.id, [&](const ChunkData& leaf) {
        const int levels = leaf.id.level - chunk.id.level;
        const auto left = static_cast<int>(leaf.id.x - (chunk.id.x << levels)) * cells;
        const auto bottom = static_cast<int>(leaf.id.y - (chunk.id.y << levels)) * cells;
        const DrawnGrid grid = unmorphed(baked.shape, leaf);
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const glm::dvec3 point =
                    pointOn(drawn, std::ldexp(left + i, -levels), std::ldexp(bottom + j, -levels));
                const auto at = static_cast<std::size_t>(j * (cells + 1) + i);
                most = std::max(most, glm::length(point - grid.positionM[at]));
            }
        }
    });
    return most;
}

TEST(SparseBake, refinesWhereTheSourceIsFineAndNowhereElse) {
    const HeightSource source = test::sparseHills(2048);
    const BakedTree baked(source, {.chunkSize = 17});
    EXPECT_EQ(deepestLevelOf(baked.shape), 7);
    std::uint64_t leaves = 0;
    for (const auto& [id, chunk] : baked.chunks) {
        const bool fine = id.level < 7 && source.finestCells(id) > (16 << id.level);
        EXPECT_EQ(chunk.children.exists(), id.level < 5 || fine) << toString(id);
        EXPECT_EQ(isRefined(source, baked.shape, id), chunk.children.exists()) << toString(id);
        leaves += !chunk.children.exists();
        if (!chunk.children.exists()) {
            EXPECT_EQ(chunk.deltaCM, 0);
            EXPECT_EQ(chunk.deltaTightM, 0);
        }
    }
    EXPECT_EQ(baked.info.chunks, baked.chunks.size());
    EXPECT_EQ(baked.report.chunks, baked.chunks.size());
    EXPECT_EQ(leafCountOf(baked.info.chunks), leaves);
    EXPECT_EQ(baked.info.coarsestLeafLevel, 5);
    EXPECT_FALSE(isDense(baked.info));
    EXPECT_LT(baked.info.chunks, chunkCountOf(baked.shape) / 8);
    EXPECT_EQ(baked.report.samples, leaves * 16 * 16 + 2);
}

TEST(SparseBake, holdsTheSourcesHeightsAtEveryVertexOfEveryLevel) {
    const BakedTree baked(test::sparseHills(4096), {.chunkSize = 33});
    const int cells = chunkCells(baked.shape);
    for (const auto& [id, chunk] : baked.chunks) {
        const FaceSquare square = faceSquareOf(id);
        const double step = square.side / cells;
        std::size_t at = 0;
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const double expected = test::hillsM(
                    sphereFromCube(cubePoint(id.face, square.u + step * i, square.v + step * j)));
                ASSERT_EQ(heightM(baked.shape, chunk.heights[at++]), expected) << toString(id);
            }
        }
    }
}

TEST(SparseBake, fortyTilesHaveTheBlocksOfTheWholeRaster) {
    const TemporaryFolder folder;
    const test::SampleGrid grid = test::gridAround(32719, -70.3, -32.6, 400, 250, 200);
    std::vector<float> samples = test::samplesOf(grid, [](double longitude, double latitude) {
        return 2000 + 900 * std::sin(40 * longitude) * std::cos(30 * latitude);
    });
    for (int i = 0; i < grid.width * grid.height; ++i) {
        const int column = i % grid.width;
        const int row = i / grid.width;
        if (std::hypot(column - 210, row - 140) < 70) samples[static_cast<std::size_t>(i)] = -9999;
    }
    writeRaster(folder / "whole.tif", grid, samples, {.noData = -9999});
    for (int tile = 0; tile < 40; ++tile) {
        const int left = tile / 5 * 50;
        const int top = tile % 5 * 50;
        std::vector<float> part;
        for (int row = top; row < top + 50; ++row) {
            const auto from = samples.begin() + row * grid.width + left;
            part.insert(part.end(), from, from + 50);
        }
        const test::SampleGrid place{grid.epsg, 50, 50, grid.x + left * grid.step, grid.y - top * grid.step,
                                     grid.step};
        writeRaster(folder / ("tile" + std::to_string(tile) + ".tif"), place, part, {.noData = -9999});
    }
    const HeightSource wholeSource = openHeightSource(folder / "whole.tif", {}).value();
    const HeightSource tilesSource = openHeightSource(folder / "tile*.tif", {}).value();
    EXPECT_EQ(wholeSource.naturalFaceSize, tilesSource.naturalFaceSize);
    const BakedTree whole(wholeSource, {.chunkSize = 17});
    const BakedTree tiles(tilesSource, {.chunkSize = 17});
    EXPECT_GT(whole.chunks.size(), 500u);
    ASSERT_EQ(whole.chunks.size(), tiles.chunks.size());
    for (const auto& [id, chunk] : whole.chunks) {
        ASSERT_TRUE(tiles.chunks.contains(id)) << toString(id);
        const ChunkData& other = tiles.chunks.at(id);
        ASSERT_EQ(chunk.children, other.children) << toString(id);
        ASSERT_EQ(chunk.deltaCM, other.deltaCM) << toString(id);
        ASSERT_EQ(chunk.deltaTightM, other.deltaTightM) << toString(id);
        for (std::size_t i = 0; i < chunk.heights.size(); ++i)
            ASSERT_EQ(heightM(whole.shape, chunk.heights[i]), heightM(tiles.shape, other.heights[i]))
                << toString(id);
    }
}

// Heights that depend on the filter, as those of a file do: an average over a cell of its grid.
HeightSource filteredSource(int faceSize) {
    HeightSource source = test::hillsSource(faceSize);
    source.sample = [](const SampleTile& tile, std::span<float> out) -> Result<void> {
        const double width = 2.0 / filterCellsOf(tile);
        std::size_t at = 0;
        for (int j = 0; j < tile.rows; ++j) {
            for (int i = 0; i < tile.columns; ++i) {
                const glm::dvec3 d =
                    directionOf(tile.face, tile.faceCells, tile.firstColumn + i, tile.firstRow + j);
                out[at++] = static_cast<float>(test::hillsM(d) + 1000 * std::sin(5000 * width * d.x));
            }
        }
        return {};
    };
    source.minM -= 1000;
    source.maxM += 1000;
    return source;
}

TEST(SparseBake, hasTheHeightsAndDecisionsOfADenseBakeWhereBothHaveAChunk) {
    const BakedTree dense(filteredSource(1025), {.chunkSize = 17});
    const BakedTree sparse(test::sparse(filteredSource(1025), test::middleEdgeAndCorner(1024)),
                           {.chunkSize = 17});
    int whole = 0;
    for (const auto& [id, chunk] : sparse.chunks) {
        const ChunkData& other = dense.chunks.at(id);
        ASSERT_EQ(chunk.heights, other.heights) << toString(id);
        ASSERT_LE(chunk.deltaTightM, other.deltaTightM * (1 + 1e-6f)) << toString(id);
        bool complete = chunk.children.exists();
        forEachLeaf(sparse.chunks, id, [&](const ChunkData& leaf) {
            complete = complete && leaf.id.level == deepestLevelOf(dense.shape);
        });
        if (!complete) continue;
        ++whole;
        ASSERT_EQ(chunk.deltaCM, other.deltaCM) << toString(id);
        ASSERT_EQ(chunk.deltaTightM, other.deltaTightM) << toString(id);
        ASSERT_EQ(chunk.minStep, other.minStep) << toString(id);
        ASSERT_EQ(chunk.maxStep, other.maxStep) << toString(id);
    }
    EXPECT_GT(whole, 10);
    EXPECT_LT(sparse.report.fileBytes, dense.report.fileBytes / 2);
}

TEST(SparseBake, OfASourceThatIsFineEverywhereHasTheBytesOfADenseOne) {
    const TemporaryFolder folder;
    const BakeSettings settings{.faceSize = 1025, .chunkSize = 17, .tileLevels = 1};
    HeightSource source = test::hillsSource(1025);
    ASSERT_TRUE(bake(source, settings, folder / "dense.chk"));
    source.finestCells = [](const ChunkId&) { return 1024; };
    ASSERT_TRUE(bake(source, settings, folder / "sparse.chk"));
    EXPECT_TRUE(contentOf(folder / "dense.chk") == contentOf(folder / "sparse.chk"));
}

// Rough enough that the errors of all levels matter.
HeightSource roughSparse(int cells) {
    return test::sparse(
        test::formulaSource(
            [](const glm::dvec3& d) {
                return std::round(test::hillsM(d) / 4 +
                                  300 * std::sin(9001 * d.x + 7 * d.z) * std::sin(8009 * d.y + 7507 * d.z));
            },
            -3000, 3000, 1, cells + 1),
        {test::boxAround({0.1, 0.2, 1}, 0.01, cells), test::boxAround({-1, 1, 1}, 0.02, cells / 2)});
}

class SparseErrors : public testing::TestWithParam<std::optional<int>> {};

TEST_P(SparseErrors, AreThoseOfTheSamplesOfAllLeavesUnderAChunk) {
    const BakedTree baked(roughSparse(4096), {.chunkSize = 17, .radiusM = 60e3, .tileLevels = GetParam()});
    for (const auto& [id, chunk] : baked.chunks) {
        if (!chunk.children.exists()) continue;
        // Chunks over leaves of one level are tested elsewhere, and there are thousands of them.
        const bool mixed = isRefined(roughSparse(4096), baked.shape, childOf(id, 0)) !=
                           isRefined(roughSparse(4096), baked.shape, childOf(id, 3));
        if (!mixed && id.level > 2) continue;
        const double own = farthestSampleM(baked, chunk);
        float ofChildren = 0;
        for (int q = 0; q < quadrantCount; ++q)
            ofChildren = std::max(ofChildren, baked.chunks.at(childOf(id, q)).deltaTightM);
        const double expected = std::max(own, static_cast<double>(ofChildren));
        ASSERT_NEAR(chunk.deltaTightM, expected, 2e-7 * expected + 1e-6) << toString(id);
        ASSERT_LE(chunk.deltaTightM, chunk.deltaCM) << toString(id);
        forEachLeaf(baked.chunks, id, [&ancestor = chunk](const ChunkData& leaf) {
            ASSERT_LE(ancestor.minStep, leaf.minStep);
            ASSERT_GE(ancestor.maxStep, leaf.maxStep);
        });
    }
}

INSTANTIATE_TEST_SUITE_P(TileLevels, SparseErrors, testing::Values(std::nullopt, 0, 1, 4));

TEST(SparseBake, verifyFindsNothingWrongAndTheSourceMatches) {
    const HeightSource source = test::sparseHills(4096);
    for (const int chunk : {17, 33, 129}) {
        const BakedTree baked(source, {.chunkSize = chunk});
        const auto report = verifyFile(*ChunkFile::open(baked.path()), &source);
        ASSERT_TRUE(report);
        EXPECT_EQ(report->problemCount, 0u) << report->problems.front();
        EXPECT_EQ(report->chunks, baked.chunks.size());
        EXPECT_EQ(report->leafSamples,
                  leafCountOf(baked.info.chunks) * static_cast<std::uint64_t>(chunkVertexCount(baked.shape)));
    }
}

TEST(SparseBake, verifySeesAHeaderThatCountsOtherChunks) {
    const BakedTree baked(test::sparseHills(1024), {.chunkSize = 33});
    const std::string text = contentOf(baked.path());
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    ChunkFileInfo info = baked.info;
    info.chunks += 4;
    info.coarsestLeafLevel -= 1;
    const auto header = headerBytes(info, bytes.size());
    std::copy(header.begin(), header.end(), bytes.begin());
    const auto file = ChunkFile::open(
        "a.chk", bytes.size(), [&bytes](std::uint64_t offset, std::span<std::byte> out) -> Result<void> {
            std::memcpy(out.data(), bytes.data() + offset, out.size());
            return {};
        });
    ASSERT_TRUE(file) << file.error().message;
    const auto report = verifyFile(*file, nullptr);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->problemCount, 2u);
    EXPECT_THAT(report->problems[0], HasSubstr("chunks; the header says"));
    EXPECT_THAT(report->problems[1], HasSubstr("coarsest leaf has level 4; the header says 3"));
}

TEST(SparseBake, hasTheSameBytesWhateverTheThreads) {
    const TemporaryFolder folder;
    const HeightSource source = test::sparseHills(8192);
    for (const auto& [name, threads] : {std::pair{"1.chk", 1}, std::pair{"5.chk", 5}})
        ASSERT_TRUE(bake(source, {.chunkSize = 17, .threads = threads}, folder / name));
    EXPECT_TRUE(contentOf(folder / "1.chk") == contentOf(folder / "5.chk"));
}

// Counts the samples that are taken, and notes the filters.
struct Watched {
    std::atomic<std::uint64_t> samples = 0;
    std::atomic<int> otherFilters = 0;

    HeightSource watch(HeightSource source, int filterCells) {
        source.sample = [this, filterCells, inner = source.sample](const SampleTile& tile,
                                                                   std::span<float> out) {
            samples += samplesIn(tile);
            otherFilters += filterCellsOf(tile) != filterCells;
            return inner(tile, out);
        };
        return source;
    }
};

TEST(SparseBake, samplesTheFinePlacesAndTheCoarsePlanetWithOneFilter) {
    Watched watched;
    constexpr int cells = 1 << 17;
    auto flat = test::formulaSource([](const glm::dvec3& d) { return std::round(100 * d.x); }, -100, 100, 1,
                                    cells + 1);
    // Two hundredths of a degree wide.
    const HeightSource source =
        watched.watch(test::sparse(flat, {test::boxAround({0.3, 0.2, 1}, 0.0002, cells)}), cells);
    const BakedTree baked(source, {.chunkSize = 33});
    EXPECT_EQ(deepestLevelOf(baked.shape), 12);
    EXPECT_EQ(watched.otherFilters, 0);
    // Each leaf has 33^2 samples; a few units share some.
    EXPECT_LE(watched.samples, leafCountOf(baked.info.chunks) * 33 * 33);
    EXPECT_LT(watched.samples, 2'500'000u);
    const auto estimate = estimateBake(source, {.chunkSize = 33});
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->chunks, baked.info.chunks);
    EXPECT_EQ(estimate->samples, baked.report.samples);
    EXPECT_EQ(estimate->coarsestLeafLevel, 4);
}

TEST(SparseBake, isEstimatedWithinAFactorOfOneAndAHalf) {
    const BakedTree baked(test::sparseHills(4096), {.chunkSize = 17});
    const auto estimate = estimateBake(test::sparseHills(4096), {.chunkSize = 17});
    ASSERT_TRUE(estimate);
    const double ratio = estimate->fileBytes / static_cast<double>(baked.report.fileBytes);
    EXPECT_GT(ratio, 1 / 1.5);
    EXPECT_LT(ratio, 1.5);
}

TEST(SparseBake, reportsLeavesOfEachLevel) {
    const BakedTree baked(test::sparseHills(2048), {.chunkSize = 17});
    const auto report = reportFile(*ChunkFile::open(baked.path()));
    ASSERT_TRUE(report) << report.error().message;
    std::vector<std::uint64_t> chunks(report->levels.size()), leaves(report->levels.size());
    for (const auto& [id, chunk] : baked.chunks) {
        ++chunks[id.level];
        leaves[id.level] += !chunk.children.exists();
    }
    for (std::size_t level = 0; level < chunks.size(); ++level) {
        EXPECT_EQ(report->levels[level].chunks, chunks[level]);
        EXPECT_EQ(report->levels[level].leaves, leaves[level]);
    }
    EXPECT_GT(report->levels[5].leaves, 0u);
    EXPECT_GT(report->levels[5].minDeltaM, 0);  // a leaf's error of 0 is not counted
    EXPECT_EQ(report->finestSamples, baked.report.samples);
}

TEST(SparseBake, probesDownToTheLeafAtThePlace) {
    const BakedTree baked(test::sparseHills(4096), {.chunkSize = 17});
    const auto file = ChunkFile::open(baked.path());
    const auto fine = probeFile(*file, geographicFromDirection(sphereFromCube({0.1, 0.2, 1})));
    const auto coarse = probeFile(*file, geographicFromDirection(sphereFromCube({0.7, 0.2, 1})));
    ASSERT_TRUE(fine && coarse);
    EXPECT_EQ(fine->chain.back().id.level, 8);
    EXPECT_EQ(coarse->chain.back().id.level, 5);
}

}  // namespace
}  // namespace planet
