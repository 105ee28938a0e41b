#include "planet/bake/file_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tests/support/open_bytes.h"
#include "tests/support/sparse_planet.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::sparsePlanet;
using testing::IsEmpty;
using testing::SizeIs;

// The sparse planet, damaged at so many places of its blocks.
std::vector<std::byte> damagedPlanet(int places) {
    const std::string content = ::tests::contentOf(sparsePlanet().path());
    std::vector<std::byte> bytes(content.size());
    std::memcpy(bytes.data(), content.data(), content.size());
    for (int i = 0; i < places; ++i) {
        const std::size_t first = bytes.size() / 10;
        bytes[first + (bytes.size() - first) / static_cast<std::size_t>(places + 1) *
                          static_cast<std::size_t>(i + 1)] ^= std::byte{0x10};
    }
    return bytes;
}

VerifyReport verifiedBy(int threads, const ChunkFile& file, const HeightSource* source = nullptr) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return verifyFile(file, source).value(); });
}

void expectEqual(const VerifyReport& a, const VerifyReport& b) {
    EXPECT_EQ(a.chunks, b.chunks);
    EXPECT_EQ(a.edges, b.edges);
    EXPECT_EQ(a.leafSamples, b.leafSamples);
    EXPECT_EQ(a.problemCount, b.problemCount);
    EXPECT_EQ(a.sourceProblems, b.sourceProblems);
    EXPECT_EQ(a.problems, b.problems);
    ASSERT_EQ(a.rims.has_value(), b.rims.has_value());
    if (!a.rims) return;
    EXPECT_EQ(a.rims->leaves, b.rims->leaves);
    EXPECT_EQ(a.rims->steepest.chunk, b.rims->steepest.chunk);
    EXPECT_EQ(a.rims->steepest.stepM, b.rims->steepest.stepM);
    EXPECT_EQ(a.rims->levelP999Slope, b.rims->levelP999Slope);
    EXPECT_EQ(a.rims->levelLargestSlope, b.rims->levelLargestSlope);
}

TEST(VerifyFile, reportIsTheSameForAnyNumberOfThreads) {
    const HeightSource source = test::rimSource();
    const VerifyReport alone = verifiedBy(1, *sparsePlanet().file, &source);
    EXPECT_EQ(alone.chunks, sparsePlanet().file->info().chunks);
    EXPECT_THAT(alone.problems, IsEmpty());
    EXPECT_TRUE(alone.rims);
    expectEqual(verifiedBy(5, *sparsePlanet().file, &source), alone);
}

TEST(VerifyFile, problemsAreTheSameAndInTheSameOrderForAnyNumberOfThreads) {
    for (const int places : {1, 7, 400}) {
        const std::vector<std::byte> bytes = damagedPlanet(places);
        const ChunkFile file = test::openBytes(bytes).value();
        const VerifyReport alone = verifiedBy(1, file);
        EXPECT_GT(alone.problemCount, 0u) << places;
        // Chunks above a damaged block are not judged by what is left under them.
        if (places == 1) {
            EXPECT_THAT(alone.problems, SizeIs(1));
        }
        EXPECT_EQ(alone.problems.size(), std::min<std::size_t>(alone.problemCount, 100)) << places;
        expectEqual(verifiedBy(5, file), alone);
    }
}

TEST(VerifyFile, progressGrowsToAllChunksAndIsCalledByOneThreadAtATime) {
    std::atomic<int> inside = 0;
    std::uint64_t lastDone = 0;
    const std::uint64_t all = sparsePlanet().file->info().chunks;
    tbb::task_arena arena(5);
    const auto report = arena.execute([&] {
        return verifyFile(*sparsePlanet().file, nullptr, [&](std::uint64_t done, std::uint64_t total) {
            EXPECT_EQ(++inside, 1);
            EXPECT_EQ(total, all);
            EXPECT_GT(done, lastDone);
            EXPECT_LE(done, total);
            lastDone = done;
            --inside;
            return true;
        });
    });
    ASSERT_TRUE(report);
    EXPECT_GT(lastDone, all / 2);
}

TEST(VerifyFile, endsWhenItsProgressIsCancelled) {
    int calls = 0;
    const auto report = verifyFile(*sparsePlanet().file, nullptr, [&](std::uint64_t, std::uint64_t) {
        ++calls;
        return false;
    });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(calls, 1) << "the callback is called again after it has cancelled";
}

TEST(VerifyFile, errorOfTheSourceIsTheErrorOfTheVerification) {
    HeightSource source = test::rimSource();
    // Only one block: the parts that it does not stop at once are cancelled.
    const auto samples = std::make_shared<std::atomic<int>>(0);
    source.sample = [samples, good = source.sample](const SampleTile& tile,
                                                    std::span<float> out) -> Result<void> {
        if (++*samples == 3000) return ioError("source.tif: block 7 cannot be read");
        return good(tile, out);
    };
    tbb::task_arena arena(5);
    const auto report = arena.execute([&] { return verifyFile(*sparsePlanet().file, &source); });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "source.tif: block 7 cannot be read");
}

}  // namespace
}  // namespace planet
