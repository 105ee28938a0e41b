#include "app/editor/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/base/places.h"
#include "app/editor/allocations.h"
#include "app/editor/bookmarks.h"
#include "app/editor/editor_actions.h"
#include "app/settings/screenshot.h"
#include "app/settings/settings_text.h"
#include "app/settings/shot_line.h"
#include "planet/planet_tools.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

using planet::Result;

constexpr int costRounds = 5;

ui::Message openingFailed(const std::filesystem::path& file, const planet::Error& error) {
    return {fmt::format("{} cannot be opened", file.filename().string()), error.message,
            fmt::format("The open planet is kept. Fix the file or open another: a "
                        "chunk file (.chk), an elevation image, a cube face, settings (.toml), a recorded "
                        "flight ({}) or one of Worldy's own screenshots (.png).",
                        recordedFlightEnding),
            true};
}

// One function a command, and what commands may change.
struct CommandHandler {
    Window& window;
    Session& session;
    Editor& editor;
    Log& log;

    // failed: what the user asked for, as the title of a message that says why it was not done.
    bool succeeded(const Result<void>& result, const std::string& failed) const {
        if (!result) tellError(editor, log, {failed, result.error().message, ""});
        return result.has_value();
    }
    void cannotOpen(const std::filesystem::path& file, const planet::Error& error) const {
        tellError(editor, log, openingFailed(file, error));
    }
    void confirm(const std::string& text) const { worldy::confirm(editor, log, text); }
    // Confirms in the viewport alone.
    void show(const std::string& text) const { editor.confirmation = {text, editor.timeS + confirmationS}; }
    void moveCamera(const Camera& camera) const {
        if (editor.rig) placeRig(*editor.rig, camera, editor.settings.view.camera);
    }
    double radiusM() const { return shownScene(session)->planet->tree().shape.radiusM; }
    planet::CameraPose pose() const { return poseOf(editor.rig->camera, radiusM()); }

    void operator()(const ui::HoverChunk& command) const { editor.focus.hovered = command.id; }
    void operator()(const ui::SelectChunk& command) const { editor.focus.selected = command.id; }
    void operator()(const ui::LookAtChunk& command) const;
    void operator()(const ui::FreezeLod& command) const {
        if (maySet()) freezeLod(editor, command.frozen);
    }
    void operator()(const ui::InspectPlace& command) const {
        if (shownScene(session) && editor.rig)
            inspect(editor, cameraFromPose(command.pose, radiusM()), command.lodView);
    }
    void operator()(const ui::EndInspection&) const { endInspection(editor); }
    void operator()(const ui::MoveCamera& command) const {
        if (shownScene(session)) moveCamera(cameraFromPose(command.pose, radiusM()));
    }
    void operator()(const ui::ResetCamera&) const {
        if (shownScene(session))
            moveCamera(cameraFromPose(startPose(editor.settings.camera, radiusM()), radiusM()));
    }
    void operator()(const ui::KeepCameraAsStart&) const;
    void operator()(const ui::AddBookmark& command) const;
    void operator()(const ui::RemoveBookmark& command) const;
    void operator()(const ui::SetSpeedFactor& command) const {
        if (editor.rig) {
            editor.rig->speedFactor = std::clamp(command.factor, minSpeedFactor, maxSpeedFactor);
        }
    }
    void operator()(const ui::StartFlight& command) const {
        if (editor.rig)
            succeeded(startFlight(*editor.rig, command.file, editor.settings.view.camera),
                      "The flight cannot be followed");
    }
    void operator()(const ui::MoveFlight& command) const {
        if (editor.rig) moveFlight(*editor.rig, command.timeS);
    }
    void operator()(const ui::PauseFlight& command) const {
        if (editor.rig) pauseFlight(*editor.rig, command.paused);
    }

    void operator()(const ui::PausePaging& command) const {
        if (mayTouchPaging()) editor.pagingPaused = command.paused;
    }
    void operator()(const ui::LoadOne&) const { call(FlightCall::LoadOne, &planet::PlanetTools::loadOne); }
    void operator()(const ui::DropAll&) const { call(FlightCall::DropAll, &planet::PlanetTools::dropAll); }
    void operator()(const ui::RetryFailed& command) const {
        if (!command.block) return call(FlightCall::RetryFailed, &planet::PlanetTools::retryFailed);
        Scene* scene = shownScene(session);
        if (!scene || !mayTouchPaging()) return;
        scene->planet->tools().retryFailed(*command.block);
        if (editor.desk.recorder)
            editor.desk.recorder->called(*scene->planet, FlightCall::RetryBlock, *command.block);
    }
    // Settings of a replay are given back at its end.
    bool maySet() const {
        if (editor.desk.replay) log->warn("Settings cannot be changed during a replay");
        return !editor.desk.replay;
    }
    bool mayTouchPaging() const {
        if (editor.desk.replay) log->warn("Paging cannot be changed during a replay");
        return !editor.desk.replay;
    }
    void call(FlightCall which, void (planet::PlanetTools::*function)()) const {
        Scene* scene = shownScene(session);
        if (!scene || !mayTouchPaging()) return;
        (scene->planet->tools().*function)();
        if (editor.desk.recorder) editor.desk.recorder->called(*scene->planet, which);
    }
    void operator()(const ui::PauseFrames& command) const { editor.framesPaused = command.paused; }
    void operator()(const ui::StepFrame&) const { editor.framesPaused = editor.stepOneFrame = true; }

    void operator()(const ui::OpenFile& command) const;
    void operator()(const ui::AskForFile&) const { askForFile(false); }
    void operator()(const ui::AskForColourImage&) const { askForFile(true); }
    void askForFile(bool forColours) const {
        editor.openDialog.opening = true;
        editor.openDialog.forColours = forColours;
    }
    void operator()(const ui::ChooseColourImage& command) const {
        editor.panels.bake.colour.chosen = command.file;
    }
    void operator()(const ui::StartBake& command) const { startBake(session, command.request, log); }
    void operator()(const ui::BakeAgain&) const { startBake(session, log); }
    void operator()(const ui::EstimateBake& command) const { requestEstimate(session, command.request); }
    void operator()(const ui::PreviewSource& command) const {
        requestPreview(session.preview, command.request);
    }
    void operator()(const ui::CancelBake&) const { cancelBake(session); }
    void operator()(const ui::ShowPreviousBake& command) const { showPreviousBake(session, command.shown); }
    void operator()(const ui::DismissPreviousBake&) const { dismissPreviousBake(session); }

    void operator()(const ui::Undo&) const {
        if (!maySet()) return;
        if (const auto settings = editor.undo.undo()) editor.settings.view = *settings;
    }
    void operator()(const ui::Redo&) const {
        if (!maySet()) return;
        if (const auto settings = editor.undo.redo()) editor.settings.view = *settings;
    }
    void operator()(const ui::SavePreset& command) const {
        if (succeeded(editor.presets.save(command.name, editor.settings.view), "The preset was not saved"))
            confirm(fmt::format("Preset {} saved", command.name));
    }
    void operator()(const ui::LoadPreset& command) const;
    void operator()(const ui::DeletePreset& command) const {
        if (succeeded(editor.presets.remove(command.name), "The preset was not deleted"))
            confirm(fmt::format("Preset {} deleted", command.name));
    }
    void operator()(const ui::CopyCommandLine&) const;
    void operator()(const ui::CopyText& command) const { window.setClipboard(command.text); }
    void operator()(const ui::TakeScreenshot& command) const;
    void operator()(const ui::Quit&) const { window.close(); }
    void operator()(const ui::LoadLayerSet& command) const;
    void operator()(const ui::SaveLayerSet& command) const;
    void operator()(const ui::ReloadLayerTextures&) const { forgetLayerPictures(shownScene(session)); }
    void operator()(const ui::TryCostlyParts&) const {
        if (Scene* scene = shownScene(session)) scene->turnedDown = {.fastAtS = editor.timeS};
    }
    void operator()(const ui::MarkAllocations&) const {
        editor.allocations.now = editor.allocations.mark = countAllocations(session, editor);
    }
    void operator()(const ui::MeasureCosts&) const {
        const Scene* scene = shownScene(session);
        if (!scene) return;
        Result<CostMeter> meter =
            CostMeter::create(*scene, editor.viewport.main.view, editor.settings.view, costRounds);
        if (meter)
            editor.costs.meter = std::move(*meter);
        else
            tellError(editor, log, {"The features were not measured", meter.error().message, ""});
    }
    void operator()(const ui::MeasureCracks&) const {
        Scene* scene = shownScene(session);
        if (!scene || !editor.rig) return;
        if (!succeeded(measureNow(editor.cracks, *scene, editor.viewport.main.view, editor.settings.view),
                       "The cracks were not measured"))
            editor.settings.view.cracks.live = false;  // it would only fail again
    }
    void operator()(const ui::FindSmallestSkirts&) const {
        Scene* scene = shownScene(session);
        if (!scene || !editor.rig) return;
        succeeded(findSmallestNow(editor.cracks, *scene, editor.viewport.main.view, editor.settings.view),
                  "The smallest skirts were not found");
    }

    void operator()(const ui::MeasurePops& command) const { editor.pops.measuring = command.on; }
    void operator()(const ui::ClearPops&) const { forgetPops(editor.pops); }
    void operator()(const ui::GoBackToPop& command) const;
    void operator()(const ui::ShowPopSide& command) const { editor.pops.side = command.side; }

    void operator()(const ui::MeasureErrors&) const { editor.errors.wanted = true; }
    void operator()(const ui::KeepMeasuringErrors& command) const {
        editor.errors.keepMeasuring = command.on;
    }
    void operator()(const ui::StartRecording& command) const;
    void operator()(const ui::StopRecording&) const {
        Scene* scene = shownScene(session);
        stopRecording(editor.desk, scene ? scene->planet.get() : nullptr, log);
        tellSaved();
        editor.flights = availableFlights();
    }
    // Reports what became of the recording that was just stopped; the log has it already.
    void tellSaved() const {
        const FlightDesk& desk = editor.desk;
        if (!desk.saveProblem.empty())
            editor.message = {
                "The recording was not saved", desk.saveProblem,
                desk.unwritten ? "The recording is kept: free disk space and stop it again." : ""};
        else if (!desk.saved.empty())
            show(fmt::format("Recording {} saved", desk.saved));
    }
    void operator()(const ui::DeleteRecording& command) const {
        if (succeeded(deleteRecording(editor.desk, command.file), "The recording was not deleted"))
            confirm(fmt::format("Recording {} deleted", command.file.stem().string()));
        editor.flights = availableFlights();
    }
    void operator()(const ui::StartReplay& command) const;
    void operator()(const ui::MoveReplay& command) const { moveReplay(editor.desk, command.frame); }
    void operator()(const ui::MoveReplayTo& command) const { moveReplayTo(editor.desk, command.timeS); }
    void operator()(const ui::SetReplay& command) const {
        if (Scene* scene = shownScene(session))
            succeeded(setReplay(editor.desk, *scene, command.controls), "The replay was not changed");
    }
    void operator()(const ui::StopReplay&) const { endReplay(editor, shownScene(session)); }

    void operator()(const ui::StartSweep& command) const {
        startSweep(editor.sweep, shownPlanet(session), command.request, editor.settings.view, log);
    }
    void operator()(const ui::CancelSweep&) const { cancelSweep(editor.sweep); }
    void operator()(const ui::SaveSweep& command) const {
        const Result<std::filesystem::path> plot = saveSweep(editor.sweep, command.cost, picturesFolder());
        if (plot)
            worldy::confirm(editor, log,
                            fmt::format("Sweep saved: {} (.png, .csv, .json)", plot->stem().string()),
                            fmt::format("Sweep saved: {}, with its table as .csv and .json", plot->string()));
        else
            tellError(editor, log, {"The sweep was not saved", plot.error().message, ""});
    }
    void operator()(const ui::OpenSweptChunks& command) const {
        openSweptChunks(editor.sweep, command.chunkSize, session, editor.settings.view, log);
    }

    void operator()(const ui::StartCompare& command) const {
        if (succeeded(startCompare(editor.compare, session, editor.presets, editor.settings.view, command),
                      "B cannot be shown"))
            editor.stepOneFrame = true;  // B has chosen nothing yet
    }
    void operator()(const ui::StopCompare&) const { editor.compare.ending = true; }
    void operator()(const ui::SwapCompare& command) const;
    void operator()(const ui::MeasureCompare&) const {
        Scene* scene = shownScene(session);
        if (!scene || !editor.rig) return;
        succeeded(measureCompared(editor.compare, *scene, editor.settings.view, editor.viewport.main.view),
                  "This view was not measured");
    }
    void operator()(const ui::CompareOverFlight& command) const {
        succeeded(
            compareFlight(editor.compare, session, editor.settings.view, editor.viewport.main.view, command),
            "The flight was not measured");
    }
    void operator()(const ui::CancelCompareFlight&) const {
        if (editor.compare.job) editor.compare.job->cancel();
    }

    void openPreset(const std::filesystem::path& file) const;
    bool openScreenshot(const std::filesystem::path& file) const;
};

// From right above, so far that the chunk fills about half of the picture.
void CommandHandler::operator()(const ui::LookAtChunk& command) const {
    const Scene* scene = shownScene(session);
    if (!scene) return;
    const planet::FaceSquare square = planet::faceSquareOf(command.id);
    const double half = square.side / 2;
    const glm::dvec3 middle =
        planet::sphereFromCube(planet::cubePoint(command.id.face, square.u + half, square.v + half));
    const glm::dvec3 corner = planet::sphereFromCube(planet::cubePoint(command.id.face, square.u, square.v));
    const double radius = scene->planet->tree().shape.radiusM;
    const double sizeM = 2 * radius * glm::length(corner - middle);
    const planet::Geographic place = planet::geographicFromDirection(middle);
    const double groundM = planet::residentHeightM(scene->planet->tree(), middle);
    moveCamera(cameraFromPose({.latitudeDeg = glm::degrees(place.latitudeRad),
                               .longitudeDeg = glm::degrees(place.longitudeRad),
                               .altitudeM = groundM + 1.3 * sizeM,
                               .headingDeg = 0,
                               .pitchDeg = -88},
                              radius));
}

void CommandHandler::operator()(const ui::StartRecording& command) const {
    Scene* scene = shownScene(session);
    if (!scene || !editor.rig) return;
    endReplay(editor, scene);
    if (succeeded(startRecording(editor.desk, *scene->planet, command.name), "Recording failed"))
        log->info("Recording {}: starting with the six root chunks", editor.desk.recorder->name());
    forgetChanges(editor);
    editor.stepOneFrame = true;  // nothing is chosen any more
}

void CommandHandler::operator()(const ui::SwapCompare&) const {
    if (!maySet()) return;
    const ViewSettings settings = swapCompared(editor.compare, session, editor.settings.view, log);
    editor.undo.add(editor.settings.view, settings, "swap of A and B");
    editor.settings.view = settings;
    editor.stepOneFrame = true;
}

void CommandHandler::operator()(const ui::StartReplay& command) const {
    Scene* scene = shownScene(session);
    if (!scene || !editor.rig)
        return cannotOpen(command.file,
                          {planet::ErrorKind::BadInput,
                           fmt::format("{}: no planet is open; open one first", command.file.string())});
    const bool wasRecording = editor.desk.recorder || editor.desk.unwritten;
    stopRecording(editor.desk, scene->planet.get(), log);
    if (wasRecording) tellSaved();
    endInspection(editor);
    endReplay(editor, scene);
    const BeforeReplay before{editor.settings.view, editor.rig->camera, editor.pagingPaused, editor.lodView,
                              editor.lodFrozen};
    const Result<void> started = startReplay(editor.desk, command.file, *scene, before);
    if (started)
        editor.lodFrozen = false;
    else
        cannotOpen(command.file, started.error());
    forgetChanges(editor);
    editor.stepOneFrame = true;
}

void CommandHandler::operator()(const ui::KeepCameraAsStart&) const {
    if (!shownScene(session) || !editor.rig) return;
    editor.settings.camera = pose();
    confirm("Future sessions start here");
}

void CommandHandler::operator()(const ui::AddBookmark& command) const {
    if (!shownScene(session) || !editor.rig) return;
    if (succeeded(addBookmark(editor.bookmarks, command.name, pose()), "The bookmark was not added"))
        confirm(fmt::format("Bookmark {} added", command.name));
}

void CommandHandler::operator()(const ui::RemoveBookmark& command) const {
    if (succeeded(removeBookmark(editor.bookmarks, command.name), "The bookmark was not removed"))
        confirm(fmt::format("Bookmark {} removed", command.name));
}

void CommandHandler::openPreset(const std::filesystem::path& file) const {
    if (!maySet()) return;
    const Result<ViewSettings> loaded = loadViewSettings(file, editor.settings.view);
    if (!loaded) return cannotOpen(file, loaded.error());
    editor.undo.add(editor.settings.view, *loaded, "settings of " + file.filename().string());
    editor.settings.view = *loaded;
    worldy::confirm(editor, log, fmt::format("Settings of {} loaded", file.filename().string()),
                    fmt::format("Settings of {} loaded", file.string()));
}

// False where the picture carries no settings, so is something else.
bool CommandHandler::openScreenshot(const std::filesystem::path& file) const {
    const Result<ScreenshotNote> note = readScreenshotNote(file);
    if (!note) return false;
    if (!maySet()) return true;
    const Result<Settings> settings = settingsFromText(note->settings, file, editor.settings);
    if (!settings) {
        cannotOpen(file, settings.error());
        return true;
    }
    editor.undo.add(editor.settings.view, settings->view, "settings of " + file.filename().string());
    editor.settings.view = settings->view;
    if (shownScene(session)) moveCamera(cameraFromPose(note->camera, radiusM()));
    worldy::confirm(editor, log, fmt::format("Camera and settings of {} loaded", file.filename().string()),
                    fmt::format("Camera and settings of {} loaded", file.string()));
    return true;
}

void CommandHandler::operator()(const ui::OpenFile& command) const {
    if (!planet::isTerrainText(command.file)) {
        if (command.file.extension() == ".toml") return openPreset(command.file);
        if (isFlightRecord(command.file)) return (*this)(ui::StartReplay{command.file});
        if (command.file.extension() == ".png" && openScreenshot(command.file)) return;
    }
    if (!openFile(session, command.file, editor.settings.view, log)) {
        editor.message = openingFailed(command.file, *session.problem);  // the log has it already
        return;
    }
    editor.opening = command.file;  // its bake may fail yet
}

void CommandHandler::operator()(const ui::LoadPreset& command) const {
    if (!maySet()) return;
    const Result<ViewSettings> loaded = editor.presets.load(command.name, editor.settings.view);
    if (!loaded) return tellError(editor, log, {"The preset cannot be loaded", loaded.error().message, ""});
    editor.undo.add(editor.settings.view, *loaded, "preset " + command.name);
    editor.settings.view = *loaded;
}

void CommandHandler::operator()(const ui::LoadLayerSet& command) const {
    if (!maySet()) return;
    ViewSettings loaded = editor.settings.view;
    if (!succeeded(loadInto(editor.layers, command.file, loaded.surface.layers),
                   "The layer set cannot be loaded"))
        return;
    editor.undo.add(editor.settings.view, loaded, "layer set " + command.file.stem().string());
    editor.settings.view = std::move(loaded);
}

void CommandHandler::operator()(const ui::SaveLayerSet& command) const {
    if (!maySet()) return;
    ViewSettings saved = editor.settings.view;
    if (!succeeded(saveAs(editor.layers, command.name, saved.surface.layers), "The layer set was not saved"))
        return;
    confirm(fmt::format("Layer set {} saved", command.name));
    editor.undo.add(editor.settings.view, saved, "layer set saved");
    editor.settings.view = std::move(saved);
}

std::string lineOf(const Session& session, const Editor& editor) {
    const PlanetPicture& main = editor.viewport.main;
    const double radiusM = shownScene(session)->planet->tree().shape.radiusM;
    return shotLine(shownPlanet(session)->data.chunkFile, planet::poseFromView(main.view, radiusM),
                    {main.view.widthPx, main.view.heightPx}, editor.settings.view, session.colourFile);
}

void CommandHandler::operator()(const ui::CopyCommandLine&) const {
    if (!shownScene(session) || !editor.rig) return;
    const std::string line = lineOf(session, editor);
    window.setClipboard(line);
    log->info("Copied: {}", line);
    show("Command line copied");
}

void CommandHandler::operator()(const ui::TakeScreenshot& command) const {
    editor.screenshotPending = command;
}

void CommandHandler::operator()(const ui::GoBackToPop& command) const {
    const planet::PopEvent* event = findPop(editor.pops, command.frame, command.chunk);
    if (!event || !shownScene(session) || !editor.rig) return;
    editor.pops.shown = *event;
    editor.focus.selected = event->chunk;
    inspect(editor, {event->view.eyeM, event->view.right, event->view.back}, event->view);
}

}  // namespace

void obey(const ui::Commands& commands, Window& window, Session& session, Editor& editor, Log& log) {
    const CommandHandler handler{window, session, editor, log};
    // Asked for anew each frame that the pointer is on a chunk.
    editor.focus.hovered.reset();
    for (const ui::Command& command : commands)
        std::visit([&](const auto& ofFeature) { std::visit(handler, ofFeature); }, command.feature());
}

void keepScreenshot(const Window& window, const Session& session, Editor& editor, const Log& log) {
    if (!editor.screenshotPending) return;
    const Scene* const scene = shownScene(session);
    const Scene* const other = editor.compare.other ? &editor.compare.other->planet.scene : nullptr;
    if ((scene && scene->drawn.standIn) || (other && other->drawn.standIn)) return;
    const bool withPanels = std::exchange(editor.screenshotPending, std::nullopt)->withPanels;
    const PlanetPicture& shown =
        editor.viewport.main.shown() ? editor.viewport.main : editor.viewport.observer;
    const planet::gl::RenderTarget* target = shown.shownTarget();
    if (!withPanels && !target) return;
    const Picture picture =
        withPanels ? window.readPicture() : Picture{target->widthPx(), target->heightPx(), target->readRgb()};
    ScreenshotNote note;
    note.version = WORLDY_VERSION;
    note.settings = settingsText(editor.settings);
    if (shownScene(session) && editor.rig) {
        const double radiusM = shownScene(session)->planet->tree().shape.radiusM;
        note.camera = poseOf(editor.rig->camera, radiusM);
        note.dataSet = shownPlanet(session)->data.source;
        note.shotLine = lineOf(session, editor);
    }
    const Result<std::filesystem::path> file = writeNewScreenshot(picture, note);
    if (file)
        confirm(editor, log, fmt::format("Screenshot: {}", file->filename().string()),
                fmt::format("Screenshot: {}", file->string()));
    else
        tellError(editor, log, {"The screenshot was not saved", file.error().message, ""});
}

}  // namespace worldy
