#include "planet/base/parallel.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <thread>
#include <vector>

namespace planet {
namespace {

// Squares the numbers below `count` in a pipeline of two threads, and returns them in the order in which they arrive.
std::vector<std::size_t> squaresInOrder(std::size_t count) {
    constexpr std::size_t places = 4;
    std::vector<std::size_t> underWay(places);
    std::vector<std::size_t> squares;
    std::size_t begun = 0;
    parallelInOrder(
        2, places,
        [&](std::size_t place) {
            if (begun == count) return false;
            underWay[place] = begun++;
            return true;
        },
        [&](std::size_t place) { underWay[place] *= underWay[place]; },
        [&](std::size_t place) { squares.push_back(underWay[place]); });
    return squares;
}

std::vector<std::size_t> expectedSquares(std::size_t count) {
    std::vector<std::size_t> squares(count);
    std::iota(squares.begin(), squares.end(), std::size_t{0});
    for (std::size_t& square : squares) square *= square;
    return squares;
}

TEST(Parallel, ForCallsEachIndexOnce) {
    std::vector<int> calls(1000);
    parallelFor(2, calls.size(), [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(1000, 1));
    parallelFor(0, [](std::size_t) { ADD_FAILURE() << "nothing was to be done"; });
}

TEST(Parallel, InOrderHandsOnWhatItBeganInTheSameOrder) {
    EXPECT_EQ(squaresInOrder(0), expectedSquares(0));
    EXPECT_EQ(squaresInOrder(1), expectedSquares(1));
    EXPECT_EQ(squaresInOrder(500), expectedSquares(500));
}

// Threads that end leave memory to others, which the thread sanitizer took for a race within oneTBB.
TEST(Parallel, ThreadsThatComeAndGoRunPipelinesOfTheirOwn) {
    const auto runInThreads = [] {
        for (int i = 0; i < 50; ++i) {
            std::thread([] {
                for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(squaresInOrder(20), expectedSquares(20));
            }).join();
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(runInThreads);
    for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace planet
