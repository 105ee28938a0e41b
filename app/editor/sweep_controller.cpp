#include "app/editor/sweep_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/new_file.h"
#include "app/base/output_file.h"
#include "app/base/picture_file.h"
#include "app/base/places.h"
#include "app/data/write_check.h"
#include "app/flight/flight_path.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/sweep_plot.h"
#include "app/session/overloaded.h"
#include "app/settings/screenshot.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// Returns the settings of the open planet's bake. If they are the defaults, other chunk sizes also use
// defaults, so that their files have the names that `worldy sweep` and opening the source look for.
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
        return planet::badInput(fmt::format(
            "{}: its source is missing, so only its own chunk size of {} can be measured; open the "
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

std::vector<MeasuredFile> measuredFilesOf(const std::vector<SweptFile>& files) {
    std::vector<MeasuredFile> measured;
    for (const SweptFile& file : files) measured.push_back(measuredFileOf(file.chunkFile));
    return measured;
}

std::string messageOf(const planet::Error& error, const SweepController& controller) {
    if (error.kind != planet::ErrorKind::Cancelled) return error.message;
    return controller.suggesting ? "The search was cancelled." : "The sweep was cancelled.";
}

void takeWhatCame(SweepController& controller) {
    if (!controller.suggesting) {
        const std::vector<SweepPoint> points = controller.job->takePoints();
        controller.table->points.insert(controller.table->points.end(), points.begin(), points.end());
        return;
    }
    const std::vector<SweepSuggestion> found = controller.job->takeSuggestions();
    controller.suggestions.insert(controller.suggestions.end(), found.begin(), found.end());
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
    Result<SweptFiles> swept = sweptFilesOf(open, sizes);
    if (!swept) return tl::unexpected(swept.error());
    plan.files = std::move(swept->files);
    return plan;
}

Result<SweptFiles> sweptFilesOf(const OpenPlanet& open, const std::vector<int>& chunkSizes) {
    SweptFiles swept{open.baked.source, {}};
    for (const int size : chunkSizes) {
        Result<SweptFile> file = sweptFileOf(open, size);
        if (!file) return tl::unexpected(file.error());
        swept.files.push_back(std::move(*file));
    }
    return swept;
}

void openSwept(const SweptFiles& files, const planet::HeightSourceSettings& sourceSettings, int chunkSize,
               Session& session, const ViewSettings& settings, const Log& log) {
    const auto file = std::ranges::find(files.files, chunkSize, &SweptFile::chunkSize);
    if (file == files.files.end()) return;
    openBake(session, {.source = files.source, .sourceSettings = sourceSettings, .settings = file->bake},
             file->chunkFile, settings, log);
}

void startSweep(SweepController& controller, const OpenPlanet* open, const SweepRequest& request,
                const ViewSettings& settings, const Log& log) {
    if (!open || controller.job) return;
    controller.problem.clear();
    controller.cancelled = false;
    // The flight is checked before anything is baked for it.
    const Result<FlightPath> path = loadFlightPath(request.flight);
    Result<SweepPlan> plan =
        path ? sweepPlanOf(*open, request, settings) : Result<SweepPlan>(tl::unexpected(path.error()));
    if (!plan) {
        controller.problem = plan.error().message;
        log.error("{}", controller.problem);
        return;
    }
    controller.suggesting = request.goal.has_value();
    if (controller.suggesting) {
        controller.suggestions.clear();
        controller.suggestedFor = measuredFilesOf(plan->files);
    } else {
        controller.table = SweepTable{.request = request,
                                      .flight = path->name,
                                      .source = open->data.source,
                                      .points = {},
                                      .whole = false};
        controller.swept = {plan->source, plan->files};
        controller.sourceSettings = plan->sourceSettings;
    }
    log.info("{} over {}", controller.suggesting ? "Searching for a tolerance" : "Sweeping", path->name);
    controller.job = std::make_unique<SweepJob>(std::move(*plan));
}

void cancelSweep(SweepController& controller) {
    if (controller.job) controller.job->cancel();
}

void advanceSweep(SweepController& controller, const Log& log) {
    if (!controller.job) return;
    const std::optional<Result<void>> result = controller.job->takeResult();
    takeWhatCame(controller);
    if (!result) return;
    controller.job.reset();
    if (!controller.suggesting) {
        controller.table->whole = result->has_value();
        controller.measured = measuredFilesOf(controller.swept.files);
    }
    if (*result) {
        log.info("{}", controller.suggesting
                           ? std::string("Found a tolerance")
                           : fmt::format("Measured {} settings", controller.table->points.size()));
        return;
    }
    controller.problem = messageOf(result->error(), controller);
    controller.cancelled = result->error().kind == planet::ErrorKind::Cancelled;
    log.write(controller.cancelled ? LogLevel::Warning : LogLevel::Error, controller.problem);
}

Result<fs::path> saveSweep(const SweepController& controller, SweepCost cost, const fs::path& folder) {
    if (!controller.table || !controller.table->whole)
        return planet::badInput("There is no completed sweep to save");
    std::vector<SweepPoint> points = controller.table->points;
    markFront(points, cost);
    const Result<fs::path> picture = newScreenshotFile(folder, localTimeNow());
    if (!picture) return picture;
    fs::path table = *picture, report = *picture;
    table.replace_extension(".csv");
    report.replace_extension(".json");
    Result<void> written = checkKinds({{table, OutputKind::Csv}, {report, OutputKind::Json}});
    if (written) written = writeTextFile(table, sweepCsv(points));
    if (written) {
        const std::string json =
            sweepJson(points, controller.table->source.string(), controller.table->flight, cost);
        written = writeTextFile(report, json);
    }
    if (written) {
        written = plotSweep(points, cost, controller.table->flight).and_then([&](const Picture& plot) {
            return writePicture(plot, *picture);
        });
    }
    if (written) return picture;
    std::error_code status;
    fs::remove(*picture, status);  // otherwise an empty file would remain
    return tl::unexpected(written.error());
}

void keepResults(const SweepController& controller, KeptResults& kept) {
    if (controller.table && !controller.table->points.empty()) {
        KeptSweep& sweep = kept.sweep.emplace();
        sweep.table = *controller.table;
        // The next start may be in another folder. The text of a terrain is no path.
        std::error_code status;
        if (!planet::isTerrainText(sweep.table.source))
            sweep.table.source = fs::absolute(sweep.table.source, status);
        sweep.files = controller.measured;
        for (const SweptFile& file : controller.swept.files) sweep.chunkSizes.push_back(file.chunkSize);
    }
    if (!controller.suggestions.empty())
        kept.suggestions = KeptSuggestions{controller.suggestions, controller.suggestedFor};
}

void restoreResults(SweepController& controller, const KeptResults& kept, const Log& log) {
    const auto leaveOut = [&](const std::string& changed, const char* what) {
        controller.problem = fmt::format("{}; the {} of the last session is not shown", changed, what);
        log.warn("{}", controller.problem);
    };
    if (kept.sweep) {
        const KeptSweep& sweep = *kept.sweep;
        if (const std::string changed = changedSince(sweep.files); !changed.empty()) {
            leaveOut(changed, "sweep");
        } else {
            controller.table = sweep.table;
            controller.measured = sweep.files;
            for (std::size_t i = 0; i < sweep.files.size(); ++i)
                controller.swept.files.push_back(
                    {.chunkSize = sweep.chunkSizes[i], .chunkFile = sweep.files[i].file});
        }
    }
    if (!kept.suggestions) return;
    if (const std::string changed = changedSince(kept.suggestions->files); !changed.empty())
        return leaveOut(changed, "suggested tolerance");
    controller.suggestions = kept.suggestions->found;
    controller.suggestedFor = kept.suggestions->files;
}

void execute(SweepController& controller, const ui::SweepCommand& command, Session& session,
             const ViewSettings& settings, Notices& notices) {
    std::visit(Overloaded{
                   [&](const ui::StartSweep& sweep) {
                       startSweep(controller, shownPlanet(session), sweep.request, settings, notices.log);
                   },
                   [&](const ui::CancelSweep&) { cancelSweep(controller); },
                   [&](const ui::SaveSweep& save) {
                       const Result<fs::path> plot = saveSweep(controller, save.cost, picturesFolder());
                       if (!plot)
                           return tellError(notices, {"The sweep was not saved", plot.error().message, ""});
                       confirm(notices, fmt::format("Sweep saved: {}, with its table as .csv and .json",
                                                    plot->string()));
                   },
                   [&](const ui::OpenSweptChunks& open) {
                       openSwept(controller.swept, controller.sourceSettings, open.chunkSize, session,
                                 settings, notices.log);
                   },
               },
               command);
}

ui::SweepView sweepViewOf(const SweepController& controller) {
    ui::SweepView view;
    view.table = controller.table ? &*controller.table : nullptr;
    view.suggestions = controller.suggestions;
    view.problem = controller.problem;
    if (!controller.job) return view;
    view.running = true;
    view.suggesting = controller.suggesting;
    view.cancelling = controller.job->cancelling();
    view.progress = controller.job->progress();
    return view;
}

}  // namespace worldy
