#include "app/editor/atlas_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include "app/base/job.h"
#include "app/base/log.h"
#include "app/base/new_file.h"
#include "app/base/places.h"
#include "app/base/text.h"
#include "app/data/data_set.h"
#include "app/editor/camera_controller.h"
#include "app/editor/settings_controller.h"
#include "app/measure/atlas_job.h"
#include "app/measure/atlas_survey.h"
#include "app/measure/atlas_table.h"
#include "app/scene/atlas_drape.h"
#include "app/scene/camera_control.h"
#include "app/session/notices.h"
#include "app/session/overloaded.h"
#include "app/session/session.h"
#include "app/settings/settings.h"
#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_file.h"
#include "planet/measure/atlas_sampling.h"
#include "ui/model/atlas_view.h"
#include "ui/model/commands.h"

namespace worldy {

namespace {

using planet::AtlasMeasure;
using planet::Result;

void drapeAgain(AtlasController& controller) {
    controller.drape =
        controller.isChange
            ? changeDrapeOf(controller.comparison->cells, controller.measure, controller.altitude)
            : drapeOf(controller.cells, controller.measure, controller.altitude);
}

void endComparison(AtlasController& controller) {
    controller.comparison.reset();
    controller.comparisonProblem.clear();
    controller.isChange = false;
}

void showAtlas(AtlasController& controller, planet::Atlas atlas, const std::filesystem::path& file) {
    endComparison(controller);
    controller.spreads = spreadsOf(atlas.viewpoints);
    if (std::ranges::find(controller.spreads, controller.measure, &AtlasSpread::measure) ==
        controller.spreads.end())
        controller.measure = AtlasMeasure::EpsPx;
    controller.altitude =
        std::min(controller.altitude, static_cast<int>(atlas.survey.grid.altitudesM.size()) - 1);
    controller.atlas = std::move(atlas);
    controller.file = file;
    controller.cells = planet::cellsOf(controller.atlas->survey.grid, controller.atlas->viewpoints);
    drapeAgain(controller);
}

void openAtlas(AtlasController& controller, const std::filesystem::path& file, Notices& notices) {
    Result<planet::Atlas> atlas = planet::loadAtlas(file);
    if (!atlas) return tellCannotOpen(notices, file, atlas.error());
    controller.problem.clear();
    showAtlas(controller, std::move(*atlas), file);
    confirm(notices,
            fmt::format("{} opened: {} viewpoints", file.string(), controller.atlas->viewpoints.size()));
}

void showComparison(AtlasController& controller, const planet::Atlas& earlier,
                    const std::filesystem::path& earlierFile) {
    Result<ui::AtlasComparison> comparison =
        comparisonOf(earlier, earlierFile, *controller.atlas, controller.file);
    if (!comparison) {
        controller.comparisonProblem = comparison.error().message;
        return;
    }
    controller.comparison = *std::move(comparison);
    controller.isChange = true;
    const auto& measures = controller.comparison->diff.measures;
    if (std::ranges::find(measures, controller.measure, &planet::AtlasMeasureDiff::measure) == measures.end())
        controller.measure = AtlasMeasure::EpsPx;
    drapeAgain(controller);
}

void compareAtlas(AtlasController& controller, const std::filesystem::path& file, Notices& notices) {
    if (!controller.atlas) return;
    const Result<planet::Atlas> earlier = planet::loadAtlas(file);
    if (!earlier)
        return tellError(
            notices, {fmt::format("{} cannot be compared", file.filename().string()), earlier.error().message,
                      "What is shown is kept. Choose an atlas (.atlas) of the same viewpoints."});
    showComparison(controller, *earlier, file);
}

// ---- surveys ----

// Removes its file at the end if that is still empty.
class Reservation {
public:
    explicit Reservation(std::filesystem::path file) : file_(std::move(file)) {}
    Reservation(const Reservation&) = delete;
    Reservation& operator=(const Reservation&) = delete;
    ~Reservation() {
        std::error_code status;
        if (std::filesystem::file_size(file_, status) == 0 && !status) std::filesystem::remove(file_, status);
    }

private:
    std::filesystem::path file_;
};

// Reserves a new name beside the screenshots. An unfinished survey keeps its name, too.
Result<AtlasFiles> newAtlasFiles() {
    const std::tm now = localTimeNow();
    for (int number = 1; true; ++number) {
        const std::string name = number == 1 ? "atlas" : fmt::format("atlas {}", number);
        TRY_ASSIGN(const std::filesystem::path file, newTimedFile(picturesFolder(), now, name, "atlas"));
        AtlasFiles files{.output = file, .reservation = std::make_shared<Reservation>(file)};
        std::error_code status;
        if (!std::filesystem::exists(planet::unfinishedAtlas(file), status)) return files;
    }
}

void beginSurvey(AtlasController& controller, AtlasRequest request, AtlasFiles files, const DataSet& planet,
                 Notices& notices) {
    request.output = files.output;
    request.threads = static_cast<std::size_t>(backgroundThreads());
    controller.problem.clear();
    controller.cancelled = false;
    files.planet = sourceName(planet.source);
    notices.log.info("Surveying {}", request.file.string());
    controller.files = std::move(files);
    controller.job = std::make_unique<AtlasJob>(std::move(request));
}

void surveyNew(AtlasController& controller, AtlasRequest request, const DataSet& planet, Notices& notices) {
    Result<AtlasFiles> files = newAtlasFiles();
    if (!files) return tellError(notices, {"The planet was not surveyed", files.error().message, ""});
    files->revisited = request.revisited;
    if (files->revisited) files->revisitedFile = controller.file;
    beginSurvey(controller, std::move(request), *std::move(files), planet, notices);
}

void startAtlas(AtlasController& controller, const ui::StartAtlas& start, const AtlasContext& context,
                Notices& notices) {
    if (!context.open || controller.job) return;
    AtlasRequest request;
    request.file = context.open->data.chunkFile;
    request.view = context.settings.settings.view;
    setUsualDisk(request.view.paging.badDisk);
    request.grid.most = start.viewpoints;
    request.measuresError = start.measuresError;
    surveyNew(controller, std::move(request), context.open->data, notices);
}

void revisitAtlas(AtlasController& controller, const ui::RevisitAtlas& revisit, const AtlasContext& context,
                  Notices& notices) {
    if (!context.open || controller.job || !controller.atlas || !controller.atlas->isFinished) return;
    const planet::AtlasSurvey& old = controller.atlas->survey;
    const ViewSettings& now = context.settings.settings.view;
    AtlasRequest request;
    request.file = context.open->data.chunkFile;
    request.view = now;
    if (revisit.withItsSettings) {
        Result<ViewSettings> surveyed = settingsOf(old, controller.file.string(), now.regions);
        if (!surveyed)
            return tellError(notices, {"The planet was not surveyed", surveyed.error().message, ""});
        request.view = *std::move(surveyed);
    } else {
        setUsualDisk(request.view.paging.badDisk);
    }
    request.measuresError = old.measuresError;
    request.revisited = std::make_shared<const planet::Atlas>(*controller.atlas);
    surveyNew(controller, std::move(request), context.open->data, notices);
}

// Returns whether a survey may take the name of a file. A killed survey leaves its reservation, which is empty.
bool isFree(const std::filesystem::path& file) {
    std::error_code status;
    if (!std::filesystem::exists(file, status)) return !status;
    return std::filesystem::is_regular_file(file, status) && std::filesystem::file_size(file, status) == 0 &&
           !status;
}

void resumeAtlas(AtlasController& controller, const AtlasContext& context, Notices& notices) {
    if (!context.open || controller.job || !controller.atlas || controller.atlas->isFinished) return;
    AtlasFiles files{.output = planet::finishedAtlas(controller.file)};
    if (files.output == controller.files.output) files = controller.files;
    if (!isFree(files.output)) {
        const std::string problem =
            fmt::format("{}: exists; expected no file of this name, or an empty one, which the survey gets",
                        files.output.string());
        return tellError(notices, {"The survey was not continued", problem, ""});
    }
    Result<AtlasRequest> request =
        requestToResume(*controller.atlas, files.output, context.open->data.chunkFile,
                        context.settings.settings.view.regions, files.revisited);
    if (!request) return tellError(notices, {"The survey was not continued", request.error().message, ""});
    beginSurvey(controller, *std::move(request), std::move(files), context.open->data, notices);
}

void lookFrom(AtlasController& controller, std::size_t viewpoint, const AtlasContext& context,
              Notices& notices) {
    if (!controller.atlas || viewpoint >= controller.atlas->viewpoints.size() || !context.open) return;
    if (!mayChange("Settings", context.replaying, notices.log)) return;
    const planet::AtlasSurvey& survey = controller.atlas->survey;
    const Result<ViewSettings> surveyed = settingsOf(survey, controller.file.string());
    if (!surveyed)
        return tellError(notices, {"The settings of the atlas were not taken", surveyed.error().message, ""});
    const ViewSettings& now = context.settings.settings.view;
    ViewSettings wanted = settingsToLookWith(now, *surveyed);
    if (!(wanted == now)) replaceView(context.settings, std::move(wanted), "settings of the atlas");
    const planet::CameraPose pose = planet::poseOf(survey, controller.atlas->viewpoints[viewpoint]);
    glideCamera(context.camera, cameraFromPose(pose, survey.radiusM), context.cameraContext);
    controller.altitude = controller.atlas->viewpoints[viewpoint].place.altitude;
    drapeAgain(controller);
}

// Shows what a survey that ended early has left. Returns whether it has left viewpoints; a new one without any leaves no
// file.
bool showUnfinished(AtlasController& controller) {
    const bool isNew = std::exchange(controller.files.reservation, nullptr) != nullptr;
    const std::filesystem::path file = planet::unfinishedAtlas(controller.files.output);
    Result<planet::Atlas> left = planet::loadAtlas(file);
    if (!left || left->viewpoints.empty()) {
        std::error_code status;
        if (isNew) std::filesystem::remove(file, status);
        return false;
    }
    showAtlas(controller, *std::move(left), file);
    return true;
}

void finishAtlas(AtlasController& controller, planet::Atlas atlas, const Log& log) {
    const AtlasFiles files = controller.files;
    log.info("Surveyed {} viewpoints: {}", atlas.viewpoints.size(), files.output.string());
    showAtlas(controller, std::move(atlas), files.output);
    if (files.revisited) showComparison(controller, *files.revisited, files.revisitedFile);
}

}  // namespace

void execute(AtlasController& controller, const ui::AtlasCommand& command, const AtlasContext& context,
             Notices& notices) {
    controller.comparisonProblem.clear();  // it is of an earlier command
    std::visit(
        Overloaded{
            [&](const ui::OpenAtlas& open) { openAtlas(controller, open.file, notices); },
            [&](const ui::StartAtlas& start) { startAtlas(controller, start, context, notices); },
            [&](const ui::CancelAtlas&) {
                if (controller.job) controller.job->cancel();
            },
            [&](const ui::ResumeAtlas&) { resumeAtlas(controller, context, notices); },
            [&](const ui::RevisitAtlas& revisit) { revisitAtlas(controller, revisit, context, notices); },
            [&](const ui::CompareAtlas& compare) { compareAtlas(controller, compare.earlier, notices); },
            [&](const ui::ChooseAtlas& chosen) {
                controller.measure = chosen.measure;
                controller.altitude = chosen.altitude;
                controller.isChange = chosen.isChange && controller.comparison.has_value();
                drapeAgain(controller);
            },
            [&](const ui::LookFromAtlas& look) { lookFrom(controller, look.viewpoint, context, notices); },
        },
        command);
}

void advanceAtlas(AtlasController& controller, const Log& log) {
    if (!controller.job) return;
    std::optional<Result<AtlasOutcome>> result = controller.job->takeResult();
    if (!result) return;
    controller.job.reset();
    if (*result) return finishAtlas(controller, std::move((*result)->atlas), log);
    controller.cancelled = result->error().kind == planet::ErrorKind::Cancelled;
    controller.problem = controller.cancelled ? "The survey was cancelled." : result->error().message;
    if (showUnfinished(controller) && controller.cancelled) controller.problem += " Resume continues it.";
    log.write(controller.cancelled ? LogLevel::Warning : LogLevel::Error, controller.problem);
}

Result<ui::AtlasComparison> comparisonOf(const planet::Atlas& earlier,
                                         const std::filesystem::path& earlierFile, const planet::Atlas& now,
                                         const std::filesystem::path& nowFile) {
    for (const auto& [atlas, file] : {std::pair(&earlier, &earlierFile), std::pair(&now, &nowFile)}) {
        if (!atlas->isFinished)
            return planet::badInput(
                fmt::format("{}: is not finished; expected a finished survey", file->string()));
    }
    if (earlier.survey.radiusM != now.survey.radiusM) {
        return planet::badInput(fmt::format(
            "{}: is of a planet with a radius of {:g} m; expected {:g} m, that of {}", earlierFile.string(),
            earlier.survey.radiusM, now.survey.radiusM, nowFile.filename().string()));
    }
    Result<AtlasDiff> diff = diffOf(earlier, now, {});
    if (!diff) {
        return planet::badInput(fmt::format(
            "{}: {}; expected a survey of the same viewpoints as {}, as Survey again or worldy atlas "
            "--diff makes it",
            earlierFile.string(), diff.error().message, nowFile.filename().string()));
    }
    ui::AtlasComparison comparison;
    comparison.earlier = earlierFile.filename().string();
    comparison.diff = *std::move(diff);
    comparison.changes = planet::changesOf(earlier.viewpoints, now.viewpoints);
    comparison.cells = planet::changedCellsOf(now.survey.grid, comparison.changes);
    comparison.settings = differencesOf(earlier.survey, now.survey);
    return comparison;
}

ViewSettings settingsToLookWith(const ViewSettings& now, const ViewSettings& surveyed) {
    ViewSettings view = now;
    view.lod = surveyed.lod;
    view.budget = surveyed.budget;
    view.paging.budgetMB = surveyed.paging.budgetMB;
    view.camera.fovDeg = surveyed.camera.fovDeg;
    view.surface.exaggeration = surveyed.surface.exaggeration;
    view.surface.sea = surveyed.surface.sea;
    view.surface.seaLevelM = surveyed.surface.seaLevelM;
    return view;
}

ui::AtlasView atlasViewOf(const AtlasController& controller, const OpenPlanet* open) {
    ui::AtlasView view;
    view.problem = controller.problem;
    if (controller.job) {
        view.running = true;
        view.cancelling = controller.job->cancelling();
        view.progress = controller.job->progress();
        view.surveyed = controller.files.planet;
    }
    if (!controller.atlas) return view;
    view.atlas = &*controller.atlas;
    view.name = controller.file.filename().string();
    view.cells = controller.cells;
    view.spreads = controller.spreads;
    view.drape = &controller.drape;
    view.altitude = controller.altitude;
    view.comparison = controller.comparison ? &*controller.comparison : nullptr;
    view.comparisonProblem = controller.comparisonProblem;
    if (!open) return view;
    const planet::AtlasSurvey& survey = controller.atlas->survey;
    const std::string shown = open->data.chunkFile.filename().string();
    if (survey.radiusM != open->scene.planet->tree().shape.radiusM)
        view.otherBake = fmt::format("It is of a planet with a radius of {:g} m.", survey.radiusM);
    else if (survey.bake != shown)
        view.otherBake = fmt::format("It is of {}; {} is open.", survey.bake, sourceName(open->data.source));
    return view;
}

}  // namespace worldy
