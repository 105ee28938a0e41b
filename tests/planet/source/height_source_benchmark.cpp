// Measures what sampling Earth's elevation costs, in nanoseconds a sample on one core: all tiles of all six faces. A
// pattern that matches the file has it read by GDAL, as any georeferenced raster is.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <vector>

#include "planet/source/height_source.h"

namespace planet {
namespace {

void sampleEarth(benchmark::State& state, const char* name) {
    const int faceCells = static_cast<int>(state.range(0));
    const int tileCells = static_cast<int>(state.range(1));
    const auto source = openHeightSource(std::filesystem::path(WORLDY_SOURCE_DIR) / "data/earth" / name, {});
    if (!source) return state.SkipWithError(source.error().message.c_str());
    std::vector<float> heights(static_cast<std::size_t>(tileCells + 1) *
                               static_cast<std::size_t>(tileCells + 1));
    const auto sampleAll = [&] {
        for (const Face face : allFaces) {
            for (int row = 0; row < faceCells; row += tileCells) {
                for (int column = 0; column < faceCells; column += tileCells) {
                    const SampleTile tile{face, faceCells, column, row, tileCells + 1, tileCells + 1};
                    if (!source->sample(tile, heights)) return false;
                    benchmark::DoNotOptimize(heights.data());
                }
            }
        }
        return true;
    };
    if (!sampleAll()) return state.SkipWithError("sampling failed");  // fills the block cache
    for (auto _ : state) sampleAll();
    const double tiles = 6.0 * (faceCells / tileCells) * (faceCells / tileCells);
    state.counters["perSample"] =
        benchmark::Counter(tiles * static_cast<double>(heights.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(sampleEarth, asRaster, "elevation.ti?")
    ->ArgNames({"faceCells", "tileCells"})
    ->Args({1024, 128})
    ->Args({2048, 128})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sampleEarth, asImage, "elevation.tif")
    ->ArgNames({"faceCells", "tileCells"})
    ->Args({512, 128})
    ->Args({1024, 128})
    ->Args({2048, 64})
    ->Args({2048, 128})
    ->Args({2048, 256})
    ->Args({4096, 128})
    ->Args({4096, 256})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace planet
