#include "app/editor/sweep_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <utility>

#include "app/base/output_file.h"
#include "app/data/write_check.h"
#include "app/flight/flight_path.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/sweep_plot.h"
#include "app/settings/screenshot.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// Those of the open planet's bake. A bake by the defaults has brothers by the defaults: other sizes then have
// the names by which worldy sweep and opening the source know them too.
planet::BakeSettings bakeSettingsOf(const OpenPlanet& open) {
    planet::BakeSettings usual;
    usual.chunkSize = open.baked.settings.chunkSize;
    const fs::path byDefault =
        cachedBakeOf(open.baked.source, usual, open.baked.sourceSettings, open.data.bakedColour);
    return byDefault == open.data.chunkFile ? usual : open.baked.settings;
}

Result<SweptFile> sweptFileOf(const OpenPlanet& open, int chunkSize) {
    const int own = planet::chunkSize(open.scene.planet->tree().shape);
    if (!planet::heightSourceExists(open.baked.source)) {
        if (chunkSize == own) return SweptFile{own, open.data.chunkFile, false, open.baked.settings};
        return planet::badInput(
            fmt::format("{}: its source is missing, so only its own chunk size of {} can be swept; open the "
                        "source instead",
                        open.data.chunkFile.string(), own));
    }
    planet::BakeSettings settings = bakeSettingsOf(open);
    settings.chunkSize = chunkSize;
    if (chunkSize == own) return SweptFile{own, open.data.chunkFile, false, settings};
    const Result<DataSet> data =
        findDataSet(open.baked.source, settings, open.baked.sourceSettings, sweptColour);
    if (!data) return tl::unexpected(data.error());
    return SweptFile{chunkSize, data->chunkFile, data->needsBake, settings};
}

std::string messageOf(const planet::Error& error, const SweepDesk& desk) {
    if (error.kind != planet::ErrorKind::Cancelled) return error.message;
    return desk.suggesting ? "The search was cancelled." : "The sweep was cancelled.";
}

void takeWhatCame(SweepDesk& desk) {
    if (!desk.suggesting) {
        const std::vector<SweepPoint> points = desk.job->takePoints();
        desk.table->points.insert(desk.table->points.end(), points.begin(), points.end());
        return;
    }
    const std::vector<SweepSuggestion> found = desk.job->takeSuggestions();
    desk.suggestions.insert(desk.suggestions.end(), found.begin(), found.end());
}

}  // namespace

Result<SweepPlan> sweepPlanOf(const OpenPlanet& open, const SweepRequest& request,
                              const ViewSettings& settings) {
    SweepPlan plan{.source = open.baked.source,
                   .sourceSettings = open.baked.sourceSettings,
                   .files = {},
                   .flight = request.flight,
                   .tausPx = request.tausPx,
                   .metrics = request.metrics,
                   .frames = request.frames,
                   .goal = request.goal,
                   .size = {request.widthPx, request.heightPx},
                   .view = settings};
    std::vector<int> sizes = request.chunkSizes;
    if (sizes.empty()) sizes.push_back(planet::chunkSize(open.scene.planet->tree().shape));
    for (const int size : sizes) {
        Result<SweptFile> file = sweptFileOf(open, size);
        if (!file) return tl::unexpected(file.error());
        plan.files.push_back(std::move(*file));
    }
    return plan;
}

void startSweep(SweepDesk& desk, const OpenPlanet* open, const SweepRequest& request,
                const ViewSettings& settings, const Log& log) {
    if (!open || desk.job) return;
    desk.problem.clear();
    // Before anything is baked for it.
    const Result<FlightPath> path = loadFlightPath(request.flight);
    Result<SweepPlan> plan =
        path ? sweepPlanOf(*open, request, settings) : Result<SweepPlan>(tl::unexpected(path.error()));
    if (!plan) {
        desk.problem = plan.error().message;
        log->error("{}", desk.problem);
        return;
    }
    desk.suggesting = request.goal.has_value();
    if (desk.suggesting) {
        desk.suggestions.clear();
    } else {
        desk.table = SweepTable{.request = request,
                                .flight = path->name,
                                .source = open->data.source,
                                .points = {},
                                .whole = false};
        desk.files = plan->files;
        desk.bakeSource = plan->source;
        desk.sourceSettings = plan->sourceSettings;
    }
    log->info("{} over {}", desk.suggesting ? "Searching for a tolerance" : "Sweeping", path->name);
    desk.job = std::make_unique<SweepJob>(std::move(*plan));
}

void cancelSweep(SweepDesk& desk) {
    if (desk.job) desk.job->cancel();
}

void advanceSweep(SweepDesk& desk, const Log& log) {
    if (!desk.job) return;
    const std::optional<Result<void>> result = desk.job->takeResult();
    takeWhatCame(desk);
    if (!result) return;
    desk.job.reset();
    if (!desk.suggesting) desk.table->whole = result->has_value();
    if (*result) {
        log->info("{}", desk.suggesting ? std::string("Found a tolerance")
                                        : fmt::format("Measured {} settings", desk.table->points.size()));
        return;
    }
    desk.problem = messageOf(result->error(), desk);
    const bool cancelled = result->error().kind == planet::ErrorKind::Cancelled;
    log->log(cancelled ? spdlog::level::warn : spdlog::level::err, "{}", desk.problem);
}

void openSweptChunks(const SweepDesk& desk, int chunkSize, Session& session, const ViewSettings& settings,
                     const Log& log) {
    const auto file = std::find_if(desk.files.begin(), desk.files.end(),
                                   [&](const SweptFile& swept) { return swept.chunkSize == chunkSize; });
    if (file == desk.files.end()) return;
    BakeRequest request;
    request.source = desk.bakeSource;
    request.sourceSettings = desk.sourceSettings;
    request.settings = file->bake;
    openBake(session, request, file->chunkFile, settings, log);
}

Result<fs::path> saveSweep(const SweepDesk& desk, SweepCost cost, const fs::path& folder) {
    if (!desk.table || !desk.table->whole) return planet::badInput("There is no completed sweep to save");
    std::vector<SweepPoint> points = desk.table->points;
    markFront(points, cost);
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    ::localtime_r(&now, &local);
    const Result<fs::path> picture = newScreenshotFile(folder, local);
    if (!picture) return picture;
    fs::path table = *picture, report = *picture;
    table.replace_extension(".csv");
    report.replace_extension(".json");
    Result<void> written = checkKinds({{table, OutputKind::Csv}, {report, OutputKind::Json}});
    if (written) written = writeTextFile(table, sweepCsv(points));
    if (written) {
        const std::string json = sweepJson(points, desk.table->source.string(), desk.table->flight, cost);
        written = writeTextFile(report, json);
    }
    if (written) {
        written = plotSweep(points, cost, desk.table->flight).and_then([&](const Picture& plot) {
            return writePicture(plot, *picture);
        });
    }
    if (written) return picture;
    std::error_code status;
    fs::remove(*picture, status);  // else an empty file would be left
    return tl::unexpected(written.error());
}

ui::SweepView sweepViewOf(const SweepDesk& desk) {
    ui::SweepView view;
    view.table = desk.table ? &*desk.table : nullptr;
    view.suggestions = desk.suggestions;
    view.problem = desk.problem;
    if (!desk.job) return view;
    view.running = true;
    view.suggesting = desk.suggesting;
    view.cancelling = desk.job->cancelling();
    view.progress = desk.job->progress();
    return view;
}

}  // namespace worldy
