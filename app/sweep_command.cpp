#include "app/sweep_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "app/bake_progress.h"
#include "app/data_set.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/sweep_plot.h"
#include "planet/chunk_file.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int usualChunkSize = 33;

// The chunk file of a size: the named one, or a bake that is made where there is none yet.
Result<std::filesystem::path> chunkFileOf(const SweepOptions& options, int chunkSize) {
    planet::BakeSettings settings;
    settings.chunkSize = chunkSize;
    const Result<DataSet> data = findDataSet(options.file, settings, options.sourceSettings);
    if (!data) return tl::unexpected(data.error());
    if (!data->needsBake) return data->chunkFile;
    const Result<planet::HeightSource> source =
        planet::openHeightSource(data->source, options.sourceSettings);
    if (!source) return tl::unexpected(source.error());
    std::error_code problem;
    std::filesystem::create_directories(data->chunkFile.parent_path(), problem);  // if not, the bake says so
    const auto report = bakeOnTerminal(*source, settings, data->chunkFile);
    if (!report) return tl::unexpected(report.error());
    return data->chunkFile;
}

// An open planet of one chunk size.
struct SweptPlanet {
    int chunkSize = usualChunkSize;
    Offscreen offscreen;
    std::unique_ptr<planet::FinestHeights> heights;
};

Result<SweptPlanet> openSwept(const SweepOptions& options, int chunkSize) {
    const Result<std::filesystem::path> chunkFile = chunkFileOf(options, chunkSize);
    if (!chunkFile) return tl::unexpected(chunkFile.error());
    Result<planet::ChunkFile> file = planet::ChunkFile::open(*chunkFile);
    if (!file) return tl::unexpected(file.error());
    const int size = planet::chunkSize(file->info().shape);
    if (size != chunkSize) {
        return planet::badInput(
            fmt::format("{}: its chunks are {} a side; for chunks of {} name what it was baked from",
                        chunkFile->string(), size, chunkSize));
    }
    Result<Offscreen> offscreen = openOffscreen({.chunkFile = *chunkFile}, options.view, options.size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());
    return SweptPlanet{
        size, std::move(*offscreen),
        std::make_unique<planet::FinestHeights>(std::make_shared<const planet::ChunkFile>(std::move(*file)))};
}

// Those asked for; else the chunk file's own, or the usual one.
Result<std::vector<int>> wantedSizes(const SweepOptions& options) {
    if (!options.chunkSizes.empty()) return options.chunkSizes;
    if (options.file.extension() != ".chk") return std::vector{usualChunkSize};
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(options.file);
    if (!file) return tl::unexpected(file.error());
    return std::vector{planet::chunkSize(file->info().shape)};
}

ui::ViewSettings settingsAt(const SweepOptions& options, planet::ErrorMetric metric, double tauPx) {
    ui::ViewSettings settings = options.view;
    settings.lod.metric = metric;
    settings.lod.tauPx = tauPx;
    return settings;
}

void printHead() {
    fmt::print("{:>6} {:<9}{:>7}{:>14}{:>9}{:>10}{:>10}{:>12}{:>11}{:>9}{:>11}\n", "chunk", "metric", "tau",
               "triangles", "chunks", "MiB", "frame ms", "predicted", "measured", "p99", "violations");
}

void print(const SweepPoint& point) {
    const FlightFigures& f = point.figures;
    fmt::print("{:>6} {:<9}{:>7g}{:>14.0f}{:>9.0f}{:>10.1f}{:>10.1f}{:>12.3f}{:>11.3f}{:>9.3f}{:>11}\n",
               point.chunkSize, errorMetricNames[static_cast<std::size_t>(point.metric)], point.tauPx,
               f.meanTriangles, f.meanChunks, f.mostResidentMiB, f.medianFrameMs, f.worstPredictedPx,
               f.worstMeasuredPx, f.p99MeasuredPx, f.violations);
    std::fflush(stdout);
}

Result<void> write(const SweepOptions& options, std::vector<SweepPoint> points, const std::string& flight) {
    markFront(points, options.cost);
    if (!options.csvOutput.empty()) {
        if (Result<void> written = writeTextFile(options.csvOutput, sweepCsv(points)); !written)
            return written;
    }
    if (!options.jsonOutput.empty()) {
        const std::string json = sweepJson(points, options.file.string(), flight, options.cost);
        if (Result<void> written = writeTextFile(options.jsonOutput, json); !written) return written;
    }
    if (options.plotOutput.empty()) return {};
    const Result<Picture> plot = plotSweep(points, options.cost, flight);
    if (!plot) return tl::unexpected(plot.error());
    return writePicture(*plot, options.plotOutput);
}

Result<void> sweepOver(const SweepOptions& options, const FlightPath& path, const std::vector<int>& sizes,
                       const KeepFlying& goOn) {
    std::vector<SweepPoint> points;
    for (const int chunkSize : sizes) {
        Result<SweptPlanet> planet = openSwept(options, chunkSize);
        if (!planet) return tl::unexpected(planet.error());
        if (points.empty()) printHead();
        for (const planet::ErrorMetric metric : options.metrics) {
            for (const double tauPx : options.tausPx) {
                const Result<FlightFigures> figures =
                    measureFlight(planet->offscreen, path, settingsAt(options, metric, tauPx), options.frames,
                                  FigureSet::CostAndError, *planet->heights, goOn);
                if (!figures) return tl::unexpected(figures.error());
                points.push_back({chunkSize, metric, tauPx, *figures});
                print(points.back());
            }
        }
    }
    return write(options, std::move(points), path.name);
}

Result<void> suggest(const SweepOptions& options, const FlightPath& path, int chunkSize,
                     const KeepFlying& goOn) {
    Result<SweptPlanet> planet = openSwept(options, chunkSize);
    if (!planet) return tl::unexpected(planet.error());
    const TauGoal& goal = *options.goal;
    const char* what = goal.limitsError ? "worst measured error, px" : costName(goal.cost);
    for (const planet::ErrorMetric metric : options.metrics) {
        const Result<TauSuggestion> found = suggestTau(goal, [&](double tauPx) -> Result<double> {
            const FigureSet wanted = goal.limitsError ? FigureSet::CostAndError : FigureSet::Cost;
            const Result<FlightFigures> figures =
                measureFlight(planet->offscreen, path, settingsAt(options, metric, tauPx), options.frames,
                              wanted, *planet->heights, goOn);
            if (!figures) return tl::unexpected(figures.error());
            return goal.limitsError ? figures->worstMeasuredPx : costOf(*figures, goal.cost);
        });
        if (!found) return tl::unexpected(found.error());
        fmt::print("{}: tau {:.3g} px, {} {:.6g}, {} {:g}{}\n",
                   errorMetricNames[static_cast<std::size_t>(metric)], found->tauPx, what, found->value,
                   found->met ? "within" : "over", goal.limit,
                   found->met ? "" : ", and no tau from 0.1 to 64 keeps it");
    }
    return {};
}

}  // namespace

Result<void> runSweep(const SweepOptions& options) {
    const Result<FlightPath> path = loadFlightPath(options.flight);
    if (!path) return tl::unexpected(path.error());
    const Result<std::vector<int>> sizes = wantedSizes(options);
    if (!sizes) return tl::unexpected(sizes.error());
    const InterruptWatch watch;
    const KeepFlying goOn = [&] { return !watch.interrupted(); };
    return options.goal ? suggest(options, *path, sizes->front(), goOn)
                        : sweepOver(options, *path, *sizes, goOn);
}

}  // namespace worldy
