#include "planet/bake/job/unit_feed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace planet {
namespace {

std::vector<UnitRange> allOf(UnitShares shares) {
    std::vector<UnitRange> all;
    for (UnitRange share = shares.next(); share.count > 0; share = shares.next()) all.push_back(share);
    return all;
}

TEST(UnitShares, EachUnitIsHandedOutOnce) {
    std::vector<int> handed(1000);
    for (const UnitRange& share : allOf(UnitShares({{0, 300}, {310, 1}, {500, 500}}, 7))) {
        for (std::uint64_t i = 0; i < share.count; ++i) ++handed[share.first + i];
    }
    for (std::size_t unit = 0; unit < handed.size(); ++unit)
        EXPECT_EQ(handed[unit], unit < 300 || unit == 310 || unit >= 500 ? 1 : 0) << unit;
}

TEST(UnitShares, LargeSharesComeFirstAndSingleUnitsLast) {
    const std::vector<UnitRange> shares = allOf(UnitShares({{0, 6400}}, 8));
    EXPECT_EQ(shares.front().count, 200u);
    EXPECT_EQ(shares.back().count, 1u);
    EXPECT_TRUE(std::ranges::is_sorted(shares, std::greater<>(), &UnitRange::count));
    // Therefore one rank cannot have more to do at the end than a small part of what each has done.
    const auto single = std::ranges::count(shares, 1u, &UnitRange::count);
    EXPECT_GT(single, 32);
}

TEST(UnitShares, NothingLeftGivesNothing) {
    EXPECT_EQ(UnitShares({}, 3).next(), UnitRange());
}

TEST(UnitFeed, UnitsComeInTheOrderInWhichTheyWereGiven) {
    UnitFeed feed;
    EXPECT_TRUE(feed.wantsMore());
    feed.give({5, 2});
    EXPECT_FALSE(feed.wantsMore());
    EXPECT_EQ(feed.next(), 5u);
    // The next share is asked for while this one is baked.
    EXPECT_TRUE(feed.wantsMore());
    feed.give({9, 1});
    EXPECT_EQ(feed.next(), 6u);
    EXPECT_EQ(feed.next(), 9u);
    feed.give({});
    EXPECT_FALSE(feed.wantsMore());
    EXPECT_EQ(feed.next(), std::nullopt);
}

TEST(UnitFeed, AStopDropsWhatIsLeft) {
    UnitFeed feed;
    feed.give({5, 100});
    EXPECT_EQ(feed.next(), 5u);
    feed.stop();
    EXPECT_TRUE(feed.hasStopped());
    EXPECT_EQ(feed.next(), std::nullopt);
}

}  // namespace
}  // namespace planet
