#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <unordered_map>

#include "planet/bake/bake.h"
#include "planet/bake/file_report.h"
#include "planet/bake/finest_distance.h"
#include "planet/base/little_endian.h"
#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"
#include "planet/select/drawn_surface.h"
#include "tests/support/chunks_of_file.h"
#include "tests/support/open_bytes.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::Chunks;
using test::chunksOf;
using test::unmorphed;
using testing::HasSubstr;

struct Baked {
    tests::TemporaryFolder folder;
    PlanetShape shape;
    Chunks chunks;

    Baked(const HeightSource& source, const BakeSettings& settings) {
        const auto report = bake(source, settings, path());
        EXPECT_TRUE(report) << (report ? "" : report.error().message);
        const ChunkFile file = ChunkFile::open(path()).value();
        shape = file.info().shape;
        chunks = chunksOf(file);
    }
    std::filesystem::path path() const { return folder / "a.chk"; }
};

// Hills, and noise that no two neighbouring samples share.
HeightSource roughSource(int faceSize) {
    return test::formulaSource(
        [](const glm::dvec3& d) {
            return std::round(test::hillsM(d) / 4 +
                              300 * std::sin(9001 * d.x + 7 * d.z) * std::sin(8009 * d.y + 7507 * d.z));
        },
        -3000, 3000, 1, faceSize);
}

// By looking at every finest sample under the chunk.
double bruteForceM(const Baked& baked, const ChunkData& chunk) {
    const PlanetShape& shape = baked.shape;
    const int cells = chunkCells(shape);
    const int levels = deepestLevelOf(shape) - chunk.id.level;
    const DrawnGrid drawn = unmorphed(shape, chunk);
    double most = 0;
    for (std::uint32_t leafY = 0; leafY < 1u << levels; ++leafY) {
        for (std::uint32_t leafX = 0; leafX < 1u << levels; ++leafX) {
            const ChunkId id{chunk.id.face, static_cast<std::uint8_t>(deepestLevelOf(shape)),
                             (chunk.id.x << levels) + leafX, (chunk.id.y << levels) + leafY};
            const DrawnGrid leaf = unmorphed(shape, baked.chunks.at(id));
            for (int j = 0; j <= cells; ++j) {
                for (int i = 0; i <= cells; ++i) {
                    const double x = std::ldexp(i + cells * static_cast<int>(leafX), -levels);
                    const double y = std::ldexp(j + cells * static_cast<int>(leafY), -levels);
                    const auto at = static_cast<std::size_t>(j * (cells + 1) + i);
                    most = std::max(most, glm::length(pointOn(drawn, x, y) - leaf.positionM[at]));
                }
            }
        }
    }
    return most;
}

float largestOfChildrenM(const Baked& baked, const ChunkId& id) {
    float largest = 0;
    for (int q = 0; q < quadrantCount; ++q) {
        largest = std::max(largest, baked.chunks.at(childOf(id, q)).deltaTightM);
    }
    return largest;
}

class TightMetricOfChunkSize : public testing::TestWithParam<int> {};

TEST_P(TightMetricOfChunkSize, IsTheFarthestThatAnyFinestSampleLiesOffOrAChildsIfThatIsMore) {
    const Baked baked(roughSource(129), {.chunkSize = GetParam(), .radiusM = 60e3});
    int clearlyLess = 0;
    for (const auto& [id, chunk] : baked.chunks) {
        if (id.level == deepestLevelOf(baked.shape)) {
            EXPECT_EQ(chunk.deltaTightM, 0);
            continue;
        }
        const double own = bruteForceM(baked, chunk);
        const double expected = std::max(own, static_cast<double>(largestOfChildrenM(baked, id)));
        ASSERT_NEAR(chunk.deltaTightM, expected, 2e-7 * expected + 1e-6) << toString(id);
        ASSERT_GE(static_cast<double>(chunk.deltaTightM), own - 1e-9) << toString(id);
        ASSERT_LE(chunk.deltaTightM, chunk.deltaCM) << toString(id);
        ASSERT_GE(chunk.deltaTightM, largestOfChildrenM(baked, id)) << toString(id);
        clearlyLess += static_cast<double>(chunk.deltaTightM) < 0.8 * static_cast<double>(chunk.deltaCM);
    }
    EXPECT_GT(clearlyLess, 4);
}

INSTANTIATE_TEST_SUITE_P(Of17And33, TightMetricOfChunkSize, testing::Values(17, 33));

TEST(TightMetric, OfABareSphereIsWhatItsCurvatureAloneGives) {
    const auto flat = test::formulaSource([](const glm::dvec3&) { return 0.0; }, 0, 1, 1, 129);
    const Baked baked(flat, {.chunkSize = 17});
    for (const auto& [id, chunk] : baked.chunks) {
        if (id.level == deepestLevelOf(baked.shape)) continue;
        const double own = bruteForceM(baked, chunk);
        EXPECT_NEAR(chunk.deltaTightM, own, 1e-6 * own) << toString(id);
        // A cell's diagonal is half as bent on each level, so each adds a quarter of the one above at most.
        EXPECT_LE(chunk.deltaTightM, chunk.deltaCM);
        EXPECT_GT(static_cast<double>(chunk.deltaTightM), 0.7 * static_cast<double>(chunk.deltaCM));
    }
}

// Flat but for one finest sample of a face.
HeightSource bumpSource(Face face, int column, int row, float bumpM) {
    auto source = test::formulaSource([](const glm::dvec3&) { return 0.0; }, 0, 30'000, 1, 129);
    source.sample = [=](const SampleTile& tile, std::span<float> out) -> Result<void> {
        std::fill(out.begin(), out.end(), 0.0f);
        const int i = column - tile.firstColumn;
        const int j = row - tile.firstRow;
        const bool inside = tile.face == face && i >= 0 && j >= 0 && i < tile.columns && j < tile.rows;
        if (inside) out[static_cast<std::size_t>(j * tile.columns + i)] = bumpM;
        return {};
    };
    return source;
}

TEST(TightMetric, FindsABumpOfKnownHeightOnEveryChunkThatLacksItsSample) {
    constexpr float bumpM = 20'000;
    for (const auto& [column, row] : {std::pair{41, 73}, {42, 70}}) {
        const Baked baked(bumpSource(Face::NegY, column, row, bumpM), {.chunkSize = 17, .radiusM = 100e3});
        int found = 0;
        for (const auto& [id, chunk] : baked.chunks) {
            const int stride = 1 << (deepestLevelOf(baked.shape) - id.level);
            const int wide = chunkCells(baked.shape) * stride;
            const bool covers = id.face == Face::NegY && static_cast<int>(id.x) == column / wide &&
                                static_cast<int>(id.y) == row / wide;
            const bool holds = column % stride == 0 && row % stride == 0;
            if (!covers) {
                EXPECT_LT(chunk.deltaTightM, 0.05f * bumpM) << toString(id);
            } else if (!holds) {
                EXPECT_NEAR(chunk.deltaTightM, bumpM, 0.02 * bumpM) << toString(id);
                ++found;
            }
        }
        EXPECT_EQ(found, column % 2 == 1 ? 3 : 2);
    }
}

TEST(TightMetric, IsTheSameOnOneAndManyThreadsAndForAnySizeOfTile) {
    // With tiles of one chunk the two coarsest levels are searched for in the file.
    BakeSettings settings{.faceSize = 1025, .chunkSize = 17, .radiusM = 60e3, .compressionLevel = 0};
    const tests::TemporaryFolder folder;
    HeightSource source = test::formulaSource(
        [](const glm::dvec3& d) { return std::round(3000 * d.x * d.y + 40 * std::sin(5003 * d.z)); }, -3000,
        3000);
    const auto bakeTo = [&](const char* name, int threads, std::optional<int> tileLevels) {
        settings.threads = threads;
        settings.tileLevels = tileLevels;
        EXPECT_TRUE(bake(source, settings, folder / name));
        return ChunkFile::open(folder / name).value();
    };
    const ChunkFile wide = bakeTo("wide.chk", 3, std::nullopt);
    const ChunkFile one = bakeTo("one.chk", 1, 0);
    const ChunkFile many = bakeTo("many.chk", 3, 0);
    const auto bytesOf = [&](const char* name) {
        std::ifstream file(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_TRUE(bytesOf("one.chk") == bytesOf("many.chk"));
    for (const Face face : allFaces) {
        const ChunkData a = wide.readRoot(face).value();
        const ChunkData b = one.readRoot(face).value();
        EXPECT_NEAR(a.deltaTightM, b.deltaTightM, 1e-6f * a.deltaTightM);
        EXPECT_GT(a.deltaTightM, 0);
        const auto childrenOfA = wide.readChildren(a.id, a.children, a.heights).value();
        const auto childrenOfB = one.readChildren(b.id, b.children, b.heights).value();
        for (std::size_t q = 0; q < quadrantCount; ++q) {
            EXPECT_NEAR(childrenOfA[q].deltaTightM, childrenOfB[q].deltaTightM,
                        1e-6f * childrenOfA[q].deltaTightM);
        }
    }
    const FileReport wideReport = reportFile(wide).value();
    const FileReport oneReport = reportFile(one).value();
    for (std::size_t level = 0; level < wideReport.levels.size(); ++level) {
        EXPECT_NEAR(wideReport.levels[level].meanTightM, oneReport.levels[level].meanTightM,
                    1e-6 * wideReport.levels[level].meanTightM);
        EXPECT_EQ(wideReport.levels[level].meanDeltaM, oneReport.levels[level].meanDeltaM);
    }
}

ReadChildren readChildrenOf(const Baked& baked, int& reads) {
    return [&](const ChunkData& parent) -> Result<std::array<ChunkData, quadrantCount>> {
        ++reads;
        std::array<ChunkData, quadrantCount> children;
        for (std::size_t q = 0; q < children.size(); ++q) {
            children[q] = baked.chunks.at(childOf(parent.id, static_cast<int>(q)));
        }
        return children;
    };
}

TEST(TightMetric, SearchedForInThePyramidIsTheSameOnEveryLevel) {
    const Baked baked(roughSource(129), {.chunkSize = 17, .radiusM = 60e3});
    int reads = 0;
    for (const auto& [id, chunk] : baked.chunks) {
        if (id.level == deepestLevelOf(baked.shape)) continue;
        const auto searched = searchFinestDistance(baked.shape, chunk, readChildrenOf(baked, reads));
        ASSERT_TRUE(searched);
        ASSERT_NEAR(*searched, bruteForceM(baked, chunk), 1e-6) << toString(id);
    }
}

TEST(TightMetric, SearchLeavesOutWhatCannotHoldTheFarthestSample) {
    const Baked baked(bumpSource(Face::NegY, 41, 73, 20'000), {.chunkSize = 17, .radiusM = 100e3});
    int reads = 0;
    const ChunkData& root = baked.chunks.at({Face::NegY, 0, 0, 0});
    const auto searched = searchFinestDistance(baked.shape, root, readChildrenOf(baked, reads));
    ASSERT_TRUE(searched);
    EXPECT_NEAR(*searched, 20'000, 0.02 * 20'000);
    EXPECT_EQ(reads, deepestLevelOf(baked.shape));  // straight down to it, of 21 blocks
}

TEST(TightMetric, SearchStopsWhenToldToAndHandsErrorsOn) {
    const Baked baked(roughSource(65), {.chunkSize = 17});
    const ChunkData& root = baked.chunks.at({Face::PosX, 0, 0, 0});
    const auto stopped = searchFinestDistance(
        baked.shape, root,
        [](const ChunkData&) -> Result<std::array<ChunkData, quadrantCount>> { return {}; },
        [] { return false; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    const auto broken = searchFinestDistance(
        baked.shape, root, [](const ChunkData&) -> Result<std::array<ChunkData, quadrantCount>> {
            return ioError("disk on fire");
        });
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().message, "disk on fire");
}

TEST(TightMetric, BakeThatIsCancelledInItsSearchLeavesNothing) {
    const tests::TemporaryFolder folder;
    // The last report of samples is the whole; the next one can only come from the search.
    BakeSettings settings{.faceSize = 1025, .chunkSize = 17, .compressionLevel = 0, .tileLevels = 0};
    auto flat = test::formulaSource([](const glm::dvec3&) { return 0.0; }, 0, 1);
    flat.sample = [](const SampleTile&, std::span<float> out) -> Result<void> {
        std::fill(out.begin(), out.end(), 0.0f);
        return {};
    };
    const auto result = bake(flat, settings, folder / "a.chk", [](const BakeProgress& progress) {
        return progress.samplesDone < progress.samplesTotal;
    });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// The file with the tight metric of +x's root changed and its checksum right again.
std::vector<std::byte> withRootTightM(const std::filesystem::path& path, float tightM) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    const BlockLocation root = ChunkFile::open(path)->info().roots[0];
    const std::span block(bytes.data() + root.offset, root.size);
    std::memcpy(block.data() + 5, &tightM, sizeof tightM);
    std::vector<std::byte> sum;
    ByteWriter(sum).put(rootChecksum(block.first(block.size() - checksumBytes), Face::PosX));
    std::copy(sum.begin(), sum.end(), block.end() - checksumBytes);
    return bytes;
}

TEST(TightMetric, HostileValuesInTheFileAreRefused) {
    const Baked baked(roughSource(65), {.chunkSize = 17});
    const ChunkData& root = baked.chunks.at({Face::PosX, 0, 0, 0});
    for (const float bad : {-1.0f, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), std::nextafter(root.deltaCM, 1e30f)}) {
        const auto bytes = withRootTightM(baked.path(), bad);
        const auto read = test::openBytes(bytes)->readRoot(Face::PosX);
        ASSERT_FALSE(read) << bad;
        EXPECT_THAT(read.error().message, HasSubstr("out of range"));
    }
    EXPECT_TRUE(test::openBytes(withRootTightM(baked.path(), root.deltaTightM))->readRoot(Face::PosX));
}

TEST(TightMetric, VerifyFindsOneThatWasHalvedAndNothingElse) {
    const Baked baked(roughSource(129), {.chunkSize = 17, .radiusM = 60e3});
    const float honest = baked.chunks.at({Face::PosX, 0, 0, 0}).deltaTightM;
    EXPECT_EQ(verifyFile(*ChunkFile::open(baked.path()), nullptr)->problemCount, 0u);
    const auto bytes = withRootTightM(baked.path(), honest * 0.999f);
    const auto report = verifyFile(*test::openBytes(bytes), nullptr);
    ASSERT_TRUE(report);
    ASSERT_GE(report->problemCount, 1u);
    for (const std::string& problem : report->problems) {
        EXPECT_THAT(problem, HasSubstr("tight metric"));
        EXPECT_THAT(problem, HasSubstr("x_pos/0/0/0"));
    }
}

}  // namespace
}  // namespace planet
