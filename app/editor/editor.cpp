#include "app/editor/editor.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "app/base/process_memory.h"
#include "app/base/stopwatch.h"
#include "app/editor/editor_panels.h"
#include "app/editor/item_map_file.h"
#include "app/editor/pictures.h"
#include "app/session/allocations.h"
#include "app/session/overloaded.h"
#include "app/session/shortcuts.h"
#include "app/settings/camera_text.h"
#include "planet/planet_tools.h"
#include "planet/source/terrain.h"
#include "planet/spans/span_recorder.h"

namespace worldy {

namespace {

// Creates commands for files dropped onto the window. They are colour images if the Bake panel accepted drops
// in the last frame. Of other files, the user is asked about those that could become a layer of the planet, and the rest
// are opened.
void takeDrops(const Window& window, ui::BakePanelState& panel, SourceController& sources,
               ui::Commands& commands) {
    const bool dropsAreColours = std::exchange(panel.colour.takesDrops, false);
    for (const std::filesystem::path& file : window.droppedFiles()) {
        if (dropsAreColours)
            commands.push_back(ui::ChooseColourImage{file});
        else if (!takeDroppedFile(sources, file))
            commands.push_back(ui::OpenFile{file});
    }
}

}  // namespace

Editor::Editor(const Settings& settings, const std::filesystem::path& settingsFile, const Log& log)
    : notices_{log}, files_(openFileController()), layers_(openLayers()) {
    settings_.settings = settings;
    settings_.file = settingsFile;
    camera_.bookmarks = loadBookmarks(bookmarksFile());
    if (!camera_.bookmarks.problem.empty())
        tellError(notices_, {"The bookmarks cannot be read", camera_.bookmarks.problem, ""});
    readKeys(window_, notices_);
    for (const NamedLayout& layout : settings_.layouts.layouts())
        if (!layout.workspace)
            tellError(notices_, {"A layout cannot be read", layout.workspace.error().message, ""});
    camera_.flights = availableFlights();
    recording_ = openRecordings(recordingsFolder());
}

CameraContext Editor::cameraContext(const Scene* scene) {
    return {scene,
            settings_.settings,
            instruments_.pops.side,
            frames_.stepOnce,
            frames_.paused,
            recording_.replay ? &recording_.replay->controls : nullptr,
            settings_.file};
}

ReplayContext Editor::replayContext() {
    return {settings_.settings, camera_, paging_, frames_, instruments_, compare_};
}

WindowContent Editor::windowContent(const Session& session) const {
    return {session, settings_.settings, camera_, compare_, viewport_};
}

Settings Editor::settings() const {
    Settings settings = settings_.settings;
    if (!replaying()) settings.view = ungoverned(settings_, std::move(settings.view));
    return settings;
}

void Editor::endFlights(Session& session) {
    Scene* scene = shownScene(session);
    endReplay(recording_, scene, replayContext());
    stopRecording(recording_, scene ? scene->planet.get() : nullptr, notices_.log);
}

int Editor::frameLimit() const {
    return frames_.fullSpeed ? 0 : settings_.settings.workspace.preferences.frameLimit;
}

void Editor::rest(const Window& window, const Session& session) {
    frames_.recorder.endFrame();
    restWhileStill(window, session);
    const double limitS = frames_.pace.limitS(frames_.clock.elapsedS(), frameLimit());
    // Things move on during this wait, so it is part of the frame's time.
    if (limitS <= 0) return;
    const planet::SpanScope span("frame limit");
    std::this_thread::sleep_for(std::chrono::duration<double>(limitS));
}

void Editor::restWhileStill(const Window& window, const Session& session) {
    frames_.restedS = 0;
    FramePace& pace = frames_.pace;
    pace.noteFrame(frames_.activity.kind, frames_.timeS);
    if (window.waitForInput(0) || hasDeviceInput(camera_, window)) pace.noteInput(frames_.timeS);
    if (!settings_.settings.workspace.preferences.idle || frames_.fullSpeed) return;
    // A script asks for the frames that it waits for, so that the processor is free for it between them.
    const bool isScripted = !window_.itemMapFile.empty();
    const auto frameIsAsked = [&] { return isScripted && frames_.frame < askedFrame(window_.itemMapFile); };
    const double restS = isScripted ? scriptedRestS(frames_.activity.kind) : pace.restS(frames_.timeS);
    if (restS <= 0) return;
    const planet::SpanScope span("rest");
    const Stopwatch watch;
    // At what no event announces. Devices that steer must be read often.
    const double lookS = isScripted ? 0.005 : camera_.devices.empty() ? 0.25 : 0.02;
    while (watch.elapsedS() < restS && !window.closing() && !shadersHaveChanged(session) && !frameIsAsked()) {
        const bool hasInput = window.waitForInput(std::min(restS - watch.elapsedS(), lookS));
        if (!hasInput && !hasDeviceInput(camera_, window)) continue;
        pace.noteInput(frames_.timeS + watch.elapsedS());
        break;
    }
    frames_.restedS = watch.elapsedS();
}

void Editor::runFrame(Window& window, Session& session, double secondsSinceLast) {
    frames_.recorder.beginFrame(frames_.frame);
    std::optional<planet::SpanScope> part;  // of the frame, for the timeline
    part.emplace("input");
    Workspace& workspace = settings_.settings.workspace;
    notices_.timeS = frames_.timeS += secondsSinceLast;
    // Nothing moved while the window rested, and no frame was drawn.
    const double movedS = std::max(secondsSinceLast - frames_.restedS, 0.0);
    window.setTheme(workspace.preferences.theme, workspace.preferences.scale);
    window.waitForMonitor(workspace.preferences.vsync && !frames_.fullSpeed);
    // Frames wait for input during a bake of which at most a coarse first look is shown, because it needs the cores, and
    // during a sweep, whose frame times they would disturb.
    const OpenPlanet* const open = shownPlanet(session);
    const bool waitsForBake = !open || (open->isFirstLook && session.bake);
    followSecondWindow(window, settings_.settings, notices_);
    window.beginFrame(waitsForBake || sweep_.job ? 0.05 : 0);
    if (window.closing() && !mayQuit(settings_, {}, replaying(), notices_)) window.keepOpen();
    const std::vector<GamepadButton> buttons = readDevices(camera_, window);
    const float pixelRatio = window.pixelRatio();
    const ui::Layout layout = layoutIn(window, workspace);
    layOut(viewport_, layout.viewport, settings_.settings.view.camera.observer, pixelRatio);
    std::vector<ui::ItemPlace> items;
    ui::collectItems(window_.itemMapFile.empty() ? nullptr : &items);

    ui::Commands commands;
    ui::beginExports(window_.exports, commands);
    if (advanceReport(window_.report)) ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
    part.emplace("jobs");
    takeDrops(window, window_.panels.bake, bakes_.sources, commands);
    advanceSession(session, settings_.settings.view, notices_.log);
    advanceFiles(files_, session, notices_);
    advanceEstimate(bakes_.estimator);
    advancePreview(bakes_.preview);
    advanceSweep(sweep_, notices_.log);
    advanceAtlas(instruments_.atlas, notices_.log);
    advanceSuggest(instruments_.suggest, notices_.log);
    takeUpSession(session, commands);
    advanceNotes(files_.notes, shownPlanet(session), frames_.timeS, notices_);
    advanceTrace(files_.trace, movedS, notices_.log);
    succeeded(notices_, reloadChangedShaders(session, notices_.log), "The shaders were not reloaded");
    advanceSources(bakes_.sources, {shownPlanet(session), settings_.settings, chunks_.focus, viewport_.main},
                   notices_.log);
    tellProblems(session);
    FrameStats stats;
    part.emplace("planet");
    if (shownPlanet(session) && !replaying()) followRegions(settings_, shownPlanet(session)->data, notices_);
    if (Scene* scene = shownScene(session)) stats = runPlanet(*scene, movedS, commands);

    part.emplace("panels");
    const Stopwatch panelWatch;
    const std::size_t newLines = notices_.log.moveNewLines(window_.logLines);
    alertOf(notices_, window_.logLines, newLines);
    const ViewSettings before = settings_.settings.view;
    const ui::EditorView shown = view(session);
    drawPanels(window_, {session, shown, layout, settings_.settings, viewport_, files_.dialog, notices_},
               commands);
    const ui::ActionContext actions{shown,   settings_.settings.view, workspace, window_.menu, window_.keys,
                                    commands};
    obeyShortcuts(window.pressedKeys(), actions);
    obeyButtons(buttons, actions);
    // A replay keeps its own.
    const double fovDeg = settings_.settings.view.camera.fovDeg;
    if (fovDeg != before.camera.fovDeg && !replaying())
        showBriefly(notices_, fmt::format("Field of view {:.1f}°", fovDeg));
    if (const auto click = std::exchange(window_.menu.mouse, std::nullopt))
        window.pressMouse({click->x, click->y}, click->button);
    if (const std::string why = std::exchange(window_.menu.refused, {}); !why.empty()) refuse(notices_, why);
    // A replay's settings are not the user's, so they are not recorded for undo.
    if (!replaying())
        settings_.undo.record(ungoverned(settings_, before), ungoverned(settings_, settings_.settings.view),
                              ImGui::IsAnyItemActive(), frames_.timeS);
    ui::endExports();
    execute(commands, window, session);
    stats.panelsMs = panelWatch.elapsedMs();
    part.reset();  // the window has parts of its own
    ui::collectItems(nullptr);

    window.endFrame([&] {
        savePlots(window_, window, notices_);
        if (window_.report.isWanted)
            keepReport(window_, window, windowContent(session), view(session), notices_);
        keepScreenshot(window_, window, windowContent(session), notices_);
    });
    stats.panelsGpuMs = window.panelsGpuMs();
    stats.presentMs = window.presentMs();
    stats.frameMs = 1000 * movedS;
    stats.processBytes = residentProcessBytes();
    finishFrame(frames_, stats);
    watchAllocations(session);
    frames_.activity = activity(session, stats);
    frames_.lastView = viewport_.main.view;
    frames_.lastObserverView = viewport_.observer.view;
    ++frames_.frame;
    if (window_.itemMapFile.empty()) return;
    const CounterSources sources{session, frames_, camera_, chunks_.focus, recording_, sweep_, compare_};
    writeItemMap(window_.itemMapFile, items, countersOf(sources, stats, window.queuedInput()));
}

void Editor::resume(const LastSession& session, const KeptResults& results, const std::string& problem) {
    files_.atStart = session;
    restoreResults(sweep_, results, notices_.log);
    restoreResults(compare_.flight, results, notices_.log);
    if (!problem.empty()) tell("Not all is as it was left", problem);
}

void Editor::tell(const std::string& title, const std::string& problem) {
    tellError(notices_, {title, problem, ""});
}

std::optional<KeptResults> Editor::keptResults() const {
    if (sweep_.job || compare_.flight.job) return std::nullopt;
    KeptResults kept;
    keepResults(sweep_, kept);
    keepResults(compare_.flight, kept);
    return kept;
}

LastSession Editor::lastSession(const Session& session) const {
    const OpenPlanet* const open = shownPlanet(session);
    LastSession last{.file = (open ? open->data : session.data).source};
    // The next start may be in another folder. The text of a terrain is no path.
    if (!planet::isTerrainText(last.file)) last.file = std::filesystem::absolute(last.file);
    if (camera_.rig) last.camera = roundedPose(poseOf(camera_.rig->camera, camera_.radiusM));
    if (files_.trace.document && !files_.trace.isLive) {
        last.trace = files_.trace.document->file();
        last.traceFrame = files_.trace.playback.frame;
        const TraceCompareRun& run = files_.trace.compare;
        const TraceCompareRequest compared = run.job      ? run.request
                                             : run.result ? run.result->request
                                                          : TraceCompareRequest{};
        if (compared.fileA == last.trace) last.traceB = compared.fileB;
    }
    if (open) {
        const DataSet& data = open->data;
        if (!open->isFirstLook && data.chunkFile != data.source) {
            last.bake = std::filesystem::absolute(data.chunkFile);
            last.sourceSettings = open->baked.sourceSettings;
            last.colour = data.bakedColour;
        }
        last.ruler = rulerPlaces(instruments_.ruler, open->scene.planet->tree().shape.radiusM);
        if (compare_.other) last.compare = lastComparisonOf(*compare_.other, *open);
    }
    // They are taken up once the whole planet is there.
    if (!files_.atStart.ruler.empty()) last.ruler = files_.atStart.ruler;
    if (files_.atStart.compare && !last.compare) last.compare = files_.atStart.compare;
    return last;
}

void Editor::takeUpSession(const Session& session, ui::Commands& commands) {
    LastSession& last = files_.atStart;
    if (!last.trace.empty())
        commands.push_back(ui::OpenTrace{std::exchange(last.trace, {}), !last.file.empty(), last.traceFrame});
    if (!last.traceB.empty())
        commands.push_back(ui::StartTraceCompare{.fileB = std::exchange(last.traceB, {}), .isShown = false});
    if (!camera_.rig || !shownScene(session)) return;
    if (last.camera) commands.push_back(ui::MoveCamera{*std::exchange(last.camera, {})});
    const OpenPlanet& open = *shownPlanet(session);
    if (open.isFirstLook) return;
    if (!last.ruler.empty())
        setRulerPlaces(instruments_.ruler, std::exchange(last.ruler, {}),
                       open.scene.planet->tree().shape.radiusM);
    const std::optional<LastComparison> compare = std::exchange(last.compare, {});
    if (!compare || compare_.other) return;
    const planet::Result<void> resumed = resumeCompare(compare_, session, *compare, settings_.settings.view);
    succeeded(notices_, resumed, "The comparison of the last session was not resumed");
}

// Call when another planet is shown: the camera stays if possible, measurements are discarded.
void Editor::meetPlanet(Scene& scene) {
    if (scene.identity == frames_.lastScene) return;
    // Recording and replay refer to the previous planet, which may no longer exist.
    stopRecording(recording_, nullptr, notices_.log);
    endReplay(recording_, nullptr, replayContext());
    scene.planet->tools().keepMoves(false);
    worldy::meetPlanet(camera_, scene.planet->tree().shape.radiusM);
    forgetPlanet(instruments_);
    frames_.lastScene = scene.identity;
    frames_.history = {};
    forgetCosts(settings_.governing);
    frames_.stepOnce = true;  // the new planet needs a first selection
}

// Runs the planet's part of a frame: moves cameras, selects and loads chunks, draws pictures. Returns its
// counters and times. Appends commands from pointing at chunks.
FrameStats Editor::runPlanet(Scene& scene, double seconds, ui::Commands& commands) {
    const ViewSettings& settings = settings_.settings.view;
    meetPlanet(scene);
    // A paused frame does not step, but it draws.
    scene.drawCpuMs = 0;
    scene.drawn = {};
    viewport_.shaderWait = window_.screenshotPending || window_.report.isWanted
                               ? planet::gl::ShaderWait::UntilReady
                               : planet::gl::ShaderWait::Never;
    if (!replaying()) {
        governFrame(settings_, frames_, *scene.planet, seconds);
        giveSettings(recording_, scene, settings, paging_.paused, notices_.log);
    }
    placeCameras(camera_, scene, viewport_, settings_.settings);
    const FrameStep step = takeStep(frames_, seconds);
    movePlanet(scene, step);
    if (step.goesOn)
        frames_.recorder.noteStep(*scene.planet, instruments_.changes, instruments_.pops.meter,
                                  frames_.timeS);
    if (settings.overlay.notes)
        coverPins(files_.notes, *scene.planet, viewport_.main.view, settings.surface.exaggeration);
    advanceErrorMeter(*scene.planet, frames_.frame, instruments_.errors);
    advanceRuler(*scene.planet, frames_.timeS, instruments_.ruler);
    stepCompared(compare_,
                 {scene, settings, camera_.lodView, mainView(camera_, viewport_, settings.camera),
                  frames_.timeS, frames_.frame, camera_.jumped, step.goesOn, paging_.paused},
                 notices_.log);
    const planet::SpanScope span("pictures");
    const Stopwatch watch;
    drawPictures(scene);
    advanceInstruments(
        instruments_,
        {scene, viewport_.main, settings_.settings, chunks_.focus, frames_.frame, frames_.timeS},
        notices_.log, commands);
    if (isShown(settings_.settings.workspace, PanelId::Surface))
        readLayers(layers_, scene, viewport_.main, settings.surface);
    const bool placesEnds = instruments_.ruler.takesClicks;
    chunks_.pointedM.reset();
    pick(viewport_.main, scene, {0, placesEnds}, chunks_, commands);
    pick(viewport_.observer, scene, {observerSelection(scene, viewport_, settings.camera), placesEnds},
         chunks_, commands);
    FrameStats stats = statsOf(scene);
    stats.overlaysMs = std::max(watch.elapsedMs() - stats.drawCpuMs, 0.0);
    stats.targetBytes = gpuBytes(viewport_) + gpuBytes(compare_);
    if (!replaying()) stats.budget = settings_.governing.use;
    return stats;
}

void Editor::movePlanet(Scene& scene, const FrameStep& step) {
    if (step.goesOn)
        moveCameras(camera_, scene, viewport_, settings_.settings, replaying(), step.seconds, notices_);
    if (replaying()) {
        replayFrame(recording_, scene, replayContext(), step.goesOn ? step.seconds : 0, notices_);
    } else if (step.goesOn) {
        chooseChunks(scene, step);
        if (recordFrame(recording_, *scene.planet, notices_.log)) {
            camera_.flights = availableFlights();
            show(notices_,
                 "The recording is full. It was stopped and saved: " + recording_.savedFile.string());
        }
    }
}

void Editor::chooseChunks(Scene& scene, const FrameStep& step) {
    const ViewSettings& settings = settings_.settings.view;
    Pops& pops = instruments_.pops;
    followCamera(camera_, viewport_, settings.camera, std::max(frames_.timeS - pops.meter.lastTimeS(), 0.0));
    announceCamera(camera_, scene, settings, recording_.recorder ? &*recording_.recorder : nullptr);
    if (observerChooses(viewport_, settings.camera))
        stepScene(scene, camera_.lodView, observerView(camera_, viewport_, settings.camera), settings,
                  step.elapsedS);
    else
        stepScene(scene, camera_.lodView, settings, step.elapsedS);
    const planet::SpanScope span("measure pops");
    instruments_.changes.add(scene.planet->selection(), frames_.timeS);
    measurePops(scene, mainView(camera_, viewport_, settings.camera), frames_.timeS, camera_.jumped, pops);
}

void Editor::drawPictures(Scene& scene) {
    const ViewSettings& settings = settings_.settings.view;
    const PictureInput input{scene,
                             settings,
                             camera_,
                             chunks_.focus,
                             tintDataOf(bakes_.sources),
                             bakes_.sources.reader.layers.get(),
                             files_.trace,
                             regionDraft(window_.panels.regions, settings_.settings, chunks_.pointedM)};
    drawMainPicture(viewport_, input, instruments_, compare_.other.has_value(), notices_.log);
    const bool counting = settings.compare.mode == CompareMode::Difference ||
                          isShown(settings_.settings.workspace, PanelId::Compare);
    drawCompared(compare_, viewport_, settings, chunks_.focus, counting && !scene.drawn.standIn,
                 notices_.log);
    drawObserverPicture(viewport_, input, instruments_, notices_.log);
}

// Returns what can make the next frame differ from the one just drawn, apart from input.
FrameActivity Editor::activity(const Session& session, const FrameStats& stats) const {
    const auto isLoading = [&](const Scene* scene) {
        return scene && !frames_.paused && !paging_.paused && !scene->planet->settled();
    };
    const auto isReadingColours = [](const Scene* scene) { return scene && scene->colourReading; };
    const TraceController& trace = files_.trace;
    const std::array<std::pair<bool, FrameActivity>, 16> activities = {{
        {ImGui::IsAnyMouseDown(), {Activity::Motion, "a mouse button is held"}},
        {!(frames_.lastView == viewport_.main.view && frames_.lastObserverView == viewport_.observer.view),
         {Activity::Motion, "the camera moves"}},
        {isLoading(shownScene(session)), {Activity::Motion, "chunks load"}},
        {compare_.other && isLoading(&compare_.other->planet.scene), {Activity::Motion, "chunks of B load"}},
        {!frames_.paused && stats.selection.fading > 0, {Activity::Motion, "levels fade"}},
        {!frames_.paused && !replaying() && isSettling(settings_.governing),
         {Activity::Motion, "the tolerance follows a budget"}},
        {isReadingColours(shownScene(session)) ||
             (compare_.other && isReadingColours(&compare_.other->planet.scene)),
         {Activity::Motion, "the colour image is read"}},
        {stats.render.standIn || (compare_.other && compare_.other->stats.render.standIn),
         {Activity::Motion, "shaders are compiled"}},
        {recording_.recorder.has_value(), {Activity::Motion, "a flight is recorded"}},
        {recording_.replay && (recording_.replay->controls.playing || recording_.replay->seek),
         {Activity::Motion, "a flight is replayed"}},
        {instruments_.costs.meter.has_value(), {Activity::Motion, "costs are measured"}},
        {window_.screenshotPending.has_value(), {Activity::Motion, "a screenshot waits"}},
        {trace.playback.playing || (trace.document && trace.document->isBusy()) ||
             (trace.isLive && trace.playback.newest &&
              trace.status.state == planet::TraceLinkState::Receiving),
         {Activity::Motion, "a trace plays"}},
        {trace.link || trace.whatIf.job, {Activity::Background, "a trace is read"}},
        {session.bake || !session.ending.empty(), {Activity::Background, "a bake runs"}},
        {runningJobs() > 0, {Activity::Background, "work in the background goes on"}},
    }};
    const auto found = std::ranges::find_if(activities, [](const auto& one) { return one.first; });
    return found != activities.end() ? found->second : FrameActivity{};
}

// Gathers the data that panels may read. It refers to the session and the controllers and is valid for the
// frame.
ui::EditorView Editor::view(Session& session) {
    const ViewSettings& settings = settings_.settings.view;
    const planet::View& view = viewport_.main.view;
    const Scene* scene = camera_.rig ? shownScene(session) : nullptr;
    ui::InstrumentsView instruments = instrumentsViewOf(instruments_, scene, view, settings, frames_.frame);
    instruments.atlas = atlasViewOf(instruments_.atlas, shownPlanet(session));
    instruments.suggest = suggestViewOf(instruments_.suggest, shownPlanet(session));
    return {.planet = scene ? scene->planet.get() : nullptr,
            .frames = framesViewOf(frames_, frameLimit()),
            .log = window_.logLines,
            .pagingPaused = paging_.paused,
            .focus = chunks_.focus,
            .pointedM = chunks_.pointedM,
            .data = dataViewOf(session, files_.recentShown),
            .bake = bakeViewOf(bakes_, session),
            .camera = cameraViewOf(camera_, scene, view, settings_.settings.workspace.preferences),
            .settings = settingsViewOf(settings_),
            .instruments = std::move(instruments),
            .recording = recordingViewOf(recording_),
            .compare = compareViewOf(compare_, session, settings, frames_.stats, view),
            .sweep = sweepViewOf(sweep_),
            .layers = layersViewOf(layers_, scene, settings.surface.layers),
            .sources = sourcesViewOf(bakes_.sources, session),
            .trace = traceViewOf(files_.trace),
            .notes = notesViewOf(files_.notes)};
}

// Brings the problems of work in the background in front of the user, who may have closed the panel that tells them.
void Editor::tellProblems(const Session& session) {
    const auto tell = [&](PanelId panel, const char* title, const std::string& problem) {
        tellOnce(notices_, settings_.settings.workspace, panel, title, problem);
    };
    const std::optional<planet::Error>& bake = session.bakeProblem;
    // Without a planet, the viewport tells it.
    notices_.told["The viewport"] = !session.open && session.problem ? session.problem->message : "";
    const bool isFailure = bake && session.open && bake->kind != planet::ErrorKind::Cancelled;
    tell(PanelId::Bake, "The bake failed", isFailure ? bake->message : "");
    tell(PanelId::Sweep, "The sweep has no result", sweep_.cancelled ? "" : sweep_.problem);
    tell(PanelId::Atlas, "The planet was not surveyed",
         instruments_.atlas.cancelled ? "" : instruments_.atlas.problem);
    tell(PanelId::Suggest, "No settings were searched",
         instruments_.suggest.cancelled ? "" : instruments_.suggest.problem);
    tell(PanelId::Compare, "There is no comparison", compare_.problem);
    tell(PanelId::Compare, "The flight was not compared",
         compare_.flight.cancelled ? "" : compare_.flight.problem);
    tell(PanelId::Flight, "The recording was not saved", recording_.saveProblem);
    tell(PanelId::Sources, "The source cannot be read", bakes_.sources.reader.problem);
    tell(PanelId::Trace, "The trace has a fault", files_.trace.reported);
    const TraceCompareRun& traces = files_.trace.compare;
    tell(PanelId::TraceFindings, "The traces were not compared", traces.isCancelled ? "" : traces.problem);
}

void Editor::execute(const ui::Commands& commands, const Window& window, Session& session) {
    // Hovering is requested in every frame in which the pointer is over a chunk.
    chunks_.focus.hovered.reset();
    for (const ui::Command& command : commands) {
        if (const auto* move = command.as<ui::MoveCamera>()) noteMove(window_, *move, camera_.bookmarks.list);
        execute(command, window, session);
    }
}

void Editor::execute(const ui::Command& command, const Window& window, Session& session) {
    Scene* const scene = shownScene(session);
    ViewSettings& settings = settings_.settings.view;
    const CameraContext camera = cameraContext(scene);
    ui::Commands next;
    std::visit(
        Overloaded{
            [&](const ui::ChunkCommand& c) { worldy::execute(chunks_, c, scene, camera_, camera); },
            [&](const ui::CameraCommand& c) { worldy::execute(camera_, c, camera, notices_); },
            [&](const ui::PagingCommand& c) {
                Recorder* const recorder = recording_.recorder ? &*recording_.recorder : nullptr;
                worldy::execute(paging_, c, scene, recorder, replaying(), notices_.log);
            },
            [&](const ui::FrameCommand& c) { worldy::execute(frames_, c); },
            [&](const ui::FileCommand& c) {
                const auto* const file = std::get_if<ui::OpenFile>(&c);
                if (file && file->asks && takeDroppedFile(bakes_.sources, file->file)) return;
                worldy::execute(files_, c, {session, settings_, camera_, replaying()}, notices_, next);
            },
            [&](const ui::BakeCommand& c) {
                worldy::execute(bakes_, c, session, window_.panels.bake, notices_.log);
            },
            [&](const ui::SettingsCommand& c) { worldy::execute(settings_, c, replaying(), notices_); },
            [&](const ui::WindowCommand& c) {
                const auto* const quit = std::get_if<ui::Quit>(&c);
                if (quit && !mayQuit(settings_, *quit, replaying(), notices_)) return;
                worldy::execute(window_, c, window, windowContent(session), notices_);
            },
            [&](const ui::LayerCommand& c) {
                worldy::execute(layers_, c, settings_, scene, replaying(), notices_);
            },
            [&](const ui::InstrumentCommand& c) {
                worldy::execute(instruments_, c,
                                {scene, settings, viewport_.main.view, chunks_.focus, camera_, camera},
                                notices_);
            },
            [&](const ui::RecordingCommand& c) {
                worldy::execute(recording_, c, scene, replayContext(), notices_);
            },
            [&](const ui::SweepCommand& c) { worldy::execute(sweep_, c, session, settings, notices_); },
            [&](const ui::CompareCommand& c) {
                const planet::View* const view = camera_.rig ? &viewport_.main.view : nullptr;
                worldy::execute(compare_, c, {session, settings_, view, frames_.stepOnce, replaying()},
                                notices_);
            },
            [&](const ui::SourceCommand& c) {
                worldy::execute(bakes_.sources, c, shownPlanet(session), settings_.settings.workspace,
                                notices_, next);
            },
            [&](const ui::TraceCommand& c) {
                const std::optional<double> radiusM =
                    scene ? std::optional(scene->planet->tree().shape.radiusM) : std::nullopt;
                worldy::execute(files_.trace, c, settings_.settings.workspace, radiusM, notices_, next);
            },
            [&](const ui::SuggestCommand& c) {
                worldy::execute(instruments_.suggest, c, {session, settings_, replaying()}, notices_);
            },
            [&](const ui::AtlasCommand& c) {
                worldy::execute(instruments_.atlas, c,
                                {shownPlanet(session), settings_, camera_, camera, replaying()}, notices_);
            },
            [&](const ui::NoteCommand& c) {
                worldy::execute(files_.notes, c, settings_.settings.workspace, notices_);
            },
        },
        command.feature());
    for (const ui::Command& one : next) execute(one, window, session);
}

std::size_t Editor::runningJobs() const {
    const SourceController& sources = bakes_.sources;
    return std::size_t{instruments_.errors.job != nullptr} + std::size_t{compare_.flight.job != nullptr} +
           std::size_t{sweep_.job != nullptr} + std::size_t{bakes_.estimator.job != nullptr} +
           std::size_t{bakes_.preview.job != nullptr} + std::size_t{sources.reader.job != nullptr} +
           std::size_t{sources.queries.job != nullptr} + std::size_t{sources.depths.job != nullptr} +
           std::size_t{instruments_.ruler.job != nullptr} + std::size_t{instruments_.atlas.job != nullptr} +
           std::size_t{instruments_.suggest.job != nullptr} + sources.reader.ending.size();
}

void Editor::watchAllocations(const Session& session) {
    const AllocationSources sources{
        .session = session,
        .other = compare_.other ? &compare_.other->planet.scene : nullptr,
        .timeS = frames_.timeS,
        .targetBytes = gpuBytes(viewport_) + gpuBytes(compare_),
        .logLines = window_.logLines.size(),
        .frameSamples = frames_.history.samples.size(),
        .recordedBytes = recording_.recorder ? recording_.recorder->encoded().bytes() : 0,
        .jobs = runningJobs()};
    const bool wanted = isShown(settings_.settings.workspace, PanelId::Frame);
    worldy::watchAllocations(sources, wanted, std::exchange(instruments_.markAllocations, false),
                             instruments_.allocations);
}

}  // namespace worldy
