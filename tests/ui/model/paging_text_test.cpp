#include "ui/model/paging_text.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "ui/panels/paging/failed_blocks.h"

namespace worldy::ui {
namespace {

TEST(PagingText, aRequestSaysByWhatItIsOverTheTolerance) {
    EXPECT_EQ(pageInReason(3.1, 2, 0.1, "eps", "tau"), "eps 3.10 > tau 2.00");
}

TEST(PagingText, aSplitKeptByHysteresisSaysSo) {
    EXPECT_EQ(pageInReason(1.9, 2, 0.1, "eps", "tau"), "eps 1.90 > 1.80: was split (tau 2.00)");
}

TEST(PagingText, aRequestThatIsNoLongerNeededSaysSo) {
    EXPECT_EQ(pageInReason(1.5, 2, 0.1, "eps", "tau"), "eps 1.50: no longer > tau 2.00");
    EXPECT_EQ(pageInReason(2, 2, 0, "eps", "tau"), "eps 2.00: no longer > tau 2.00");
}

TEST(PagingText, aTileOfColourSaysWhatShareOfItsTexelsItHas) {
    EXPECT_EQ(colourReason(2), "50 % of texels");
    EXPECT_STREQ(kindText(planet::BlockKind::Heights), "heights");
    EXPECT_STREQ(kindText(planet::BlockKind::Colours), "colours");
}

TEST(PagingText, residentBlocksAreWhatWasLoadedAndNotEvicted) {
    planet::BlockCounters tiles;
    tiles.loaded = 35;
    tiles.evicted = 30;
    tiles.resident = 26;
    const KindTotals colours = totalsOf("Colours", tiles);
    EXPECT_EQ(colours.resident, 5u);
    EXPECT_EQ(colours.tiles, 26u);
}

TEST(PagingText, aFailedBlockSaysWhenItIsTriedAgain) {
    EXPECT_EQ(retryText(std::nullopt), "never");
    EXPECT_EQ(retryText(1.25), "in 1.25 s");
    EXPECT_EQ(retryText(0), "when needed");
    EXPECT_STREQ(kindText(planet::BlockKind::Normals), "normals");
}

TEST(PagingText, permanentFailuresComeFirstThenTheSoonestRetry) {
    const auto block = [](std::uint32_t x, std::optional<double> retryInS) {
        return planet::FailedBlock{planet::ChunkId{planet::Face::PosX, 3, x, 0}, 1, "bad", retryInS};
    };
    std::vector<planet::FailedBlock> blocks = {block(1, 2), block(2, 0), block(4, std::nullopt),
                                               block(5, 0.5), block(3, std::nullopt)};
    sortFailed(blocks);
    std::vector<std::uint32_t> order;
    for (const planet::FailedBlock& failed : blocks) order.push_back(failed.block.parent.x);
    EXPECT_EQ(order, (std::vector<std::uint32_t>{3, 4, 2, 5, 1}));
}

TEST(PagingText, aPageOutSaysHowLongItIsUnused) {
    EXPECT_EQ(pageOutReason(12.3), "unused for 12.3 s");
    EXPECT_EQ(pageOutReason(0.05), "unused for 50 ms");
}

TEST(PagingText, latenciesKeepThreeDigits) {
    EXPECT_EQ(latencyText(0), "0 ms");
    EXPECT_EQ(latencyText(3.634e-6), "3.63 µs");
    EXPECT_EQ(latencyText(0.0001), "0.1 ms");
    EXPECT_EQ(latencyText(0.00042), "0.42 ms");
    EXPECT_EQ(latencyText(0.9), "900 ms");
    EXPECT_EQ(latencyText(0.996), "0.996 s");
    EXPECT_EQ(latencyText(100), "100 s");
    EXPECT_EQ(latencyText(250), "4 min 10 s");
}

TEST(PagingText, aGoodDiskHasNothingToSay) {
    planet::BadDiskSettings disk;
    disk.seed = 7;
    EXPECT_FALSE(isBad(disk));
    EXPECT_EQ(badDiskText(disk), "");
}

TEST(PagingText, everyTroubleOfABadDiskIsNamed) {
    planet::BadDiskSettings disk;
    disk.latencyMs = 200;
    EXPECT_TRUE(isBad(disk));
    EXPECT_EQ(badDiskText(disk), "+200 ms per read");
    disk.bandwidthMBs = 5;
    disk.failureRate = 0.1;
    disk.shuffledOrder = true;
    EXPECT_EQ(badDiskText(disk), "+200 ms per read, 5 MB/s, 10 % of reads fail, shuffled order");
}

TEST(PagingText, eachTroubleAloneMakesADiskBad) {
    EXPECT_TRUE(isBad({.bandwidthMBs = 1}));
    EXPECT_TRUE(isBad({.failureRate = 0.01}));
    EXPECT_TRUE(isBad({.shuffledOrder = true}));
}

}  // namespace
}  // namespace worldy::ui
