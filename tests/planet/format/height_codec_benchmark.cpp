// How well and how fast the height codec codes the real Earth. MB/s are of decoded heights, 2 bytes a sample,
// the coarse grid's samples counted in; bits_a_sample is of the whole pyramid for each sample of its finest
// level.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/format/height_codec.h"
#include "tests/support/earth_windows.h"

namespace {

using planet::test::Block;
using planet::test::Square;

// Half of the Earth: 2049 x 2049 of its 4320 x 2160 samples.
const Square& hemisphere() {
    static const Square window = planet::test::earthWindow(2100, 50, 2049);
    return window;
}

// 515 x 515 of its samples made four times as dense, as a bake finer than its source has them: bilinear, the
// mean of four places two dense samples off.
const Square& oversampled() {
    static const Square dense = [] {
        const Square from = planet::test::earthWindow(3000, 500, 515);
        Square square{2049, {}};
        for (int y = 0; y < 2049; ++y)
            for (int x = 0; x < 2049; ++x) {
                double sum = 0;
                for (const int dy : {-2, 2})
                    for (const int dx : {-2, 2}) {
                        const int sourceX = x + 4 + dx;
                        const int sourceY = y + 4 + dy;
                        const int column = sourceX / 4;
                        const int row = sourceY / 4;
                        const double u = (sourceX % 4) / 4.0;
                        const double v = (sourceY % 4) / 4.0;
                        sum += (from.at(column, row) * (1 - u) + from.at(column + 1, row) * u) * (1 - v) +
                               (from.at(column, row + 1) * (1 - u) + from.at(column + 1, row + 1) * u) * v;
                    }
                square.samples.push_back(static_cast<std::int32_t>(std::lround(sum / 4)));
            }
        return square;
    }();
    return dense;
}

struct Coded {
    std::vector<Block> blocks;
    std::vector<std::vector<std::byte>> bytes;
    double bitsPerSample = 0;  // of the finest level
};

Coded code(const Square& square, int coarseCells, int level) {
    Coded coded{planet::test::pyramidBlocks(square, coarseCells), {}, 0};
    std::size_t size = 0;
    for (const Block& block : coded.blocks) {
        planet::encodeRefinement(block.fine.samples, coarseCells, level, 0, coded.bytes.emplace_back());
        size += coded.bytes.back().size();
    }
    coded.bitsPerSample = 8.0 * static_cast<double>(size) / static_cast<double>(square.samples.size());
    return coded;
}

void report(benchmark::State& state, const Coded& coded) {
    const std::size_t fineSamples = coded.blocks.size() * coded.blocks.front().fine.samples.size();
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(2 * fineSamples));
    state.counters["bits_a_sample"] = coded.bitsPerSample;
}

void encode(benchmark::State& state, const Square& (*ground)()) {
    const int coarseCells = static_cast<int>(state.range(0));
    const int level = static_cast<int>(state.range(1));
    const Coded coded = code(ground(), coarseCells, level);
    std::vector<std::byte> bytes;
    for (auto _ : state) {
        for (const Block& block : coded.blocks) {
            bytes.clear();
            planet::encodeRefinement(block.fine.samples, coarseCells, level, 0, bytes);
            benchmark::DoNotOptimize(bytes.data());
        }
    }
    report(state, coded);
}

void decode(benchmark::State& state, const Square& (*ground)()) {
    const int coarseCells = static_cast<int>(state.range(0));
    const Coded coded = code(ground(), coarseCells, static_cast<int>(state.range(1)));
    // A reader has the coarse grid in 16 bits.
    std::vector<planet::Steps> coarse;
    for (const Block& block : coded.blocks)
        coarse.emplace_back(std::span<const std::int32_t>(block.coarse.samples));
    for (auto _ : state) {
        for (std::size_t i = 0; i < coded.blocks.size(); ++i) {
            const auto fine = planet::decodeRefinement(coded.bytes[i], coarse[i], coarseCells, 0);
            if (!fine) return state.SkipWithError("a block does not decode");
            benchmark::DoNotOptimize(&*fine);
        }
    }
    report(state, coded);
}

void levelsAndSizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgNames({"c", "level"})->Unit(benchmark::kMillisecond);
    for (int level = planet::minCompressionLevel; level <= planet::maxCompressionLevel; ++level)
        benchmark->Args({32, level});
    for (const int coarseCells : {16, 64, 128})
        benchmark->Args({coarseCells, planet::defaultCompressionLevel});
}

BENCHMARK_CAPTURE(encode, earth, hemisphere)->Apply(levelsAndSizes);
BENCHMARK_CAPTURE(decode, earth, hemisphere)->Apply(levelsAndSizes);
BENCHMARK_CAPTURE(encode, oversampled, oversampled)->Apply(levelsAndSizes);
BENCHMARK_CAPTURE(decode, oversampled, oversampled)->Apply(levelsAndSizes);

}  // namespace

BENCHMARK_MAIN();
