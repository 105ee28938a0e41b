#include "app/editor/suggest_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "app/base/log.h"
#include "app/base/new_file.h"
#include "app/base/places.h"
#include "app/base/text.h"
#include "app/data/data_set.h"
#include "app/editor/settings_controller.h"
#include "app/editor/sweep_controller.h"
#include "app/measure/sweep_files.h"
#include "app/session/notices.h"
#include "app/session/overloaded.h"
#include "app/session/session.h"
#include "app/suggest/suggest_files.h"
#include "app/suggest/suggest_job.h"
#include "app/suggest/suggest_meter.h"
#include "app/suggest/suggest_plans.h"
#include "app/suggest/suggest_report.h"
#include "app/suggest/suggest_run.h"
#include "planet/base/result.h"
#include "planet/tree/region.h"
#include "ui/model/commands.h"
#include "ui/model/suggest_view.h"

namespace worldy {

namespace {

using planet::Result;

void startSuggest(SuggestController& controller, const ui::StartSuggest& start, const SuggestContext& context,
                  Notices& notices) {
    const OpenPlanet* const open = shownPlanet(context.session);
    if (!open || controller.job) return;
    Result<SweptFiles> bakes = sweptFilesOf(*open, start.chunkSizes);
    if (!bakes) return tellError(notices, {"The search cannot start", bakes.error().message, ""});
    controller.outcome.reset();
    controller.trials.clear();
    controller.problem.clear();
    controller.cancelled = false;
    controller.planet = sourceName(open->data.source);
    controller.chunkSize = planet::chunkSize(open->scene.planet->tree().shape);
    SuggestRequest request;
    request.file = open->data.chunkFile;
    request.bakes = std::move(*bakes);
    request.sourceSettings = open->baked.sourceSettings;
    request.colourImage = open->data.colourImage;
    request.budget = start.budget;
    request.flights = start.flights;
    request.viewsOfRecordings = true;
    if (start.surveys) {
        constexpr std::uint64_t viewpoints = 300;
        request.survey.emplace().most = viewpoints;
    }
    request.vary = start.vary;
    request.view = context.settings.settings.view;
    request.size = start.size;
    controller.request = request;
    notices.log.info("Searching settings for {}", budgetText(request.budget));
    controller.job = std::make_unique<SuggestJob>(std::move(request));
}

void applySuggest(const SuggestController& controller, const SuggestContext& context, Notices& notices) {
    const OpenPlanet* const open = shownPlanet(context.session);
    if (!controller.outcome || !open) return;
    if (!mayChange("Settings", context.replaying, notices.log)) return;
    const bool needsOtherFile = open->data.chunkFile != controller.outcome->file;
    if (needsOtherFile && context.session.bake) {
        return tellError(notices,
                         {"The suggestion was not applied",
                          "A bake is running, and its chunks of another size cannot be opened meanwhile",
                          "Apply it again when the bake has ended."});
    }
    const ViewSettings& now = context.settings.settings.view;
    ViewSettings wanted = settingsToApply(now, *controller.outcome);
    if (!(wanted == now)) replaceView(context.settings, std::move(wanted), "suggested settings");
    if (!needsOtherFile) return;
    openSwept(controller.request.bakes, controller.request.sourceSettings,
              controller.outcome->found.best.candidate.chunkSize, context.session, now, notices.log);
    // The planet is the same, so its regions stay.
    if (const OpenPlanet* const opened = shownPlanet(context.session))
        context.settings.regions.planet = opened->data.source;
}

// Returns the report's file. The name of the report is taken first, so that nothing is overwritten.
Result<std::filesystem::path> saveSuggest(SuggestController& controller) {
    Result<std::filesystem::path> report = newTimedFile(picturesFolder(), localTimeNow(), "suggest", "md");
    if (!report) return report;
    const std::filesystem::path folder = report->parent_path();
    const std::string name = report->stem().string();
    const SuggestFiles files = suggestFilesIn(folder, name);
    nameSuggestFiles(controller.request, files.preset, files.regions, *controller.outcome);
    const auto written = writeSuggestion(*controller.outcome, controller.request, folder, name);
    if (written) return report;
    std::error_code status;
    for (const std::filesystem::path& file : {files.report, files.preset, files.regions, files.page})
        std::filesystem::remove(file, status);
    return tl::unexpected(written.error());
}

}  // namespace

void execute(SuggestController& controller, const ui::SuggestCommand& command, const SuggestContext& context,
             Notices& notices) {
    std::visit(
        Overloaded{
            [&](const ui::StartSuggest& start) { startSuggest(controller, start, context, notices); },
            [&](const ui::CancelSuggest&) {
                if (controller.job) controller.job->cancel();
            },
            [&](const ui::ApplySuggest&) { applySuggest(controller, context, notices); },
            [&](const ui::SaveSuggest&) {
                if (!controller.outcome) return;
                const Result<std::filesystem::path> report = saveSuggest(controller);
                if (!report)
                    return tellError(notices, {"The suggestion was not saved", report.error().message, ""});
                confirm(notices,
                        fmt::format("Suggestion saved: {}, with its preset as .toml and its page as .png",
                                    report->string()));
            },
        },
        command);
}

void advanceSuggest(SuggestController& controller, const Log& log) {
    if (!controller.job) return;
    std::optional<Result<SuggestOutcome>> result = controller.job->takeResult();
    std::vector<SuggestTrial> trials = controller.job->takeTrials();
    controller.trials.insert(controller.trials.end(), trials.begin(), trials.end());
    if (!result) return;
    controller.job.reset();
    if (*result) {
        controller.outcome = std::move(**result);
        log.info("{}", verdictText(*controller.outcome));
        return;
    }
    controller.cancelled = result->error().kind == planet::ErrorKind::Cancelled;
    controller.problem = controller.cancelled ? "The search was cancelled." : result->error().message;
    log.write(controller.cancelled ? LogLevel::Warning : LogLevel::Error, controller.problem);
}

ViewSettings settingsToApply(const ViewSettings& now, const SuggestOutcome& outcome) {
    ViewSettings view = now;
    view.lod.tauPx = outcome.settings.lod.tauPx;
    view.lod.metric = outcome.settings.lod.metric;
    view.lod.morphRange = outcome.settings.lod.morphRange;
    view.paging.budgetMB = outcome.settings.paging.budgetMB;
    view.budget = outcome.settings.budget;
    const SuggestCandidate& candidate = outcome.found.best.candidate;
    if (candidate.regions.empty()) return view;
    // Regions that were applied before, and perhaps renamed, are not added twice.
    std::vector<planet::Region> own = now.regions.all();
    std::erase_if(own, [&](planet::Region one) {
        return std::ranges::any_of(candidate.regions, [&](const planet::Region& suggested) {
            one.name = suggested.name;
            return one == suggested;
        });
    });
    std::vector<planet::Region> suggested = candidate.regions;
    for (planet::Region& region : suggested) {
        if (std::ranges::find(own, region.name, &planet::Region::name) != own.end())
            region.name = newRegionName(candidate.plan, own);
    }
    view.regions.list = std::make_shared<const std::vector<planet::Region>>(std::move(own));
    view.regions = regionsWith(view.regions, suggested);
    return view;
}

ui::SuggestView suggestViewOf(const SuggestController& controller, const OpenPlanet* open) {
    ui::SuggestView view;
    view.outcome = controller.outcome ? &*controller.outcome : nullptr;
    view.planet = controller.planet;
    if (open) view.openPlanet = sourceName(open->data.source);
    view.fitsPlanet = open && (open->data.chunkFile == controller.request.file ||
                               (view.outcome && open->data.chunkFile == view.outcome->file));
    view.budget = controller.request.budget;
    view.chunkSize = controller.chunkSize;
    view.trials = controller.trials;
    view.problem = controller.problem;
    if (!controller.job) return view;
    view.running = true;
    view.cancelling = controller.job->cancelling();
    view.progress = controller.job->progress();
    return view;
}

}  // namespace worldy
