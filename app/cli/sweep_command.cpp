#include "app/cli/sweep_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "app/base/exit_code.h"
#include "app/base/interrupt.h"
#include "app/base/output_file.h"
#include "app/base/picture_file.h"
#include "app/base/report.h"
#include "app/data/bake_progress.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/sweep_files.h"
#include "app/measure/sweep_plot.h"
#include "app/measure/sweep_run.h"
#include "app/settings/settings.h"
#include "planet/format/chunk_file.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int usualChunkSize = 33;

// Returns the chunk sizes requested; otherwise the chunk file's own, or 33.
Result<std::vector<int>> wantedSizes(const SweepOptions& options) {
    if (!options.chunkSizes.empty()) return options.chunkSizes;
    if (options.file.extension() != ".chk" || planet::isTerrainText(options.file))
        return std::vector{usualChunkSize};
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(options.file);
    if (!file) return tl::unexpected(file.error());
    return std::vector{planet::chunkSize(file->info().shape)};
}

Result<SweepPlan> planOf(const SweepOptions& options) {
    const Result<std::vector<int>> sizes = wantedSizes(options);
    if (!sizes) return tl::unexpected(sizes.error());
    SweepPlan plan{.source = options.file,
                   .sourceSettings = options.sourceSettings,
                   .files = {},
                   .flight = options.flight,
                   .tausPx = options.tausPx,
                   .metrics = options.metrics,
                   .goal = options.goal,
                   .size = options.size,
                   .view = options.view};
    Result<SweptFiles> swept = sweptFilesOf(options.file, *sizes, options.sourceSettings);
    if (!swept) return tl::unexpected(swept.error());
    plan.source = std::move(swept->source);
    plan.files = std::move(swept->files);
    return plan;
}

void printHead() {
    fmt::print("{:>6} {:<9}{:>7}{:>14}{:>9}{:>10}{:>10}{:>12}{:>11}{:>9}{:>11}\n", "chunk", "metric", "tau",
               "triangles", "chunks", "MiB", "frame ms", "bound", "measured", "p99", "violations");
}

// There is no useful bound if the eye lies within a chunk's bounds.
std::string boundText(double px) {
    return px < 1e5 ? fmt::format("{:.3f}", px) : fmt::format("{:.2e}", px);
}

void print(const SweepPoint& point) {
    const FlightFigures& f = point.figures;
    fmt::print("{:>6} {:<9}{:>7g}{:>14.0f}{:>9.0f}{:>10.1f}{:>10.1f}{:>12}{:>11.3f}{:>9.3f}{:>11}\n",
               point.chunkSize, errorMetricNames[static_cast<std::size_t>(point.metric)], point.tauPx,
               f.meanTriangles, f.meanChunks, f.mostResidentMiB, f.medianFrameMs,
               boundText(f.worstDrawnBoundPx), f.worstMeasuredPx, f.p99MeasuredPx, f.violations);
    flushStandardOutput();
}

// Call before anything is flown.
Result<void> checkTableFile(const SweepOptions& options) {
    const std::filesystem::path& file = options.report.file;
    if (file.empty() || file.extension() == ".json" || (isCsvTable(file) && !options.goal)) return {};
    return planet::badInput(fmt::format("{}: unknown table format; expected {}", file.string(),
                                        options.goal ? ".json" : ".csv or .json"));
}

struct Swept {
    std::vector<SweepPoint> points;
    std::vector<SweepSuggestion> suggestions;  // instead of points if a tau is searched
};

Result<void> write(const SweepOptions& options, Swept swept, const std::string& flight) {
    markFront(swept.points, options.cost);
    const std::string json = options.goal
                                 ? suggestionsJson(swept.suggestions, options.file.string(), flight)
                                 : sweepJson(swept.points, options.file.string(), flight, options.cost);
    if (options.report.json) fmt::print("{}", json);
    const std::filesystem::path& file = options.report.file;
    if (!file.empty()) {
        if (Result<void> written = writeTextFile(file, isCsvTable(file) ? sweepCsv(swept.points) : json);
            !written)
            return written;
    }
    if (options.plotOutput.empty() || options.goal) return {};
    const Result<Picture> plot = plotSweep(swept.points, options.cost, flight);
    if (!plot) return tl::unexpected(plot.error());
    return writePicture(*plot, options.plotOutput);
}

void print(const SweepSuggestion& suggestion) {
    const TauGoal& goal = suggestion.goal;
    const TauSuggestion& found = suggestion.found;
    fmt::print("{}: tau {:.3g} px, {} {:.6g}, {} {:g}{}\n",
               errorMetricNames[static_cast<std::size_t>(suggestion.metric)], found.tauPx,
               goal.limitsError ? "max measured error, px" : costName(goal.cost), found.value,
               found.met ? "within" : "over", goal.limit,
               found.met ? "" : ", and no tau in [0.1, 64] px meets the limit");
    flushStandardOutput();
}

}  // namespace

Result<void> runSweep(const SweepOptions& options) {
    // The outputs and the flight are checked before anything is baked.
    if (Result<void> good = checkTableFile(options); !good) return good;
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const Result<FlightFrames> frames = framesOf(*path, options.sampling, mostFlightViews);
    if (!frames) return tl::unexpected(frames.error());
    Result<SweepPlan> plan = planOf(options);
    if (!plan) return tl::unexpected(plan.error());
    plan->frames = frames->count;
    plan->frameStepS = frames->stepS;
    const InterruptWatch watch;
    std::optional<TerminalProgress> line;
    Swept swept;
    SweepWatcher watcher;
    watcher.baking = [&](int, const planet::BakeProgress& progress) {
        if (!line || progress.samplesDone == 0) line.emplace();
        line->show(progress);
        return !watch.interrupted();
    };
    watcher.flying = [&](const SweepLeg&, int) {
        line.reset();
        return !watch.interrupted();
    };
    watcher.flown = [&](const SweepPoint& point) {
        if (!options.report.json && swept.points.empty()) printHead();
        swept.points.push_back(point);
        if (!options.report.json) print(point);
    };
    watcher.suggested = [&](const SweepSuggestion& suggestion) {
        swept.suggestions.push_back(suggestion);
        if (!options.report.json) print(suggestion);
    };
    if (Result<void> ran = runSweepPlan(*plan, watcher); !ran) return ran;
    return write(options, std::move(swept), path->name);
}

}  // namespace worldy
