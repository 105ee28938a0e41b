#include "app/cli/fly_command.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/glossary.h"
#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/report.h"
#include "app/base/stopwatch.h"
#include "app/flight/announce_flight.h"
#include "app/flight/budget_figures.h"
#include "app/flight/flight_path.h"
#include "app/flight/flight_path_file.h"
#include "app/flight/planet_trace.h"
#include "app/scene/frame_report.h"
#include "app/scene/governing.h"
#include "app/scene/offscreen.h"
#include "planet/base/percentile.h"
#include "planet/measure/lod_changes.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

constexpr int mostFlownFrames = 1'000'000;

struct FlownFrame {
    double timeS = 0;
    planet::CameraPose pose;
    bool lifted = false;
    FrameStats stats;
};

// A flight as it was flown.
struct Flown {
    FlightPath path;
    std::vector<FlownFrame> frames;
    std::uint64_t thrash = 0;  // level changes back and forth within a second
    double lateChunkS = 0;
};

// A quantity of the summary and its name in JSON.
struct Quantity {
    const char* name;
    double (*of)(const FrameStats&);
};
using Stats = FrameStats;
constexpr std::array<Quantity, 24> quantities = {{
    {"visited", [](const Stats& s) { return double{1} * s.selection.visited; }},
    {"culled",
     [](const Stats& s) { return double{1} * (s.selection.culledFrustum + s.selection.culledHorizon); }},
    {terms::drawnChunks.key, [](const Stats& s) { return double{1} * s.selection.drawn; }},
    {terms::groundTriangles.key,
     [](const Stats& s) { return static_cast<double>(s.selection.groundTriangles); }},
    {terms::skirtTriangles.key,
     [](const Stats& s) { return static_cast<double>(s.selection.skirtTriangles); }},
    {terms::triangles.key, [](const Stats& s) { return static_cast<double>(s.selection.triangles()); }},
    {"waiting", [](const Stats& s) { return double{1} * s.selection.waiting; }},
    {"worst_eps_px", [](const Stats& s) { return static_cast<double>(s.selection.worstEpsPx); }},
    {"worst_drawn_bound_px",
     [](const Stats& s) { return static_cast<double>(s.selection.worstDrawnBoundPx); }},
    {"queued", [](const Stats& s) { return double{1} * s.paging.queued; }},
    {"resident_bytes_cpu", [](const Stats& s) { return static_cast<double>(s.paging.residentBytesCpu); }},
    {"resident_bytes_gpu", [](const Stats& s) { return static_cast<double>(s.paging.residentBytesGpu); }},
    {"bytes_read", [](const Stats& s) { return static_cast<double>(s.paging.bytesRead()); }},
    {"upload_ms", [](const Stats& s) { return s.stages.uploadMs; }},
    {"select_ms", [](const Stats& s) { return s.stages.selectMs; }},
    {"paging_ms", [](const Stats& s) { return s.stages.pagingMs; }},
    {"draw_cpu_ms", [](const Stats& s) { return s.drawCpuMs; }},
    {"draw_gpu_ms", [](const Stats& s) { return s.render.chunksMs + s.render.skyMs + s.render.shadowsMs; }},
    {"chunks_gpu_ms", [](const Stats& s) { return s.render.chunksMs; }},
    {"sky_gpu_ms", [](const Stats& s) { return s.render.skyMs; }},
    {"frame_ms", [](const Stats& s) { return s.frameMs; }},
    {"colour_tile_bytes", [](const Stats& s) { return static_cast<double>(s.gpuMemory.colourTiles); }},
    {"clipmap_bytes", [](const Stats& s) { return static_cast<double>(s.gpuMemory.colourClipmap); }},
    {"clipmap_texels", [](const Stats& s) { return static_cast<double>(s.clipmap.filledTexels); }},
}};

// Returns true for counts. Times and pixels are measures; percentiles of a count are counts too.
bool isCount(const Quantity& quantity) {
    const std::string_view name = quantity.name;
    return !name.ends_with("_ms") && !name.ends_with("_px");
}

struct Spread {
    double median = 0;
    double percentile99 = 0;
    double maximum = 0;
};

Spread spreadOf(const std::vector<FlownFrame>& frames, const Quantity& quantity) {
    std::vector<double> values;
    for (const FlownFrame& frame : frames) values.push_back(quantity.of(frame.stats));
    return {planet::percentileOf(values, 0.5), planet::percentileOf(values, 0.99),
            planet::percentileOf(values, 1)};
}

// Announces the flight when the last announcement has run out.
void announceAhead(Offscreen& offscreen, const FlightPath& path, double timeS, const ViewSettings& settings,
                   std::optional<FlightAnnouncement>& announced) {
    const planet::PrefetchSettings& prefetch = settings.paging.prefetch;
    if (prefetch.mode != planet::PrefetchMode::Announced) return;
    if (announced && announced->holds(timeS, prefetch.horizonS, 1)) return;
    planet::View like;
    like.horizontalFovRad = glm::radians(settings.camera.fovDeg);
    like.widthPx = offscreen.target.widthPx();
    like.heightPx = offscreen.target.heightPx();
    planet::Planet& planet = *offscreen.scene.planet;
    const AnnouncedFlight next =
        announceFlight(path, timeS, 1, prefetch.horizonS, like, planet.tree().shape.radiusM);
    announced = next.announcement;
    planet.announce(next.views);
}

// elapsedS: time in the flight since the last frame.
Result<FlownFrame> flyFrame(Offscreen& offscreen, const FlightPath& path, double timeS, double elapsedS,
                            const ViewSettings& settings) {
    Scene& scene = offscreen.scene;
    const double radiusM = scene.planet->tree().shape.radiusM;
    const Camera wanted = cameraFromPose(poseAt(path, timeS), radiusM);
    const Camera camera = keepInRange(wanted, groundBelow(scene, wanted.eyeM));
    const planet::View view = viewOf(camera, glm::radians(settings.camera.fovDeg), offscreen.target.widthPx(),
                                     offscreen.target.heightPx());
    const Stopwatch stepping;
    stepScene(scene, view, settings, elapsedS);
    const double stepMs = stepping.elapsedMs();
    double drawMs = 0;
    const auto draw = [&] {
        const Stopwatch drawing;
        const Result<void> drawn = drawAndFinish(offscreen, view, settings);
        drawMs = drawing.elapsedMs();
        return drawn;
    };
    if (const Result<void> drawn = draw(); !drawn) return tl::unexpected(drawn.error());
    // The window never waits for the compiler, so a frame that did is drawn again.
    if (scene.drawn.newPrograms > 0) {
        forgetDraws(scene);
        if (const Result<void> drawn = draw(); !drawn) return tl::unexpected(drawn.error());
    }
    FlownFrame frame{timeS, planet::poseFromView(view, radiusM), camera.eyeM != wanted.eyeM, statsOf(scene)};
    frame.stats.frameMs = stepMs + drawMs;
    return frame;
}

BudgetFigures figuresOf(const Flown& flown) {
    std::vector<BudgetedFrame> frames;
    for (const FlownFrame& frame : flown.frames)
        frames.push_back(
            {frame.timeS - flown.frames.front().timeS, frame.stats.budget.use, frame.stats.budget.limit});
    return budgetFiguresOf(frames);
}

Json budgetJson(const FlyOptions& options, const Flown& flown) {
    const BudgetSettings& budget = options.view.budget;
    const BudgetFigures figures = figuresOf(flown);
    std::map<std::string, int> binds;
    for (const FlownFrame& frame : flown.frames) ++binds[std::string(bindsKey(frame.stats.budget))];
    return {{"cpu_ms", budget.cpuMs},
            {"gpu_ms", budget.gpuMs},
            {"triangles", budget.triangles},
            {"memory_mb", budget.memoryMB},
            {"read_mb_s", budget.readMBs},
            {"least_tau_px", budget.leastTauPx},
            {"most_tau_px", budget.mostTauPx},
            {"frames", figures.frames},
            {"frames_over", figures.over},
            {"frames_at_lower_limit", figures.atLowerLimit},
            {"frames_at_upper_limit", figures.atUpperLimit},
            {"median_use", figures.medianUse},
            {"most_use", figures.mostUse},
            {"thrash", flown.thrash},
            {terms::budgetBinds.key, binds}};
}

Json jsonOf(const FlyOptions& options, const Flown& flown) {
    const auto& [path, frames, thrash, lateChunkS] = flown;
    Json report = {{"flight", path.name},
                   {"file", options.file.string()},
                   {"frames", frames.size()},
                   {"width_px", options.size.widthPx},
                   {"height_px", options.size.heightPx},
                   {"tau_px", options.view.lod.tauPx},
                   {"budget_mb", options.view.paging.budgetMB},
                   {terms::lateChunkS.key, lateChunkS}};
    for (const Quantity& quantity : quantities) {
        const Spread spread = spreadOf(frames, quantity);
        const auto figure = [&](double value) {
            return isCount(quantity) ? Json(std::llround(value)) : Json(value);
        };
        report["summary"][quantity.name] = {{"median", figure(spread.median)},
                                            {"p99", figure(spread.percentile99)},
                                            {"maximum", figure(spread.maximum)}};
    }
    if (options.view.budget.isOn()) report["budget"] = budgetJson(options, flown);
    report["frame"] = Json::array();
    for (const FlownFrame& frame : frames) {
        Json entry = {{"time_s", frame.timeS}, {"camera", poseJson(frame.pose)}, {"lifted", frame.lifted}};
        entry.update(statsJson(frame.stats));
        report["frame"].push_back(std::move(entry));
    }
    return report;
}

void printBudget(const Flown& flown) {
    const BudgetFigures figures = figuresOf(flown);
    fmt::print(
        "\nBudget, without the first second: {} of {} frames over budget, at most {:.1f} %; median use "
        "{:.1f} % where tau is above its lower limit, which it reaches in {} frames; {} chunks thrashed\n",
        figures.over, figures.frames, 100 * figures.mostUse, 100 * figures.medianUse, figures.atLowerLimit,
        flown.thrash);
}

void printSummary(const Flown& flown) {
    const auto& [path, frames, thrash, lateChunkS] = flown;
    fmt::print("{}: {} frames over {:.0f} s\n\n{:20}{:>16}{:>16}{:>16}\n", path.name, frames.size(),
               durationS(path), "", "median", "99th percentile", "maximum");
    for (const Quantity& quantity : quantities) {
        const Spread s = spreadOf(frames, quantity);
        const int digits = isCount(quantity) ? 0 : 3;
        fmt::print("{:20}{:16.{}f}{:16.{}f}{:16.{}f}\n", quantity.name, s.median, digits, s.percentile99,
                   digits, s.maximum, digits);
    }
    fmt::print("\n{}: {:.1f}\n", terms::lateChunkS.name, lateChunkS);
}

void printPrefetch(const FrameStats& last) {
    const planet::PrefetchCounters prefetch = last.paging.prefetch();
    fmt::print("Prefetched: {} blocks, {:.3f} MB; {} hits, {} wasted, {} unused\n", prefetch.blocks,
               static_cast<double>(prefetch.bytes) / 1e6, prefetch.hits, prefetch.wasted, prefetch.unused());
}

}  // namespace

Result<void> flyPath(const FlyOptions& options) {
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const Result<FlightFrames> moments = framesOf(*path, options.sampling, mostFlownFrames);
    if (!moments) return tl::unexpected(moments.error());
    const SceneConfig config{.chunkFile = options.file, .shaderFolder = options.shaderFolder};
    Result<Offscreen> offscreen = openOffscreen(config, options.view, options.size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());

    // The first view is settled, as in a window before the user moves, instead of starting with the root
    // chunks.
    settleAt(*offscreen, path->keys.front().pose, options.view);
    planet::Planet& planet = *offscreen->scene.planet;
    std::optional<PlanetTrace> trace;
    if (!options.trace.empty()) {
        Result<PlanetTrace> created = PlanetTrace::create(options.trace, planet, path->name);
        if (!created) return tl::unexpected(created.error());
        trace.emplace(std::move(*created));
    }
    const InterruptWatch watch;
    Flown flown{*path, {}, 0, 0};
    std::optional<FlightAnnouncement> announced;
    ViewSettings settings = options.view;
    Governing governing;
    planet::LodChanges changes;
    for (int i = 0; i < moments->count; ++i) {
        if (watch.interrupted()) return planet::cancelled();
        const double elapsedS = i > 0 ? moments->stepS : 0;
        announceAhead(*offscreen, *path, moments->timeS(i), settings, announced);
        Result<FlownFrame> frame = flyFrame(*offscreen, *path, moments->timeS(i), elapsedS, settings);
        if (!frame) return tl::unexpected(frame.error());
        FrameStats& stats = frame->stats;
        flown.lateChunkS += moments->stepS * stats.selection.waiting;
        changes.add(planet.selection(), frame->timeS);
        governTau(governing, &stats, planet, elapsedS, settings);
        stats.budget = governing.use;
        if (trace)
            trace->addFrame(planet, {frame->timeS, stats.frameMs,
                                     stats.render.chunksMs + stats.render.skyMs + stats.render.shadowsMs});
        flown.frames.push_back(std::move(*frame));
    }
    flown.thrash = changes.thrashTotal();
    if (trace) {
        if (Result<void> finished = trace->finish(planet); !finished) return finished;
    }
    for (const std::string& problem : takeProblems(offscreen->scene)) printMessage("worldy: {}\n", problem);
    if (!options.report.json) {
        printSummary(flown);
        if (options.view.budget.isOn()) printBudget(flown);
        if (options.view.paging.prefetch.mode != planet::PrefetchMode::Off)
            printPrefetch(flown.frames.back().stats);
    }
    return writeReport(options.report, jsonOf(options, flown));
}

}  // namespace worldy
