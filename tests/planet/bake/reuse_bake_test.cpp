// Bakes that copy from an earlier bake what the source has not changed: each must give the bytes of a whole bake.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "planet/bake/bake.h"
#include "planet/format/chunk_file.h"
#include "planet/source/height_source.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"
#include "tests/support/chunk_blocks.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::gridAround;
using test::writeRaster;
using testing::HasSubstr;
using ::tests::contentOf;
using ::tests::TemporaryFolder;

constexpr const char* base = "[[elevation]]\nfiles = \"earth.tif\"\n";
constexpr const char* alps = "[[elevation]]\nfiles = \"alps.tif\"\nfeather_m = 20000\n";
constexpr const char* island = "[[elevation]]\nfiles = \"island.tif\"\n";

// A folder with a coarse image of a whole planet, from -2000 to 2000 m, and fine rasters of one degree.
class ReuseBake : public testing::TestWithParam<int> {
protected:
    ReuseBake() {
        const auto hills = [](double longitude, double latitude) {
            return std::round(2000 * std::sin(longitude * 0.11) * std::cos(latitude * 0.23));
        };
        writeRaster(folder / "earth.tif", {4326, 360, 180, -179.5, 89.5, 1}, hills);
        writeFine("alps.tif", 10, 45, 900);
        writeFine("island.tif", -100, 20, 700);
        writeFine("high.tif", 60, -30, 3000);
        writeFine("far.tif", 179.5, 0, 500);  // lies on two faces of the cube
    }

    void writeFine(const std::string& name, double longitude, double latitude, double height) {
        writeRaster(folder / name, gridAround(4326, longitude, latitude, 201, 201, 0.01),
                    [=](double x, double y) {
                        return std::round(height * (0.5 + 0.5 * std::sin(40 * x) * std::cos(37 * y)));
                    });
    }

    BakeSettings settings() const { return {.chunkSize = 17, .quantumM = 0.25, .threads = GetParam()}; }

    Result<BakeReport> bakeWorld(const std::string& toml, const std::string& output, const BakeSettings& how,
                                 const ColourSource* colour = nullptr) {
        std::ofstream(folder / "world.toml") << toml;
        Result<HeightSource> source = openHeightSource(folder / "world.toml", {});
        if (!source) return tl::unexpected(source.error());
        source->description = "world.toml";  // without the folder, which differs
        return bake(*source, how, folder / output, {}, colour);
    }

    // Bakes a world of the fixture's own files without reuse, once for all tests: neither the folder nor the threads change
    // a byte of that. Writes the file and returns the report.
    Result<BakeReport> bakeWhole(const std::string& toml, const std::string& output,
                                 const BakeSettings& how) {
        struct Whole {
            BakeReport report;
            std::string content;
        };
        static std::map<std::string, Whole> known;
        const std::string key =
            fmt::format("{}\n{} {} {} {} {}", toml, how.chunkSize, how.faceSize.value_or(0),
                        how.quantumM.value_or(0), how.radiusM, how.compressionLevel);
        auto found = known.find(key);
        if (found == known.end()) {
            const auto report = bakeWorld(toml, output, how);
            if (!report) return report;
            found = known.emplace(key, Whole{*report, contentOf(folder / output)}).first;
        }
        writeBytes(folder / output, found->second.content);
        return found->second.report;
    }

    // Bakes one world, and another one from that bake and as a whole. Expects the same bytes.
    BakeReport baked(const std::string& before, const std::string& after) {
        return baked(before, after, settings(), settings());
    }
    BakeReport baked(const std::string& before, const std::string& after, const BakeSettings& earlier,
                     BakeSettings later) {
        const auto old = bakeWhole(before, "old.chk", earlier);
        const auto whole = bakeWhole(after, "whole.chk", later);
        later.reuse = folder / "old.chk";
        const auto reused = bakeWorld(after, "reused.chk", later);
        EXPECT_TRUE(old && whole && reused);
        EXPECT_EQ(whole->copiedChunks, 0u);
        EXPECT_TRUE(contentOf(folder / "whole.chk") == contentOf(folder / "reused.chk"));
        wholeCells_ = whole->sampledCells;
        return reused.value_or(BakeReport{});
    }

    // Expects that a place was baked, and that most chunks elsewhere were copied.
    void expectMostCopied(const BakeReport& report) const {
        EXPECT_GT(report.sampledCells, 0u);
        EXPECT_LT(report.sampledCells, wholeCells_ / 3);
        EXPECT_GT(report.copiedChunks, report.chunks / 2);
        EXPECT_EQ(report.reuseNotice, "");
    }

    // Bakes a world whose files have changed since old.chk. Expects the bytes of a whole bake, from a few places.
    void expectAPlaceBakedAgain(const std::string& world) {
        BakeSettings later = settings();
        const auto whole = bakeWorld(world, "whole.chk", later);
        later.reuse = folder / "old.chk";
        const auto reused = bakeWorld(world, "reused.chk", later);
        ASSERT_TRUE(whole && reused);
        EXPECT_TRUE(contentOf(folder / "whole.chk") == contentOf(folder / "reused.chk"));
        EXPECT_GT(reused->sampledCells, 0u);
        EXPECT_LT(reused->sampledCells, whole->sampledCells / 3);
    }

    void expectNothingCopied(const BakeReport& report, const std::string& why) const {
        EXPECT_EQ(report.copiedChunks, 0u);
        EXPECT_EQ(report.sampledCells, wholeCells_);
        EXPECT_THAT(report.reuseNotice, HasSubstr(why));
    }

    const TemporaryFolder folder;

private:
    std::uint64_t wholeCells_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Threads, ReuseBake, testing::Values(1, 3));

TEST_P(ReuseBake, copiesAllOfAnUnchangedSource) {
    const BakeReport report = baked(std::string(base) + alps, std::string(base) + alps);
    EXPECT_EQ(report.sampledCells, 0u);
    EXPECT_GT(report.copiedChunks, report.chunks * 9 / 10);
    EXPECT_LT(report.copiedChunks, report.chunks) << "the upper chunks are made from their children";
}

TEST_P(ReuseBake, bakesOnlyWhereALayerIsAdded) {
    expectMostCopied(baked(std::string(base) + alps, std::string(base) + alps + island));
}

TEST_P(ReuseBake, bakesOnlyWhereALayerIsAddedUnderAnother) {
    expectMostCopied(baked(std::string(base) + alps, std::string(base) + island + alps));
}

TEST_P(ReuseBake, bakesOnlyWhereALayerIsRemoved) {
    expectMostCopied(baked(std::string(base) + alps + island, std::string(base) + alps));
}

TEST_P(ReuseBake, bakesOnlyWhereALayerMoves) {
    const auto placed = [&](double latitude) {
        return fmt::format(
            "{}{}[[elevation]]\nfiles = \"image.png\"\nscale = 3\n"
            "place = {{lat = {}, lon = 70, width_m = 200000}}\n",
            base, alps, latitude);
    };
    writeImage<std::uint8_t>(folder / "image.png", Image<std::uint8_t>(129, 129, [](int x, int y) {
                                 return (x * 7 + y * 5) % 256;
                             }));
    expectMostCopied(baked(placed(10), placed(-40)));
}

TEST_P(ReuseBake, bakesOnlyWhereTheSettingsOfALayerChange) {
    for (const char* const change : {"offset_m = 30", "scale = 0.5", "join = \"max\"", "voids = 7"}) {
        SCOPED_TRACE(change);
        const std::string before = std::string(base) + alps + island;
        expectMostCopied(baked(before, before + change + "\n"));
    }
}

TEST_P(ReuseBake, bakesOnlyWhereTheFileOfALayerChanges) {
    const std::string world = std::string(base) + alps + island;
    ASSERT_TRUE(bakeWhole(world, "old.chk", settings()));
    writeFine("island.tif", -100, 20, 650);
    expectAPlaceBakedAgain(world);
}

TEST_P(ReuseBake, bakesOnlyWhereATileOfAMosaicChanges) {
    const auto writeTile = [&](int tile, double height) {
        auto grid = gridAround(4326, 10, 30, 301, 301, 0.01);
        grid.x += tile % 3 * 100 * grid.step;
        grid.y -= tile / 3 * 100 * grid.step;
        grid.width = grid.height = 101;
        std::filesystem::create_directories(folder / "tiles");
        writeRaster(folder / "tiles" / fmt::format("{}.tif", tile), grid, [=](double x, double y) {
            return std::round(height * (0.5 + 0.5 * std::sin(40 * x) * std::cos(37 * y)));
        });
    };
    for (int tile = 0; tile < 9; ++tile) writeTile(tile, 900);
    const std::string mosaic =
        std::string(base) + "[[elevation]]\nfiles = \"tiles/*.tif\"\nfeather_m = 4000\n";
    ASSERT_TRUE(bakeWorld(mosaic, "old.chk", settings()));
    writeTile(0, 850);
    expectAPlaceBakedAgain(mosaic);
    std::filesystem::remove(folder / "tiles" / "0.tif");
    expectAPlaceBakedAgain(mosaic);
}

TEST_P(ReuseBake, bakesOnlyWhereReorderedLayersLie) {
    writeRaster(folder / "mesa.tif", gridAround(4326, 10.4, 45.2, 151, 151, 0.01),
                [](double, double) { return 600; });
    const std::string mesa = "[[elevation]]\nfiles = \"mesa.tif\"\n";
    expectMostCopied(
        baked(std::string(base) + island + alps + mesa, std::string(base) + island + mesa + alps));
    // Layers that lie apart may change places, wherever the second one lies.
    const BakeReport apart = baked(std::string(base) + alps + island, std::string(base) + island + alps);
    EXPECT_EQ(apart.sampledCells, 0u);
}

TEST_P(ReuseBake, bakesBothSidesOfAnEdgeOfTheCube) {
    expectMostCopied(
        baked(std::string(base) + alps, std::string(base) + alps + "[[elevation]]\nfiles = \"far.tif\"\n"));
}

TEST_P(ReuseBake, aNameChangesNothing) {
    const std::string world = std::string(base) + alps;
    EXPECT_EQ(baked(world, world + "name = \"The Alps\"\n").sampledCells, 0u);
}

TEST_P(ReuseBake, bakesHeightsThatTheRangeMayHaveClamped) {
    // The range grows from 2000 m to 3000 m. The filter exceeds 2000 m beside the cliffs, until it is clamped.
    writeRaster(folder / "cliffs.tif", gridAround(4326, -40, 10, 21, 21, 0.1),
                [](double x, double y) { return std::sin(9 * x) * std::sin(8 * y) > 0 ? 2000 : -1000; });
    const std::string before = std::string(base) + alps + "[[elevation]]\nfiles = \"cliffs.tif\"\n";
    const BakeReport report = baked(before, before + "[[elevation]]\nfiles = \"high.tif\"\n");
    EXPECT_GT(report.copiedChunks, 0u);
    EXPECT_GT(report.sampledCells, 0u);
}

TEST_P(ReuseBake, bakesAllUnderDetailWhoseRangeChanges) {
    const std::string detail = "[[elevation]]\ndetail = \"strength=0.8\"\n";
    BakeSettings smaller = settings();
    smaller.faceSize = 1025;
    const BakeReport same =
        baked(std::string(base) + detail, std::string(base) + detail + island, smaller, smaller);
    EXPECT_GT(same.copiedChunks, same.chunks / 2);
    const BakeReport under = baked(std::string(base) + alps + detail,
                                   std::string(base) + alps + island + detail, smaller, smaller);
    EXPECT_GT(under.copiedChunks, under.chunks / 2);
    EXPECT_GT(under.sampledCells, 0u);
    const BakeReport other =
        baked(std::string(base) + detail,
              std::string(base) + "[[elevation]]\nfiles = \"high.tif\"\n" + detail, smaller, smaller);
    EXPECT_EQ(other.copiedChunks, 0u);
}

TEST_P(ReuseBake, bakesAllIfHeightsAreStoredInOtherSteps) {
    BakeSettings natural = settings();
    natural.quantumM.reset();
    // 4000 m in steps of 0.1 m; 12,000 m need steps of 0.2 m.
    expectNothingCopied(baked(base, std::string(base) + "scale = 3\n", natural, natural),
                        "in steps of 0.1 m");
}

TEST_P(ReuseBake, bakesAllIfASettingChanges) {
    const std::string world = std::string(base) + alps;
    const auto changed = [&](const std::function<void(BakeSettings&)>& change) {
        BakeSettings later = settings();
        change(later);
        return baked(world, world, settings(), later);
    };
    expectNothingCopied(changed([](BakeSettings& s) { s.chunkSize = 33; }), "chunk size is 17");
    expectNothingCopied(changed([](BakeSettings& s) { s.radiusM = 3e6; }), "radius is 6371000 m");
    expectNothingCopied(changed([](BakeSettings& s) { s.compressionLevel = 1; }), "other settings");
}

TEST_P(ReuseBake, copiesWhatIsCoarserThanBothFiltersIfTheFaceSizeChanges) {
    writeRaster(folder / "fine.tif", gridAround(4326, 30, 10, 101, 101, 0.003), [](double x, double y) {
        return std::round(500 + 400 * std::sin(90 * x) * std::cos(70 * y));
    });
    const std::string fine = "[[elevation]]\nfiles = \"fine.tif\"\n";
    // In the north, columns stand closer than the samples of the coarser filter.
    writeFine("north.tif", 100, 70, 900);
    const std::string before = std::string(base) + alps + island + "[[elevation]]\nfiles = \"north.tif\"\n";
    const BakeReport finer = baked(before, before + fine);
    expectMostCopied(finer);
    EXPECT_NE(faceCells(finer.shape), faceCells(ChunkFile::open(folder / "old.chk").value().info().shape));
    expectMostCopied(baked(before + fine, before));
    // A grid that leaves out data of the rasters changes them.
    BakeSettings coarse = settings();
    coarse.faceSize = 2049;
    EXPECT_GT(baked(before, before, settings(), coarse).copiedChunks, 0u);
    EXPECT_GT(baked(before, before, coarse, settings()).copiedChunks, 0u);
    coarse.faceSize = 129;
    EXPECT_EQ(baked(before, before, settings(), coarse).copiedChunks, 0u);
}

TEST_P(ReuseBake, measuresUnitsUnderChangedChunksInADensePlanet) {
    BakeSettings dense = settings();
    dense.faceSize = 1025;
    const std::string noise = "[[elevation]]\nterrain = \"noise:fbm,seed=3,octaves=6,amplitude_m=4000\"\n";
    expectMostCopied(baked(noise, noise + island, dense, dense));
    dense.chunkSize = 33;
    expectMostCopied(baked(noise, noise + island, dense, dense));
}

TEST_P(ReuseBake, copiesFromSourcesWithoutLayers) {
    BakeSettings how{.faceSize = 257, .chunkSize = 17, .threads = GetParam()};
    for (const std::filesystem::path& path :
         {std::filesystem::path("noise:fbm,seed=3"), folder / "earth.tif", folder / "alps.tif"}) {
        SCOPED_TRACE(path.string());
        const HeightSource source = openHeightSource(path, {}).value();
        how.reuse.clear();
        ASSERT_TRUE(bake(source, how, folder / "whole.chk"));
        how.reuse = folder / "whole.chk";
        const auto reused = bake(source, how, folder / "reused.chk");
        ASSERT_TRUE(reused);
        EXPECT_EQ(reused->sampledCells, 0u);
        EXPECT_TRUE(contentOf(folder / "whole.chk") == contentOf(folder / "reused.chk"));
    }
}

TEST_P(ReuseBake, replacesTheFileThatItCopiesFrom) {
    ASSERT_TRUE(bakeWhole(std::string(base) + alps + island, "whole.chk", settings()));
    ASSERT_TRUE(bakeWhole(std::string(base) + alps, "same.chk", settings()));
    BakeSettings later = settings();
    later.reuse = folder / "same.chk";
    const auto reused = bakeWorld(std::string(base) + alps + island, "same.chk", later);
    ASSERT_TRUE(reused);
    EXPECT_GT(reused->copiedChunks, 0u);
    EXPECT_TRUE(contentOf(folder / "whole.chk") == contentOf(folder / "same.chk"));
}

TEST_P(ReuseBake, aCancelledBakeLeavesTheFileThatItCopiesFrom) {
    ASSERT_TRUE(bakeWhole(std::string(base) + alps, "same.chk", settings()));
    const auto before = contentOf(folder / "same.chk");
    std::ofstream(folder / "world.toml") << base << alps << island;
    BakeSettings later = settings();
    later.reuse = folder / "same.chk";
    const HeightSource source = openHeightSource(folder / "world.toml", {}).value();
    const auto cancelledBake =
        bake(source, later, folder / "same.chk", [](const BakeProgress&) { return false; });
    ASSERT_FALSE(cancelledBake);
    EXPECT_EQ(cancelledBake.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(before == contentOf(folder / "same.chk"));
}

TEST_P(ReuseBake, bakesWhereTheEarlierFileIsDamaged) {
    const std::string world = std::string(base) + alps;
    ASSERT_TRUE(bakeWhole(world, "whole.chk", settings()));
    const auto good = contentOf(folder / "whole.chk");
    const ChunkFileInfo info = ChunkFile::open(folder / "whole.chk").value().info();
    std::vector<test::FileBlock> blocks;
    test::forEachBlock(std::as_bytes(std::span(good)), info, 1u << 20,
                       [&](const test::FileBlock& block) { blocks.push_back(block); });
    BakeSettings later = settings();
    later.reuse = folder / "old.chk";
    for (std::size_t i = 0; i < blocks.size(); i += 1 + blocks.size() / 40) {
        SCOPED_TRACE(toString(blocks[i].id));
        auto damaged = good;
        damaged[blocks[i].at.offset + blocks[i].at.size / 2] ^= 0x20;
        writeBytes(folder / "old.chk", damaged);
        const auto reused = bakeWorld(world, "reused.chk", later);
        ASSERT_TRUE(reused);
        EXPECT_TRUE(reused->reuseIsDamaged);
        EXPECT_THAT(reused->reuseNotice, HasSubstr("old.chk: "));
        EXPECT_GT(reused->sampledCells, 0u);
        EXPECT_TRUE(good == contentOf(folder / "reused.chk"));
    }
}

TEST_P(ReuseBake, bakesAllWithoutAUsableRecord) {
    const std::string world = std::string(base) + alps;
    ASSERT_TRUE(bakeWhole(world, "whole.chk", settings()));
    const auto good = contentOf(folder / "whole.chk");
    BakeSettings later = settings();
    later.reuse = folder / "old.chk";
    const auto noticeFor = [&](const std::string& bytes) {
        writeBytes(folder / "old.chk", bytes);
        const auto reused = bakeWorld(world, "reused.chk", later);
        EXPECT_TRUE(reused);
        EXPECT_EQ(reused->copiedChunks, 0u);
        EXPECT_TRUE(good == contentOf(folder / "reused.chk"));
        return reused->reuseNotice;
    };
    std::string damaged = good;
    damaged[good.size() - 20] ^= 1;
    EXPECT_THAT(noticeFor(damaged), HasSubstr("old.chk: its record of its source is damaged"));
    EXPECT_THAT(noticeFor("no chunk file"), HasSubstr("old.chk"));
    std::string without = good;
    without[51] = 0;
    test::reseal(std::as_writable_bytes(std::span(without)));
    EXPECT_THAT(noticeFor(without), HasSubstr("does not say what it was baked from"));
}

TEST_P(ReuseBake, copiesColoursOfTheSameImage) {
    const auto writeColours = [&](int shift) {
        writeImage<std::uint8_t>(folder / "colour.png", Image<std::uint8_t>(512, 256, [=](int x, int y) {
                                     return (x + 3 * y + shift) % 256;
                                 }));
    };
    BakeSettings how = settings();
    how.colour.faceSize = 513;
    const auto bakeColours = [&](const std::string& output, bool reuse) {
        const ColourSource colour = openColourSource(folder / "colour.png").value();
        BakeSettings now = how;
        if (reuse) now.reuse = folder / "old.chk";
        return bakeWorld(std::string(base) + (reuse ? alps : ""), output, now, &colour).value();
    };
    writeColours(0);
    bakeColours("old.chk", false);
    const BakeReport same = bakeColours("reused.chk", true);
    EXPECT_EQ(same.copiedColourTiles, 30u);
    const ColourSource colour = openColourSource(folder / "colour.png").value();
    ASSERT_TRUE(bakeWorld(std::string(base) + alps, "whole.chk", how, &colour));
    EXPECT_TRUE(contentOf(folder / "whole.chk") == contentOf(folder / "reused.chk"));
    writeColours(1);
    EXPECT_EQ(bakeColours("reused.chk", true).copiedColourTiles, 0u);
}

}  // namespace
}  // namespace planet
