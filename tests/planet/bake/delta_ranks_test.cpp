#include "planet/bake/delta_ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <thread>
#include <vector>

#include "planet/base/percentile.h"

namespace planet {
namespace {

constexpr std::array<double, 2> askedShares = {0.5, 0.99};

// Values over many powers of ten, of which some are equal.
std::vector<float> deltas(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> exponent(-3, 5);
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(i % 5 == 0 ? static_cast<float>(i % 3) : std::pow(10.0f, exponent(random)));
    return values;
}

// Gives the values to some threads.
template <class Add>
void addAll(const std::vector<float>& values, const Add& add) {
    std::vector<std::thread> threads;
    for (std::size_t first = 0; first < 3; ++first) {
        threads.emplace_back([&, first] {
            for (std::size_t i = first; i < values.size(); i += 3) add(values[i]);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(DeltaRanks, PercentilesAreExactForAnyNumberOfValues) {
    for (const std::size_t count : {0U, 1U, 2U, 1000U, 65536U, 65537U, 300000U}) {
        const std::vector<float> values = deltas(count);
        DeltaRanks ranks(askedShares);
        addAll(values, [&](float value) { ranks.add(value); });
        const bool isMany = ranks.needsSecondPass();
        EXPECT_EQ(isMany, count > 65536);
        if (isMany) addAll(values, [&](float value) { ranks.addAgain(value); });
        for (std::size_t i = 0; i < askedShares.size(); ++i)
            EXPECT_EQ(ranks.percentile(i), percentileOf(std::vector(values), askedShares[i]))
                << count << " values";
    }
}

TEST(DeltaRanks, EqualValuesAreTheirOwnPercentile) {
    DeltaRanks ranks(askedShares);
    for (int i = 0; i < 70000; ++i) ranks.add(-0.0f);
    ASSERT_TRUE(ranks.needsSecondPass());
    for (int i = 0; i < 70000; ++i) ranks.addAgain(0.0f);
    EXPECT_EQ(ranks.percentile(0), 0);
    EXPECT_EQ(ranks.percentile(1), 0);
}

}  // namespace
}  // namespace planet
