#include "planet/sphere/steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace planet {
namespace {

using Wide = std::vector<std::int32_t>;

Steps stepsOf(const Wide& steps) {
    return Steps(std::span<const std::int32_t>(steps));
}

TEST(Steps, takeTwoBytesWhereTheyFitAndAreAlwaysTheSame) {
    struct Case {
        Wide steps;
        std::size_t bytesEach;
    };
    for (const Case& c :
         {Case{{-32768, 0, 32767}, 2}, Case{{32768, 98303}, 2}, Case{{0, 65536, 8'388'608 - 64}, 4},
          Case{{-8'000'000, -8'000'000 + 65535 * 64, -7'999'936}, 2}, Case{{8'388'607, -8'388'607}, 4},
          Case{{8'388'607, -8'388'607, 0}, 4}, Case{{5'000'001}, 2}, Case{{0, 65537, 1}, 4},
          Case{{2'147'483'647, -2'147'483'647}, 4}}) {
        const Steps steps = stepsOf(c.steps);
        EXPECT_EQ(steps.view().toVector(), c.steps);
        EXPECT_EQ(steps.bytes(), c.bytesEach * c.steps.size()) << c.steps[0];
        const Steps copy = steps;
        EXPECT_EQ(copy, steps);
        EXPECT_TRUE(std::ranges::equal(copy, c.steps));
        const auto [lowest, highest] = std::ranges::minmax(c.steps);
        EXPECT_EQ(lowestAndHighest(steps), std::pair(lowest, highest));
        EXPECT_EQ(steps.view().subspan(1, c.steps.size() - 1).toVector(),
                  Wide(c.steps.begin() + 1, c.steps.end()));
    }
}

TEST(Steps, ofASquareAreThoseOfTheGrid) {
    std::vector<std::int16_t> grid(5 * 5);
    std::iota(grid.begin(), grid.end(), std::int16_t{-9});
    const std::span<const std::int16_t> all = grid;
    const Steps square(all.subspan(1 * 5 + 2), 5, 3, 100, 2);
    EXPECT_THAT(square.view().toVector(), testing::ElementsAre(96, 98, 100, 106, 108, 110, 116, 118, 120));
}

TEST(Steps, ofSixteenBitsLieInMemoryAsTheyAre) {
    const std::vector<std::int16_t> shorts = {-3, 5, 32767};
    const Steps steps = shorts;
    EXPECT_TRUE(std::ranges::equal(steps.view().plain(), shorts));
    EXPECT_TRUE(Steps(shorts, 10, 1).view().plain().empty());
    EXPECT_EQ(Steps(shorts, 10, 4)[1], 30);
    EXPECT_TRUE(Steps().empty());
    EXPECT_TRUE(StepsView().plain().empty());
}

}  // namespace
}  // namespace planet
