// The facade over a real baked file.
#include <gtest/gtest.h>

#include <fstream>

#include "planet/bake/bake.h"
#include "planet/planet.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

View overHills() {
    return viewFromPose(
        {.latitudeDeg = 20, .longitudeDeg = 30, .altitudeM = 3e6, .headingDeg = 40, .pitchDeg = -70},
        6'371'000, 1.0, 1280, 720);
}

void ignoreUpload(std::uint32_t, StepsView) {}

void flipByte(const std::filesystem::path& path, std::uint64_t offset) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(offset));
    const int byte = file.get();
    file.seekp(static_cast<std::streamoff>(offset));
    file.put(static_cast<char>(byte ^ 0x40));
}

class PlanetFile : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(bake(test::hillsSource(), BakeSettings{.faceSize = 513, .chunkSize = 17}, path_));
    }
    tests::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "hills.chk";
};

TEST_F(PlanetFile, settlesWithEveryDrawnChunkWithinTheTolerance) {
    const auto planet = Planet::open(path_, PagingSettings{});
    ASSERT_TRUE(planet) << planet.error().message;
    const LodSettings settings = suddenLod(0.5);
    ASSERT_TRUE((*planet)->settle(overHills(), settings, ignoreUpload, 60));
    EXPECT_GT((*planet)->selection().draw.size(), 20u);
    EXPECT_GT((*planet)->selection().counters.deepestLevel, 2u);
    for (const DrawItem& item : (*planet)->selection().draw) EXPECT_LE(item.epsPx, 0.5) << toString(item.id);
    EXPECT_EQ((*planet)->selection().counters.waiting, 0u);
    EXPECT_EQ((*planet)->paging()[BlockKind::Heights].failed, 0u);
    EXPECT_TRUE((*planet)->takeProblems().empty());
}

TEST_F(PlanetFile, everyBlockOfABakeLoadsWhenAllIsWanted) {
    const auto planet = Planet::open(path_, PagingSettings{});
    ASSERT_TRUE(planet);
    LodSettings all = suddenLod(1e-9);
    all.frustumCulling = all.horizonCulling = false;
    ASSERT_TRUE((*planet)->settle(overHills(), all, ignoreUpload, 120));
    EXPECT_EQ((*planet)->selection().draw.size(), 6u << (2 * deepestLevelOf((*planet)->tree().shape)));
    EXPECT_EQ((*planet)->paging()[BlockKind::Heights].failed, 0u);
    // Everything but the header and the roots was read, and nothing twice.
    EXPECT_LT((*planet)->paging()[BlockKind::Heights].bytesRead, std::filesystem::file_size(path_));
    EXPECT_GT((*planet)->paging()[BlockKind::Heights].bytesRead, std::filesystem::file_size(path_) * 9 / 10);
}

TEST_F(PlanetFile, damagedBlockIsReportedAndDrawnAsItsParent) {
    const auto file = ChunkFile::open(path_);
    const auto root = file->readRoot(Face::PosX);
    const auto children = file->readChildren(root->id, root->children, root->heights);
    ASSERT_TRUE(children);
    flipByte(path_, (*children)[3].children.offset + 100);

    const auto planet = Planet::open(path_, PagingSettings{});
    ASSERT_TRUE(planet);
    LodSettings all = suddenLod(1e-9);
    all.frustumCulling = all.horizonCulling = false;
    ASSERT_TRUE((*planet)->settle(overHills(), all, ignoreUpload, 120));
    EXPECT_EQ((*planet)->paging()[BlockKind::Heights].failed, 1u);
    const std::vector<std::string> problems = (*planet)->takeProblems();
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].find("hills.chk"), std::string::npos);
    EXPECT_NE(problems[0].find("x_pos/1/1/1"), std::string::npos);
    std::size_t drawnAsParent = 0;
    for (const DrawItem& item : (*planet)->selection().draw) drawnAsParent += item.id == (*children)[3].id;
    EXPECT_EQ(drawnAsParent, 1u);
    const std::size_t leaves = std::size_t{6} << (2 * deepestLevelOf((*planet)->tree().shape));
    EXPECT_EQ((*planet)->selection().draw.size(), leaves - leaves / 24 + 1);
}

TEST_F(PlanetFile, fileTruncatedWhileOpenGoesOnWithWhatIsResident) {
    const auto planet = Planet::open(path_, PagingSettings{.retry = {.delayS = 0.001}});
    ASSERT_TRUE(planet);
    std::filesystem::resize_file(path_, chunkFileHeaderBytes);
    ASSERT_TRUE((*planet)->settle(overHills(), suddenLod(3), ignoreUpload, 60));
    EXPECT_GT((*planet)->paging()[BlockKind::Heights].failed, 0u);
    for (const DrawItem& item : (*planet)->selection().draw) EXPECT_EQ(item.id.level, 0);
    EXPECT_NE((*planet)->takeProblems().at(0).find("truncated"), std::string::npos);
}

}  // namespace
}  // namespace planet
