// Measures selection, in nanoseconds a visited node, with the settings of the editor: hysteresis, morphs, fades and
// skirts. "near" is a view over mountains, "all" every leaf of the planet. "plain" leaves out seams, hysteresis and fades.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <glm/trigonometric.hpp>
#include <memory>
#include <string>

#include "planet/bake/bake.h"
#include "planet/planet.h"
#include "planet/select/lod_select.h"
#include "planet/source/height_source.h"

namespace planet {
namespace {

struct BakedPlanet {
    BakedPlanet() {
        const auto source = openHeightSource("noise:ridged,seed=7", {});
        if (!source || !bake(*source, {.faceSize = 2049, .chunkSize = 33}, file)) return;
        PagingSettings paging;
        paging.budgetBytes = std::size_t{1} << 30;
        if (auto opened = Planet::open(file, paging)) planet = *std::move(opened);
    }
    ~BakedPlanet() { std::filesystem::remove(file); }
    BakedPlanet(const BakedPlanet&) = delete;
    BakedPlanet& operator=(const BakedPlanet&) = delete;

    std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("lod_select_benchmark_" + std::to_string(::getpid()));
    std::unique_ptr<Planet> planet;
};

void select(benchmark::State& state, bool all, bool plain) {
    static const BakedPlanet baked;
    if (!baked.planet) return state.SkipWithError("no planet");
    LodSettings settings;
    settings.frustumCulling = settings.horizonCulling = !all;
    const View view =
        viewFromPose({.latitudeDeg = 26, .longitudeDeg = 87, .altitudeM = 20'000, .pitchDeg = -10},
                     baked.planet->tree().shape.radiusM, glm::radians(60.0), 1280, 720);
    if (all) settings.tauPx = 1e-9;
    if (plain) {
        settings.hysteresis = 0;
        settings.fadeS = 0;
        settings.seams = SeamMode::None;
    }
    baked.planet->settle(
        view, settings, [](std::uint32_t, StepsView) {}, 600);
    Selection selection;
    for (auto _ : state) selectChunks(baked.planet->tree(), view, settings, selection, 1.0 / 60);
    const double nodes = selection.counters.visited;
    state.counters["visited"] = nodes;
    state.counters["drawn"] = selection.counters.drawn;
    state.counters["perNode"] = benchmark::Counter(
        nodes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(select, nearPlain, false, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(select, nearDefault, false, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(select, allPlain, true, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(select, allDefault, true, false)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace planet
