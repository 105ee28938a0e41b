#include "app/editor/atlas_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
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
#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_file.h"
#include "planet/measure/atlas_sampling.h"
#include "ui/model/atlas_view.h"
#include "ui/model/commands.h"

namespace worldy {

namespace {

using planet::Result;

void drapeAgain(AtlasController& controller) {
    controller.drape = drapeOf(controller.cells, controller.measure, controller.altitude);
}

void showAtlas(AtlasController& controller, planet::Atlas atlas, const std::filesystem::path& file) {
    const auto isMeasured = [&](planet::AtlasMeasure measure) {
        return std::ranges::any_of(spreadsOf(atlas.viewpoints),
                                   [&](const AtlasSpread& one) { return one.measure == measure; });
    };
    if (!isMeasured(controller.measure)) controller.measure = planet::AtlasMeasure::EpsPx;
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

void startAtlas(AtlasController& controller, const ui::StartAtlas& start, const AtlasContext& context,
                Notices& notices) {
    if (!context.open || controller.job) return;
    const Result<std::filesystem::path> file =
        newTimedFile(picturesFolder(), localTimeNow(), "atlas", "atlas");
    if (!file) return tellError(notices, {"The planet was not surveyed", file.error().message, ""});
    AtlasRequest request;
    request.file = context.open->data.chunkFile;
    request.output = *file;
    request.view = context.settings.settings.view;
    setUsualDisk(request.view.paging.badDisk);
    request.grid.most = start.viewpoints;
    request.measuresError = start.measuresError;
    request.threads = static_cast<std::size_t>(backgroundThreads());
    controller.problem.clear();
    controller.cancelled = false;
    controller.surveyFile = *file;
    controller.job = std::make_unique<AtlasJob>(std::move(request));
    notices.log->info("Surveying {}", context.open->data.chunkFile.string());
}

void lookFrom(const AtlasController& controller, std::size_t viewpoint, const AtlasContext& context,
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
}

void removeFile(const std::filesystem::path& file) {
    std::error_code status;
    std::filesystem::remove(file, status);
}

}  // namespace

void execute(AtlasController& controller, const ui::AtlasCommand& command, const AtlasContext& context,
             Notices& notices) {
    std::visit(
        Overloaded{
            [&](const ui::OpenAtlas& open) { openAtlas(controller, open.file, notices); },
            [&](const ui::StartAtlas& start) { startAtlas(controller, start, context, notices); },
            [&](const ui::CancelAtlas&) {
                if (controller.job) controller.job->cancel();
            },
            [&](const ui::ChooseAtlas& chosen) {
                controller.measure = chosen.measure;
                controller.altitude = chosen.altitude;
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
    if (*result) {
        log->info("Surveyed {} viewpoints: {}", (*result)->atlas.viewpoints.size(),
                  controller.surveyFile.string());
        return showAtlas(controller, std::move((*result)->atlas), controller.surveyFile);
    }
    // The name was taken by an empty file.
    removeFile(controller.surveyFile);
    removeFile(planet::unfinishedAtlas(controller.surveyFile));
    controller.cancelled = result->error().kind == planet::ErrorKind::Cancelled;
    controller.problem = controller.cancelled ? "The survey was cancelled." : result->error().message;
    log->log(controller.cancelled ? spdlog::level::warn : spdlog::level::err, "{}", controller.problem);
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
    }
    if (!controller.atlas) return view;
    view.atlas = &*controller.atlas;
    view.name = controller.file.filename().string();
    view.cells = controller.cells;
    view.drape = &controller.drape;
    view.altitude = controller.altitude;
    if (!open) return view;
    const planet::AtlasSurvey& survey = controller.atlas->survey;
    const std::string shown = open->data.chunkFile.filename().string();
    if (survey.radiusM != open->scene.planet->tree().shape.radiusM)
        view.otherBake = fmt::format("It is of a planet with a radius of {:g} m.", survey.radiusM);
    else if (survey.bake != shown)
        view.otherBake = fmt::format("It is of {}; {} is open.", survey.bake, shown);
    return view;
}

}  // namespace worldy
