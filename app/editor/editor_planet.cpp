#include "app/editor/editor_planet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

#include "app/base/stopwatch.h"
#include "app/editor/editor_actions.h"
#include "app/measure/probe.h"
#include "app/scene/observer.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/overlay_lines.h"
#include "planet/measure/pick.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

// Another planet has taken the place of the last one: the camera stays where it makes sense, what was counted
// does not.
void meetPlanet(Scene& scene, Editor& editor, const Log& log) {
    if (scene.identity == editor.lastScene) return;
    planet::Planet& planet = *scene.planet;
    // Both are about the planet that they began with, which may be gone.
    stopRecording(editor.desk, nullptr, log);
    endReplay(editor, nullptr);
    planet.tools().keepMoves(false);
    const double radiusM = planet.tree().shape.radiusM;
    editor.beforeInspection.reset();
    if (radiusM != editor.lastRadiusM && editor.lastScene) {
        editor.rig.reset();
        editor.observer.reset();
    }
    editor.lastScene = scene.identity;
    editor.lastRadiusM = radiusM;
    editor.changes.clear();
    forgetPops(editor.pops);
    editor.probe = {};
    forgetErrors(editor.errors);
    editor.history.clear();
    editor.cracks = {};
    editor.costs = {};
    editor.stepOneFrame = true;  // something has to be chosen for it
}

// Of a picture that is not shown the size is the other's: the lod view goes on while the observer is alone.
planet::View viewOfPicture(const Camera& camera, const PlanetPicture& picture, const PlanetPicture& other,
                           float pixelRatio, const Editor& editor) {
    const PixelSize size = pixelSizeOf(picture.shown() ? picture.rect : other.rect, pixelRatio);
    return viewOf(camera, glm::radians(editor.settings.view.camera.fovDeg), size.width, size.height);
}

planet::View mainView(const Editor& editor, float pixelRatio) {
    const Viewport& viewport = editor.viewport;
    return viewOfPicture(editor.rig->camera, viewport.main, viewport.observer, pixelRatio, editor);
}

planet::View observerView(const Editor& editor, float pixelRatio) {
    const Viewport& viewport = editor.viewport;
    return viewOfPicture(editor.observer->camera, viewport.observer, viewport.main, pixelRatio, editor);
}

// Also while frames are paused: there is always something to look through.
void placeCameras(const Scene& scene, float pixelRatio, Editor& editor) {
    const double radiusM = scene.planet->tree().shape.radiusM;
    if (!editor.rig) {
        editor.rig.emplace();
        editor.rig->camera = cameraFromPose(startPose(editor.settings.camera, radiusM), radiusM);
    }
    if (editor.observer || !editor.viewport.observer.shown()) return;
    editor.observer.emplace();
    editor.observer->camera =
        observerStart(mainView(editor, pixelRatio), groundBelow(scene, editor.rig->camera.eyeM));
}

// While a flight is replayed, the observer alone.
void moveCameras(Scene& scene, float pixelRatio, Editor& editor, const Log& log, double seconds) {
    const Viewport& viewport = editor.viewport;
    const Surroundings around = surroundingsOf(scene);
    const KeyInput keys = readKeys();
    editor.rig->speedFactor =
        std::clamp(editor.rig->speedFactor * std::pow(1.5, keys.speedSteps), minSpeedFactor, maxSpeedFactor);
    // The keys go to the picture that the pointer is on.
    const bool observing =
        viewport.observer.shown() && (viewport.observer.pointer.over || !viewport.main.shown());
    planet::Result<void> moved;
    if (!editor.desk.replay)
        moved = advanceRig(*editor.rig, around, mainView(editor, pixelRatio), viewport.main.pointer,
                           observing ? HeldKeys() : keys.held, seconds, editor.settings.view.camera);
    if (!moved) log->error("{}", moved.error().message);

    if (!viewport.observer.shown()) return;
    editor.observer->speedFactor = editor.rig->speedFactor;
    // Cannot fail: it follows no flight.
    static_cast<void>(advanceRig(*editor.observer, around, observerView(editor, pixelRatio),
                                 viewport.observer.pointer, observing ? keys.held : HeldKeys(), seconds,
                                 editor.observerControls));
}

bool observerChooses(const Editor& editor) {
    return editor.viewport.observer.shown() && editor.settings.view.camera.observerOwnLod;
}

// What the observer's picture draws. The second selection is there once a frame has chosen it: not at once
// where frames are paused.
std::size_t observerSelection(const Scene& scene, const Editor& editor) {
    return observerChooses(editor) && scene.planet->views().size() > 1 ? 1 : 0;
}

// elapsedS: in place of the clock's, for single steps.
void chooseChunks(Scene& scene, float pixelRatio, Editor& editor, std::optional<double> elapsedS) {
    const glm::dvec3 fromM = editor.lodView.eyeM;
    const bool placed = takeJump(*editor.rig);
    if (!editor.lodFrozen) editor.lodView = mainView(editor, pixelRatio);
    const double passedS = std::max(editor.timeS - editor.pops.meter.lastTimeS(), 0.0);
    editor.cameraJumped =
        editor.lodView.eyeM != fromM &&
        (placed || isCameraJump(fromM, editor.lodView.eyeM, scene.planet->tree().shape.radiusM, passedS));
    if (observerChooses(editor))
        stepScene(scene, editor.lodView, observerView(editor, pixelRatio), editor.settings.view, elapsedS);
    else
        stepScene(scene, editor.lodView, editor.settings.view, elapsedS);
    editor.changes.add(scene.planet->selection(), editor.timeS);
    measurePops(scene, mainView(editor, pixelRatio), editor.timeS, editor.cameraJumped, editor.pops);
}

void record(planet::Planet& planet, Editor& editor, const Log& log) {
    if (!editor.desk.recorder) return;
    constexpr std::array<double, 2> priorityFactors = {1, observerPriorityFactor};
    editor.desk.recorder->stepped(planet, priorityFactors);
    if (!editor.desk.recorder->encoded().full()) return;
    log->warn("Recording stopped: the limit of {} frames or {} MiB is reached", maxFlightFrames,
              maxFlightBytes >> 20);
    stopRecording(editor.desk, &planet, log);
    editor.flights = availableFlights();
}

// Settings that choose and load come from the recording alone; the others may be changed meanwhile.
void holdRecordedSettings(const ViewSettings& recorded, ViewSettings& settings) {
    settings.lod = recorded.lod;
    settings.paging = recorded.paging;
    settings.overlay.cube = recorded.overlay.cube;
    settings.surface.exaggeration = recorded.surface.exaggeration;
    settings.camera.fovDeg = recorded.camera.fovDeg;
}

// In place of moving the camera, giving the planet its settings, and choosing.
void replay(Scene& scene, Editor& editor, const Log& log, double seconds) {
    const FlightReplay& replayed = editor.desk.replay->replay;
    const std::size_t frameBefore = replayed.next();
    glm::dvec3 fromM = editor.lodView.eyeM;
    const ReplayWatcher watcher{
        [&](const planet::Selection& selection) {
            if (replayed.next() == 1) forgetChanges(editor);
            editor.changes.add(selection, editor.timeS);
            const glm::dvec3& toM = replayed.view().eyeM;
            const double passedS = std::max(replayed.timeS() - editor.pops.meter.lastTimeS(), 0.0);
            editor.cameraJumped =
                isCameraJump(std::exchange(fromM, toM), toM, scene.planet->tree().shape.radiusM, passedS);
            measurePops(scene, replayed.view(), replayed.timeS(), editor.cameraJumped, editor.pops);
        },
        [&](const ViewSettings& recorded, bool pagingPaused) {
            const CameraSettings camera = editor.settings.view.camera;
            const CompareSettings compare = editor.settings.view.compare;
            editor.settings.view = recorded;
            editor.settings.view.camera = camera;
            editor.settings.view.compare = compare;
            editor.pagingPaused = pagingPaused;
        }};
    if (const auto done = advanceReplay(*editor.desk.replay, scene, seconds, watcher); !done) {
        log->error("{}", done.error().message);
        return endReplay(editor, &scene);
    }
    if (replayed.next() > 0) holdRecordedSettings(replayed.settings(), editor.settings.view);
    // Between frames the camera may stand where a pop was gone back to.
    if (replayed.next() == frameBefore) return;
    editor.beforeInspection.reset();  // played on, the replay moves the camera again
    editor.pops.side = PopSide::Live;
    editor.lodView = replayed.view();
    editor.rig->camera = {editor.lodView.eyeM, editor.lodView.right, editor.lodView.back};
}

void giveSettings(Scene& scene, Editor& editor, const Log& log) {
    const auto applied = applyLiveSettings(scene, editor.settings.view, editor.pagingPaused);
    if (!applied) log->error("{}", applied.error().message);
    if (!editor.desk.recorder) return;
    if (applied)
        return editor.desk.recorder->givenSettings(*scene.planet, editor.settings.view, editor.pagingPaused);
    // What the planet has kept of them nobody could repeat.
    log->warn("Recording stopped: settings were refused");
    stopRecording(editor.desk, scene.planet.get(), log);
}

std::vector<planet::gl::ChunkTint> tintsOf(const Scene& scene, const planet::Selection& selection,
                                           const ViewSettings& settings, const ErrorMeter& errors) {
    return chunkTints(*scene.planet, selection, settings.overlay, settings.lod.tauPx,
                      errors.last ? &*errors.last : nullptr);
}

void drawMainPicture(Scene& scene, float pixelRatio, Editor& editor, const Log& log) {
    Viewport& viewport = editor.viewport;
    const ViewSettings settings =
        editor.compare.other ? comparedSettings(editor.settings.view) : editor.settings.view;
    PictureContent content;
    content.view = mainView(editor, pixelRatio);
    viewport.main.view = content.view;
    if (!viewport.main.shown()) return;
    const std::optional<KeptPicture> kept = keptPicture(scene.planet->tree(), editor.pops);
    if (kept) content.kept = KeptItems{kept->selection.draw, kept->stitched};
    const planet::Selection& shown = kept ? kept->selection : scene.planet->selection();
    const std::vector<planet::gl::ChunkTint> tints = tintsOf(scene, shown, settings, editor.errors);
    content.tints = tints;
    content.hiddenLines = linesOver(scene, shown, content.view, settings);
    content.frontLines = focusLines(scene.planet->tree(), editor.focus, content.view);
    drawPicture(viewport, viewport.main, scene, settings, content, log);
}

void drawObserverPicture(Scene& scene, float pixelRatio, Editor& editor, const Log& log) {
    Viewport& viewport = editor.viewport;
    if (!viewport.observer.shown()) return;
    const ViewSettings& settings = editor.settings.view;
    PictureContent content;
    content.view = observerView(editor, pixelRatio);
    content.selection = observerSelection(scene, editor);
    const std::vector<planet::gl::ChunkTint> tints =
        tintsOf(scene, scene.planet->selection(content.selection), settings, editor.errors);
    content.tints = tints;
    content.hiddenLines =
        linesOver(scene, scene.planet->selection(content.selection), content.view, settings);
    content.frontLines = observerLines(*scene.planet, editor.lodView, settings.camera, editor.focus.selected);
    const planet::Lines focus = focusLines(scene.planet->tree(), editor.focus, content.view);
    content.frontLines.insert(content.frontLines.end(), focus.begin(), focus.end());
    drawPicture(viewport, viewport.observer, scene, settings, content, log);
}

bool isShown(const Editor& editor, PanelId panel) {
    return editor.settings.workspace.panels[static_cast<std::size_t>(panel)].shown;
}

// Follows the pointer in the main picture, and stays where it was last over the ground.
void probe(const Scene& scene, Editor& editor) {
    if (!isShown(editor, PanelId::Probe)) return;
    const PlanetPicture& picture = editor.viewport.main;
    const planet::Planet& planet = *scene.planet;
    const ProbeInput input{planet.tree(), planet.selection(), picture.view,
                           scene.renderer.chunks().projection(),
                           editor.settings.view.lod.seams == planet::SeamMode::Stitched};
    editor.probe.overGround = false;
    if (picture.shown() && picture.pointer.over) {
        const std::optional<planet::SurfaceHit> hit =
            planet::pickSurface(planet.tree(), planet.selection().draw, picture.view.eyeM,
                                rayThrough(picture.view, picture.pointer.positionPx));
        editor.probe.overGround = hit.has_value();
        if (hit) editor.probe.vertex = probeHit(input, *hit);
    }
    editor.probe.selected.reset();
    if (editor.focus.selected) editor.probe.selected = probeWorst(input, *editor.focus.selected);
}

// While nothing else is drawn for measuring.
void watchCosts(Scene& scene, const Editor& editor, Log& log) {
    if (scene.renderer.chunks().capabilities().software || editor.costs.meter) return;
    const planet::gl::RenderCounters& drawn = scene.drawn;
    const double gpuMs = drawn.chunksMs + drawn.skyMs + drawn.shadowsMs;
    if (watchPicture(scene.turnedDown, editor.settings.view.surface, gpuMs, editor.timeS))
        log->info("A frame took {:.0f} ms on the GPU; a feature was turned off. The Light panel shows which.",
                  gpuMs);
}

// A little in each frame, so that the window goes on.
void measureCosts(Scene& scene, CostInstrument& instrument) {
    if (!instrument.meter || instrument.meter->step(scene)) return;
    instrument.costs = instrument.meter->costs();
    instrument.meter.reset();
}

// What the layers make of the ground under the pointer.
void readLayers(const Scene& scene, Editor& editor) {
    if (!isShown(editor, PanelId::Surface)) return;
    const PlanetPicture& picture = editor.viewport.main;
    editor.layers.overGround = false;
    if (!picture.shown() || !picture.pointer.over) return;
    const planet::ChunkTree& tree = scene.planet->tree();
    const std::optional<planet::SurfaceHit> hit =
        planet::pickSurface(tree, scene.planet->selection().draw, picture.view.eyeM,
                            rayThrough(picture.view, picture.pointer.positionPx));
    editor.layers.overGround = hit.has_value();
    if (hit) editor.layers.under = layerReadout(tree, *hit, editor.settings.view.surface);
}

// The chunk under the pointer is lit; a click selects it, or nothing where there is only sky.
void pick(const PlanetPicture& picture, const Scene& scene, std::size_t selection, ui::Commands& commands) {
    if (!picture.shown() || !picture.pointer.over) return;
    const std::optional<planet::SurfaceHit> hit =
        planet::pickSurface(scene.planet->tree(), scene.planet->selection(selection).draw, picture.view.eyeM,
                            rayThrough(picture.view, picture.pointer.positionPx));
    if (hit) commands.push_back(ui::HoverChunk{hit->id});
    if (!picture.pointer.clicked) return;
    commands.push_back(ui::SelectChunk{hit ? std::optional(hit->id) : std::nullopt});
}

}  // namespace

FrameStats runPlanet(Scene& scene, float pixelRatio, Editor& editor, Log& log, double seconds,
                     ui::Commands& commands) {
    meetPlanet(scene, editor, log);
    // A frame that is paused steps nothing, but draws.
    scene.drawCpuMs = 0;
    scene.drawn = {};
    editor.viewport.shaderWait =
        editor.screenshotPending ? planet::gl::ShaderWait::UntilReady : planet::gl::ShaderWait::Never;
    if (!editor.desk.replay) giveSettings(scene, editor, log);
    placeCameras(scene, pixelRatio, editor);
    const bool stepOne = std::exchange(editor.stepOneFrame, false);
    const bool goesOn = !editor.framesPaused || stepOne;
    const double frameS = editor.framesPaused ? 1.0 / 60 : seconds;
    if (goesOn) moveCameras(scene, pixelRatio, editor, log, frameS);
    if (editor.desk.replay) {
        replay(scene, editor, log, goesOn ? frameS : 0);
    } else if (goesOn) {
        chooseChunks(scene, pixelRatio, editor, editor.framesPaused ? std::optional(frameS) : std::nullopt);
        record(*scene.planet, editor, log);
    }
    advanceErrorMeter(*scene.planet, editor.frames, editor.timeS, editor.errors);
    stepCompared(editor.compare,
                 {scene, editor.settings.view, editor.lodView, mainView(editor, pixelRatio), editor.timeS,
                  editor.frames, editor.cameraJumped, goesOn, editor.pagingPaused},
                 log);
    const Stopwatch watch;
    drawMainPicture(scene, pixelRatio, editor, log);
    const bool counting =
        editor.settings.view.compare.mode == CompareMode::Difference || isShown(editor, PanelId::Compare);
    drawCompared(editor.compare, editor.viewport, editor.settings.view, editor.focus,
                 counting && !scene.drawn.standIn, log);
    drawObserverPicture(scene, pixelRatio, editor, log);
    const CrackSettings& cracks = editor.settings.view.cracks;
    const auto every = static_cast<std::uint64_t>(cracks.everyFrames);
    if (cracks.live && editor.frames % every == 0) commands.emplace_back(ui::MeasureCracks{});
    measureCosts(scene, editor.costs);
    probe(scene, editor);
    readLayers(scene, editor);
    pick(editor.viewport.main, scene, 0, commands);
    pick(editor.viewport.observer, scene, observerSelection(scene, editor), commands);
    FrameStats stats = statsOf(scene);
    watchCosts(scene, editor, log);
    stats.overlaysMs = std::max(watch.elapsedMs() - stats.drawCpuMs, 0.0);
    stats.targetBytes = gpuBytes(editor.viewport) + gpuBytes(editor.compare);
    return stats;
}

}  // namespace worldy
