#include "planet/bake/colour_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>

#include "planet/bake/bake.h"
#include "planet/bake/colour_estimate.h"
#include "planet/bake/colour_report.h"
#include "planet/bake/colour_tile_sampling.h"
#include "planet/bake/file_report.h"
#include "planet/base/little_endian.h"
#include "planet/format/chunk_file_format.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using ::tests::contentOf;
using ::tests::TemporaryFolder;

Result<BakeReport> bakeWithColours(const std::filesystem::path& path, BakeSettings settings = {},
                                   const BakeProgressCallback& progress = {}) {
    settings.chunkSize = 17;
    settings.faceSize = 33;
    const ColourSource colours = test::mottledColours();
    return bake(test::hillsSource(), settings, path, progress, &colours);
}

void visitTiles(const ChunkFile& file, const TileData& tile,
                const std::function<void(const TileData&)>& visit) {
    visit(tile);
    if (!tile.children.exists()) return;
    const auto children = file.readColourChildren(tile.id, tile.children);
    ASSERT_TRUE(children) << children.error().message;
    for (const TileData& child : *children) visitTiles(file, child, visit);
}

TEST(ColourBake, EveryTileOfEveryLevelIsTheSourcesOwn) {
    const TemporaryFolder folder;
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        const auto report = bakeWithColours(folder / "a.chk", {.colour = {.format = format}});
        ASSERT_TRUE(report) << report.error().message;
        const auto file = ChunkFile::open(folder / "a.chk");
        ASSERT_TRUE(file) << file.error().message;
        const auto& colour = file->info().colour;
        ASSERT_TRUE(colour);
        EXPECT_EQ(colour->leafLevel, 1);
        EXPECT_EQ(colour->source, "formula");
        std::uint64_t tiles = 0;
        for (const Face face : allFaces) {
            const auto root = file->readColourRoot(face);
            ASSERT_TRUE(root) << root.error().message;
            visitTiles(*file, *root, [&](const TileData& tile) {
                ++tiles;
                std::vector<std::uint8_t> rgb(colourTileBytes(ColourFormat::Lossless));
                ASSERT_TRUE(sampleColourTile(test::mottledColours(), tile.id, rgb));
                EXPECT_EQ(tile.texels, colourTexels(format, rgb)) << toString(tile.id);
            });
        }
        EXPECT_EQ(tiles, 30u);
        EXPECT_EQ(report->colourTiles, 30u);
        EXPECT_GT(report->colourBytes, 0u);
        EXPECT_LT(report->colourBytes, report->fileBytes);
    }
}

TEST(ColourBake, TilesAreAsDeepAsTheColoursAreFine) {
    const TemporaryFolder folder;
    ColourSource colours = test::mottledColours(2049);
    const ChunkId fine{Face::PosY, 3, 5, 2};
    colours.finestCells = [&](const ChunkId& square) {
        const bool meets =
            square.level <= 3 ? ancestorOf(fine, square.level) == square : ancestorOf(square, 3) == fine;
        return meets ? 2048 : 256;
    };
    BakeSettings settings;
    settings.chunkSize = 17;
    settings.faceSize = 33;
    for (const int threads : {1, 3}) {
        settings.threads = threads;
        const auto path = folder / (threads == 1 ? "one.chk" : "three.chk");
        const auto report = bake(test::hillsSource(), settings, path, {}, &colours);
        ASSERT_TRUE(report) << report.error().message;
        // Six roots, and four tiles on each of the levels 1 to 3.
        EXPECT_EQ(report->colourTiles, 6u + 3 * 4);
        const ChunkFile file = ChunkFile::open(path).value();
        EXPECT_EQ(file.info().colour->leafLevel, 3);
        const auto levels = reportColours(file).value();
        ASSERT_EQ(levels.size(), 4u);
        for (std::size_t level = 1; level < 4; ++level) EXPECT_EQ(levels[level].tiles, 4u);
        const ColourVerifyReport verified = verifyColours(file, &colours, {}).value();
        EXPECT_EQ(verified.problemCount, 0u) << verified.problems[0];
        EXPECT_EQ(verified.compared, 18u);
        const auto estimate = estimateColours(colours, settings.colour, 1).value();
        EXPECT_EQ(estimate.tiles, 18u);
    }
    EXPECT_EQ(contentOf(folder / "one.chk"), contentOf(folder / "three.chk"));
}

TEST(ColourBake, ManyThreadsGiveTheSameBytesAsOne) {
    const TemporaryFolder folder;
    ASSERT_TRUE(bakeWithColours(folder / "one.chk", {.threads = 1}));
    ASSERT_TRUE(bakeWithColours(folder / "many.chk", {.threads = 7}));
    EXPECT_EQ(contentOf(folder / "one.chk"), contentOf(folder / "many.chk"));
}

TEST(ColourBake, HeightsAreTheSameWithColoursAsWithout) {
    const TemporaryFolder folder;
    ASSERT_TRUE(bakeWithColours(folder / "with.chk"));
    ASSERT_TRUE(
        bake(test::hillsSource(), BakeSettings{.faceSize = 33, .chunkSize = 17}, folder / "without.chk"));
    const auto with = ChunkFile::open(folder / "with.chk");
    const auto without = ChunkFile::open(folder / "without.chk");
    ASSERT_TRUE(with && without);
    EXPECT_FALSE(without->info().colour);
    EXPECT_EQ(with->info().roots, without->info().roots);
    const std::string bytes = contentOf(folder / "without.chk");
    EXPECT_EQ(contentOf(folder / "with.chk").substr(512, bytes.size() - 512), bytes.substr(512));
}

TEST(ColourBake, CancelledAmongColoursItLeavesNothing) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    const auto report = bakeWithColours(path, {}, [](const BakeProgress& progress) {
        return progress.samplesDone < 6 * 32 * 32 + 5 * 256 * 256;
    });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ColourBake, ADamagedTileIsAnErrorThatNamesIt) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bakeWithColours(path));
    const std::string whole = contentOf(path);
    const auto info = ChunkFile::open(path)->info();
    const BlockLocation root = info.colour->roots[2];
    for (const std::uint64_t at : {std::uint64_t{0}, std::uint64_t{9}, std::uint64_t{700}}) {
        std::string bytes = whole;
        bytes[root.offset + at] = static_cast<char>(bytes[root.offset + at] ^ 0x10);
        std::ofstream(path, std::ios::binary) << bytes;
        const auto file = ChunkFile::open(path);
        ASSERT_TRUE(file);
        const auto tile = file->readColourRoot(Face::PosY);
        ASSERT_FALSE(tile);
        EXPECT_NE(tile.error().message.find("the block of colour tile y_pos/0/0/0 is damaged"),
                  std::string::npos)
            << tile.error().message;
        EXPECT_TRUE(file->readColourRoot(Face::PosX));
    }
}

// The file with its header's colours changed, under a right checksum.
void changeHeader(const std::filesystem::path& path, const std::string& whole,
                  const std::function<void(ChunkFileInfo&)>& change) {
    std::ofstream(path, std::ios::binary) << whole;
    ChunkFileInfo info = ChunkFile::open(path)->info();
    change(info);
    std::string bytes = whole;
    const auto header = headerBytes(info, bytes.size());
    std::memcpy(bytes.data(), header.data(), header.size());
    std::ofstream(path, std::ios::binary) << bytes;
}

TEST(ColourBake, AHeaderWithColoursThatCannotBeSaysWhatIsWrong) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bakeWithColours(path));
    const std::string whole = contentOf(path);
    struct Case {
        std::function<void(ChunkFileInfo&)> change;
        const char* said;
    };
    const std::uint64_t size = whole.size();
    const std::vector<Case> cases = {
        {[](ChunkFileInfo& info) { info.colour->leafLevel = maxColourLevel + 1; }, "12 colour levels"},
        {[](ChunkFileInfo& info) { info.colour->format = static_cast<ColourFormat>(5); },
         "unknown colour format 6"},
        {[](ChunkFileInfo& info) { info.colour->roots[2].offset = 0; }, "colour tile y_pos/0/0/0"},
        {[](ChunkFileInfo& info) { info.colour->roots[2].offset = 511; }, "colour tile y_pos/0/0/0"},
        {[](ChunkFileInfo& info) { info.colour->roots[3].size = 0; }, "colour tile y_neg/0/0/0: 0 bytes"},
        {[](ChunkFileInfo& info) { info.colour->roots[3].size = 0xFFFFFFFF; }, "; the file has "},
        {[&](ChunkFileInfo& info) { info.colour->roots[0].offset = size; }, "; the file has "},
        {[](ChunkFileInfo& info) { info.colour->roots[0].offset = ~std::uint64_t{0} - 4; },
         "; the file has "},
        {[](ChunkFileInfo& info) { info.colour->roots[5] = info.colour->roots[4]; },
         "colour tile z_pos/0/0/0 and colour tile z_neg/0/0/0 overlap"},
        {[](ChunkFileInfo& info) { ++info.colour->roots[0].size; },
         "colour tile x_pos/0/0/0 and colour tile x_neg/0/0/0 overlap"},
        {[](ChunkFileInfo& info) { info.colour->roots[1] = info.roots[0]; },
         "colour tile x_neg/0/0/0 and chunk x_pos/0/0/0 overlap"},
    };
    for (const Case& one : cases) {
        changeHeader(path, whole, one.change);
        const auto file = ChunkFile::open(path);
        ASSERT_FALSE(file) << one.said;
        EXPECT_EQ(file.error().kind, ErrorKind::BadInput);
        EXPECT_NE(file.error().message.find(path.string()), std::string::npos);
        EXPECT_NE(file.error().message.find(one.said), std::string::npos) << file.error().message;
    }
    changeHeader(path, whole, [](ChunkFileInfo&) {});
    EXPECT_TRUE(ChunkFile::open(path));
}

TEST(ColourBake, ATileWhoseChildrenLieWhereTheyCannotIsRefused) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bakeWithColours(path));
    const std::string whole = contentOf(path);
    const BlockLocation root = ChunkFile::open(path)->info().colour->roots[0];
    // A root's block begins with how far back its children's block lies, and how large that is.
    for (const std::uint64_t distance : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{40}, root.offset,
                                         root.offset + 1, ~std::uint64_t{0}}) {
        std::string bytes = whole;
        for (std::size_t i = 0; i < 8; ++i)
            bytes[root.offset + i] = static_cast<char>(distance >> (8 * i) & 0xFF);
        std::vector<std::byte> block(root.size);
        std::memcpy(block.data(), bytes.data() + root.offset, root.size);
        std::vector<std::byte> sum;
        ByteWriter(sum).put(
            colourRootChecksum(std::span(block).first(block.size() - checksumBytes), Face::PosX));
        std::memcpy(bytes.data() + root.offset + root.size - checksumBytes, sum.data(), sum.size());
        std::ofstream(path, std::ios::binary) << bytes;
        const auto file = ChunkFile::open(path);
        ASSERT_TRUE(file);
        const auto tile = file->readColourRoot(Face::PosX);
        const auto children = tile
                                  ? file->readColourChildren(tile->id, tile->children).map([](const auto&) {})
                                  : Result<void>(tl::unexpected(tile.error()));
        ASSERT_FALSE(children) << distance;
        EXPECT_NE(children.error().message.find("colour tile x_pos/0/0/0"), std::string::npos)
            << children.error().message;
    }
}

TEST(ColourBake, ABlockOfHeightsIsNoneOfColours) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bakeWithColours(path));
    const auto file = ChunkFile::open(path);
    const auto root = file->readRoot(Face::PosX);
    ASSERT_TRUE(root);
    EXPECT_FALSE(file->readColourChildren(root->id, root->children));
    const auto tile = file->readColourRoot(Face::PosX);
    EXPECT_FALSE(file->readChildren(root->id, tile->children, root->heights));
}

TEST(ColourReport, TellsEachLevelsTilesAndBytes) {
    const TemporaryFolder folder;
    const auto report = bakeWithColours(folder / "a.chk");
    ASSERT_TRUE(report);
    const auto file = ChunkFile::open(folder / "a.chk");
    ASSERT_TRUE(file);
    const auto levels = reportColours(*file);
    ASSERT_TRUE(levels) << levels.error().message;
    ASSERT_EQ(levels->size(), 2u);
    EXPECT_EQ((*levels)[0].tiles, 6u);
    EXPECT_EQ((*levels)[1].tiles, 24u);
    EXPECT_EQ((*levels)[0].bytes + (*levels)[1].bytes, report->colourBytes);
    const auto heights = reportFile(*file);
    ASSERT_TRUE(heights);
    const double heightBytes = static_cast<double>(report->fileBytes - report->colourBytes);
    EXPECT_NEAR(heights->bitsPerFinestSample, 8 * heightBytes / static_cast<double>(report->samples), 1e-9);
}

TEST(ColourReport, AWholeFileHasNoProblemsAndAnotherImageHas) {
    const TemporaryFolder folder;
    ASSERT_TRUE(bakeWithColours(folder / "a.chk"));
    const auto file = ChunkFile::open(folder / "a.chk");
    const ColourSource same = test::mottledColours();
    const auto verified = verifyColours(*file, &same);
    ASSERT_TRUE(verified) << verified.error().message;
    EXPECT_EQ(verified->tiles, 30u);
    EXPECT_EQ(verified->edges, 24u);  // four within each face's four finest tiles
    EXPECT_EQ(verified->compared, 30u);
    EXPECT_EQ(verified->problemCount, 0u);
    const ColourSource other = test::formulaColours([](const glm::dvec3&) { return glm::dvec3(0.5); });
    const auto compared = verifyColours(*file, &other);
    ASSERT_TRUE(compared);
    EXPECT_EQ(compared->problemCount, 30u);
    const auto cancelled = verifyColours(*file, nullptr, [] { return false; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(ColourReport, ADamagedBlockIsAProblemThatNamesItAndTheRestIsChecked) {
    const TemporaryFolder folder;
    const auto path = folder / "a.chk";
    ASSERT_TRUE(bakeWithColours(path));
    std::string bytes = contentOf(path);
    const auto root = ChunkFile::open(path)->readColourRoot(Face::NegX);
    ASSERT_TRUE(root);
    bytes[root->children.offset + 400] = static_cast<char>(bytes[root->children.offset + 400] ^ 1);
    std::ofstream(path, std::ios::binary) << bytes;
    const auto verified = verifyColours(*ChunkFile::open(path), nullptr);
    ASSERT_TRUE(verified);
    EXPECT_EQ(verified->tiles, 26u);
    ASSERT_EQ(verified->problemCount, 1u);
    EXPECT_NE(verified->problems[0].find("x_neg/0/0/0 is damaged"), std::string::npos);
}

TEST(ColourBake, SizesThatCannotBeAreRefused) {
    const ColourSource source = test::mottledColours(1025);
    EXPECT_EQ(colourLeafLevel(source, {}).value(), 2);
    EXPECT_EQ(colourLeafLevel(test::mottledColours(33), {}).value(), 0);
    EXPECT_EQ(colourLeafLevel(source, {.faceSize = 257}).value(), 0);
    for (const int size : {0, -1, 129, 256, 1000, (1 << 19) + 1}) {
        const auto level = colourLeafLevel(source, {.faceSize = size});
        ASSERT_FALSE(level) << size;
        EXPECT_NE(level.error().message.find("expected 2^n + 1 in [257, "), std::string::npos);
    }
}

}  // namespace
}  // namespace planet
