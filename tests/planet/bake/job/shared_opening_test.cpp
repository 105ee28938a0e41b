// Ranks, which are threads here, that share the reading of a source.
#include "planet/bake/job/shared_opening.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "planet/raster/height_raster.h"
#include "planet/raster/raster_area.h"
#include "tests/support/thread_ranks.h"

namespace planet {
namespace {

using test::onRanks;
using testing::ElementsAreArray;

constexpr int blockSide = 64;
constexpr int blocksAlong = 7;  // so that no number of ranks here divides the number of blocks

std::int16_t heightAt(int x, int y) {
    if (x == 300 && y == 17) return 8000;   // in the first row of blocks
    if (x == 5 && y == 440) return -32768;  // missing, in the last
    return static_cast<std::int16_t>((x * 31 + y * 17) % 1000);
}

// A raster of the planet that counts how many of its blocks are read.
HeightRaster countedRaster(std::atomic<int>& reads, int badBlock = -1) {
    HeightConversion conversion;
    conversion.type = SampleType::Int16;
    conversion.noDataValue = -32768;
    conversion.fillM = -77;
    HeightRaster::Blocks blocks;
    blocks.width = blocks.height = blockSide;
    blocks.cache = std::make_shared<StoredBlockCache>(1 << 16);
    blocks.read = [&reads, badBlock](int blockX, int blockY, std::span<std::byte> native) -> Result<void> {
        ++reads;
        if (blockY * blocksAlong + blockX == badBlock) return ioError("made.tif: block is torn");
        for (int i = 0; i < blockSide * blockSide; ++i) {
            const std::int16_t height =
                heightAt(blockX * blockSide + i % blockSide, blockY * blockSide + i / blockSide);
            std::memcpy(native.data() + static_cast<std::size_t>(i) * sizeof(height), &height,
                        sizeof(height));
        }
        return {};
    };
    return HeightRaster::inBlocks(blocksAlong * blockSide, blocksAlong * blockSide, conversion, blocks);
}

// A raster on a part of the planet, whose eastern half has no heights, but for one.
class CountedArea final : public Raster {
public:
    explicit CountedArea(int badBlock = -1) : badBlock_(badBlock) {
        path_ = "counted.tif";
        layout_.width = layout_.height = blocksAlong * blockSide;
        layout_.blockWidth = layout_.blockHeight = blockSide;
        layout_.crs = "EPSG:4326";
        layout_.x = {10, 0.001, 0};
        layout_.y = {45, 0, -0.001};
    }

    Result<std::vector<float>> readBlock(int blockX, int blockY) const override {
        ++reads_;
        if (blockY * blocksAlong + blockX == badBlock_) return ioError("counted.tif: block is torn");
        std::vector<float> heights;
        for (int i = 0; i < blockSide * blockSide; ++i) {
            const int x = blockX * blockSide + i % blockSide;
            const int y = blockY * blockSide + i / blockSide;
            const bool isVoid = x > layout_.width / 2 && (x != 400 || y != 200);
            heights.push_back(isVoid ? std::numeric_limits<float>::quiet_NaN() : heightAt(x, y));
        }
        return heights;
    }
    int reads() const { return reads_; }

private:
    mutable std::atomic<int> reads_ = 0;
    int badBlock_;
};

RasterMosaic mosaicOf(const std::shared_ptr<const Raster>& raster) {
    auto mosaics = RasterMosaic::join({raster}, std::make_shared<MosaicCache>(1 << 20));
    return std::move((*mosaics)[0]);
}

TEST(SharedOpening, RanksReadEachBlockOnceAndKnowTheRangeOfAll) {
    std::atomic<int> readAlone = 0;
    const auto alone = countedRaster(readAlone).statistics();
    ASSERT_TRUE(alone);
    EXPECT_EQ(readAlone, blocksAlong * blocksAlong);
    EXPECT_EQ(alone->maxM, 8000);
    EXPECT_EQ(alone->minM, -77);
    EXPECT_EQ(alone->missingCount, 1U);
    for (const int count : {1, 2, 3, 5}) {
        std::vector<std::atomic<int>> reads(static_cast<std::size_t>(count));
        const auto found = onRanks(count, [&](Ranks& own) {
            Team team(own);
            SharedOpening opening(team, "the program");
            const auto share = opening.share();
            const auto statistics =
                countedRaster(reads[static_cast<std::size_t>(own.rank())]).statistics({}, share.get());
            EXPECT_EQ(opening.finish().size(), static_cast<std::size_t>(count));
            return statistics;
        });
        int sum = 0;
        for (const auto& ofRank : reads) {
            EXPECT_LE(ofRank, blocksAlong * blocksAlong / count + 1);
            sum += ofRank;
        }
        EXPECT_EQ(sum, blocksAlong * blocksAlong) << count << " ranks";
        for (const auto& statistics : found) {
            ASSERT_TRUE(*statistics);
            EXPECT_EQ((*statistics)->minM, alone->minM);
            EXPECT_EQ((*statistics)->maxM, alone->maxM);
            EXPECT_EQ((*statistics)->missingCount, alone->missingCount);
        }
    }
}

TEST(SharedOpening, RanksSurveyAnAreaAsOneAlone) {
    const AreaSurvey alone = surveyArea(mosaicOf(std::make_shared<CountedArea>()));
    ASSERT_FALSE(alone.area.covered.indices.empty());
    for (const int count : {2, 3}) {
        const auto shared = std::make_shared<CountedArea>();
        const auto found = onRanks(count, [&](Ranks& own) {
            Team team(own);
            SharedOpening opening(team, "the program");
            AreaSurvey survey = surveyArea(mosaicOf(shared), {}, opening.share().get());
            opening.finish();
            return survey.area;
        });
        EXPECT_EQ(shared->reads(), blocksAlong * blocksAlong);
        for (const auto& area : found) {
            EXPECT_EQ(area->statistics.minM, alone.area.statistics.minM);
            EXPECT_EQ(area->statistics.maxM, alone.area.statistics.maxM);
            EXPECT_EQ(area->statistics.missingCount, alone.area.statistics.missingCount);
            EXPECT_EQ(area->sampleCount, alone.area.sampleCount);
            EXPECT_THAT(area->covered.indices, ElementsAreArray(alone.area.covered.indices));
        }
    }
}

TEST(SharedOpening, ABlockThatOneRankCannotReadIsAnErrorOfAll) {
    std::atomic<int> reads = 0;
    const auto found = onRanks(3, [&](Ranks& own) {
        Team team(own);
        SharedOpening opening(team, "the program");
        const auto share = opening.share();
        std::set<std::string> messages;
        const auto statistics = countedRaster(reads, 10).statistics({}, share.get());
        if (!statistics) messages.insert(statistics.error().message);
        const AreaSurvey survey = surveyArea(mosaicOf(std::make_shared<CountedArea>(10)), {}, share.get());
        for (const auto& broken : survey.broken) messages.insert(broken.error.message);
        opening.finish();
        return messages;
    });
    for (const auto& messages : found)
        EXPECT_THAT(*messages, ElementsAreArray({"counted.tif: block is torn", "made.tif: block is torn"}));
}

TEST(SharedOpening, ARankThatEndsEarlyKeepsNoOtherWaiting) {
    std::atomic<int> reads = 0;
    const auto found = onRanks(3, [&](Ranks& own) {
        Team team(own);
        SharedOpening opening(team, "the program");
        const auto share = opening.share();
        Result<HeightStatistics> statistics = ioError("no such file");
        if (own.rank() != 1) {
            for (int file = 0; file < 2; ++file)
                statistics = countedRaster(reads).statistics({}, share.get());
        }
        opening.finish();
        return statistics;
    });
    EXPECT_FALSE(*found[1]);
    for (const std::size_t rank : {0U, 2U}) {
        ASSERT_TRUE(*found[rank]);
        EXPECT_EQ((*found[rank])->maxM, 8000);
        EXPECT_EQ((*found[rank])->missingCount, 1U);
    }
}

TEST(SharedOpening, RanksOfDifferentProgramsOrSourcesReadAlone) {
    const auto found = onRanks(2, [&](Ranks& own) {
        std::atomic<int> reads = 0;
        Team team(own);
        SharedOpening opening(team, own.rank() == 0 ? "one program" : "another");
        const auto share = opening.share();
        const auto statistics = countedRaster(reads).statistics({}, share.get());
        opening.finish();
        EXPECT_TRUE(statistics && statistics->maxM == 8000);
        return reads.load();
    });
    const auto ofSources = onRanks(2, [&](Ranks& own) {
        std::atomic<int> reads = 0;
        Team team(own);
        SharedOpening opening(team, "the program");
        const auto share = opening.share();
        bool isRight = false;
        if (own.rank() == 0) {
            isRight = countedRaster(reads).statistics({}, share.get())->missingCount == 1;
        } else {
            const AreaSurvey survey = surveyArea(mosaicOf(std::make_shared<CountedArea>()), {}, share.get());
            isRight = survey.area.sampleCount == blocksAlong * blocksAlong * blockSide * blockSide;
        }
        opening.finish();
        return isRight;
    });
    for (const auto& reads : found) EXPECT_GT(*reads, blocksAlong * blocksAlong);
    for (const auto& isRight : ofSources) EXPECT_TRUE(*isRight);
}

}  // namespace
}  // namespace planet
