#include "app/editor/recording_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/base/places.h"
#include "app/base/stopwatch.h"
#include "app/data/named_files.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// The most time per frame that replaying may take, so that the window stays responsive.
constexpr double busyMs = 25;

bool hasFlight(const RecordingController& controller, const std::string& name) {
    return std::any_of(controller.flights.begin(), controller.flights.end(),
                       [&](const ui::RecordedFlight& flight) { return flight.name == name; });
}

std::string freeName(const RecordingController& controller) {
    for (int number = 1;; ++number) {
        std::string name = fmt::format("flight {}", number);
        if (!hasFlight(controller, name)) return name;
    }
}

// Returns the name, or the name with the next free number: "flight 2" after "flight 1", "canyon 2" after
// "canyon".
std::string freeNameLike(const fs::path& folder, const std::string& name) {
    const auto isFree = [&](const std::string& one) {
        std::error_code status;
        return !fs::exists(fs::symlink_status(folder / (one + recordedFlightEnding), status));
    };
    if (isFree(name)) return name;
    const std::size_t space = name.rfind(' ');
    const std::string digits = space == std::string::npos ? "" : name.substr(space + 1);
    const bool numbered =
        !digits.empty() && digits.size() < 7 &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::string stem = numbered ? name.substr(0, space) : name;
    for (int number = numbered ? std::stoi(digits) + 1 : 2;; ++number) {
        std::string next = fmt::format("{} {}", stem, number);
        if (isFree(next)) return next;
    }
}

// Retries under other names, because another process may take the name at any time.
Result<fs::path> writeUnderFreeName(const fs::path& folder, Recorder& recorder) {
    constexpr int mostTries = 10;
    for (int tries = 1;; ++tries) {
        recorder.rename(freeNameLike(folder, recorder.name()));
        fs::path file = folder / (recorder.name() + recordedFlightEnding);
        const Result<void> written = recorder.write(file, IfThere::Fail);
        if (written) return file;
        std::error_code status;
        if (tries == mostTries || !fs::exists(file, status)) return tl::unexpected(written.error());
    }
}

planet::PagingTime timeOf(const RunningReplay& running) {
    return running.controls.simulated ? planet::PagingTime::Simulated : planet::PagingTime::Recorded;
}

ReplayPaging pagingOf(const ui::ReplayControls& controls) {
    return controls.simulated ? ReplayPaging::Simulated : ReplayPaging::AsRecorded;
}

// Applies the recording's first settings to the planet and starts the replay.
Result<void> rewind(RunningReplay& running, Scene& scene) {
    ViewSettings settings;
    for (const CalledInFlight& called : running.replay.record().frames[0].calls)
        static_cast<void>(applyFlightSettings(called.settings, settings));
    // Paging settings refused earlier are tried again, so that the replay reports the refusal.
    scene.refusedPaging.reset();
    if (Result<void> applied = applyLiveSettings(scene, settings, false, timeOf(running)); !applied)
        return applied;
    running.replay.rewind(*scene.planet);
    return {};
}

std::string textOf(const char* sign, const std::vector<planet::BlockId>& ids) {
    constexpr std::size_t shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(ids.size(), shown); ++i)
        text += fmt::format(" {}{}", sign, toString(ids[i]));
    if (ids.size() > shown) text += fmt::format(" and {} more", ids.size() - shown);
    return text;
}

std::string textOf(const ReplayDifference& difference) {
    return fmt::format("frame {} at {:.2f} s, in the {}:{}{}", difference.frame + 1, difference.timeS,
                       difference.what, textOf("+", difference.onlyReplayed),
                       textOf("-", difference.onlyRecorded));
}

}  // namespace

fs::path recordingsFolder() {
    return configFolder() / "flights";
}

RecordingController openRecordings(const fs::path& folder) {
    RecordingController controller;
    controller.folder = folder;
    listRecordings(controller);
    return controller;
}

void listRecordings(RecordingController& controller) {
    controller.flights.clear();
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(controller.folder, status)) {
        if (!isFlightRecord(entry.path()) || entry.path().filename().string().starts_with('.')) continue;
        const std::uintmax_t bytes = entry.file_size(status);
        controller.flights.push_back(
            {entry.path().stem().string(), entry.path(), status ? 0 : static_cast<double>(bytes)});
    }
    std::sort(controller.flights.begin(), controller.flights.end(),
              [](const ui::RecordedFlight& a, const ui::RecordedFlight& b) { return a.name < b.name; });
}

Result<void> startRecording(RecordingController& controller, planet::Planet& planet, std::string name) {
    listRecordings(controller);
    if (name.empty()) name = freeName(controller);
    if (Result<void> good = checkFileName(name); !good) return good;
    if (controller.unwritten) {
        return planet::badInput(fmt::format("The recording \"{}\" is not saved yet; stop it again to retry",
                                            controller.unwritten->name()));
    }
    if (hasFlight(controller, name)) {
        return planet::badInput(
            fmt::format("A recorded flight \"{}\" already exists; expected another name", name));
    }
    controller.recorder.emplace(planet, std::move(name));
    return {};
}

void stopRecording(RecordingController& controller, planet::Planet* planet, const Log& log) {
    if (controller.recorder) {
        if (planet) controller.recorder->stop(*planet);
        controller.unwritten = std::move(controller.recorder);
        controller.recorder.reset();
    }
    if (!controller.unwritten) return;
    Recorder& recorder = *controller.unwritten;
    std::error_code status;
    fs::create_directories(controller.folder, status);
    const std::string name = recorder.name();
    const FlightEncoder& encoded = recorder.encoded();
    const Result<fs::path> file = writeUnderFreeName(controller.folder, recorder);
    controller.saved = file ? recorder.name() : "";
    controller.savedFile = file ? *file : fs::path();
    controller.saveProblem = file ? "" : file.error().message;
    if (file && recorder.name() != name)
        log.warn("A recorded flight \"{}\" now exists; this one is saved as \"{}\"", name, recorder.name());
    if (file)
        log.info("Recorded {}: {} frames over {:.1f} s", file->string(), encoded.frames(), encoded.seconds());
    else if (encoded.frames() > 0)
        log.error("{}; the recording is kept: free disk space and stop it again", file.error().message);
    else
        log.error("{}", file.error().message);
    if (file || encoded.frames() == 0) controller.unwritten.reset();
    listRecordings(controller);
}

Result<void> deleteRecording(RecordingController& controller, const fs::path& file) {
    std::error_code status;
    fs::remove(file, status);
    listRecordings(controller);
    if (file.stem() == controller.saved) controller.saved.clear();
    if (!status) return {};
    return planet::ioError(fmt::format("{}: cannot be deleted: {}", file.string(), status.message()));
}

Result<void> startReplay(RecordingController& controller, const fs::path& file, Scene& scene,
                         const BeforeReplay& before) {
    Result<FlightRecord> record = loadFlightRecord(file);
    if (!record) return tl::unexpected(record.error());
    const FlightData present = flightDataOf(scene.planet->file());
    if (Result<void> same = checkSameData(file, record->data, present); !same) return same;
    const auto shared = std::make_shared<const FlightRecord>(std::move(*record));
    RunningReplay running{
        FlightReplay::create(shared, ReplayPaging::AsRecorded).value(), file, {}, before, {}, {}, 0, 1};
    double endS = 0;
    for (const FlightFrame& frame : shared->frames) running.endS.push_back(endS += frame.elapsedS);
    for (const FlightChange& change : changesIn(*shared))
        running.ticks.push_back({running.endS[change.frame], change.splits, change.merges});
    if (Result<void> begun = rewind(running, scene); !begun) return begun;
    controller.replay.emplace(std::move(running));
    return {};
}

Result<void> setReplay(RecordingController& controller, Scene& scene, const ui::ReplayControls& controls) {
    if (!controller.replay) return {};
    RunningReplay& running = *controller.replay;
    const bool otherPaging = controls.simulated != running.controls.simulated;
    // At its end the replay cannot continue to play.
    const bool fromTheEnd = controls.playing && !running.controls.playing && running.replay.atEnd();
    running.controls = controls;
    if (fromTheEnd) moveReplay(controller, 1);
    if (!otherPaging) return {};
    const std::size_t frame = std::max<std::size_t>(running.seek.value_or(running.replay.next()), 1);
    FlightReplay other = FlightReplay::create(running.replay.sharedRecord(), pagingOf(controls)).value();
    std::swap(running.replay, other);
    if (Result<void> begun = rewind(running, scene); !begun) {
        std::swap(running.replay, other);
        running.controls.simulated = !controls.simulated;
        return begun;
    }
    running.seek = frame;
    return {};
}

void moveReplay(RecordingController& controller, std::size_t frame) {
    if (!controller.replay) return;
    RunningReplay& running = *controller.replay;
    running.seek = std::clamp<std::size_t>(frame, 1, running.endS.size());
    running.playedS = running.endS[*running.seek - 1];
}

void moveReplayTo(RecordingController& controller, double timeS) {
    if (!controller.replay) return;
    const std::vector<double>& endS = controller.replay->endS;
    moveReplay(controller,
               static_cast<std::size_t>(std::upper_bound(endS.begin(), endS.end(), timeS) - endS.begin()));
}

BeforeReplay stopReplay(RecordingController& controller, Scene* scene) {
    BeforeReplay before = std::move(controller.replay->before);
    controller.replay.reset();
    if (scene) scene->planet->tools().keepMoves(false);
    return before;
}

Result<void> advanceReplay(RunningReplay& running, Scene& scene, double seconds,
                           const ReplayWatcher& watcher) {
    // Stepping the scene resets these counters too.
    scene.drawCpuMs = 0;
    scene.drawn = {};
    FlightReplay& replay = running.replay;
    if (running.seek && *running.seek < replay.next()) {
        if (Result<void> begun = rewind(running, scene); !begun) return begun;
    }
    if (!running.seek && running.controls.playing) running.playedS += seconds * running.controls.speed;
    const ReplayedPlanet replayed{
        *scene.planet, scene.renderer.upload(),
        [&](const ViewSettings& settings, bool pagingPaused, planet::PagingTime time) {
            watcher.changed(settings, pagingPaused);
            return applyLiveSettings(scene, settings, pagingPaused, time);
        }};
    const auto due = [&] {
        if (running.seek) return replay.next() < *running.seek;
        return running.controls.playing && !replay.atEnd() && running.endS[replay.next()] <= running.playedS;
    };
    const Stopwatch watch;
    while (due() && watch.elapsedMs() < busyMs) {
        if (Result<void> stepped = replay.step(replayed); !stepped) return stepped;
        watcher.stepped(scene.planet->selection());
    }
    if (running.seek) {
        if (replay.next() == *running.seek) running.seek.reset();
        return {};
    }
    if (due()) running.playedS = replay.timeS();  // too slow: the remaining time is dropped
    if (!replay.atEnd() || !running.controls.playing) return {};
    running.playedS = 0;
    if (running.controls.loop)
        running.seek = 1;
    else
        running.controls.playing = false;
    return {};
}

ui::RecordingView recordingViewOf(const RecordingController& controller) {
    ui::RecordingView view;
    view.flights = controller.flights;
    view.saved = controller.saved;
    const std::optional<Recorder>& recorder =
        controller.recorder ? controller.recorder : controller.unwritten;
    if (recorder && !controller.replay) {
        const FlightEncoder& encoded = recorder->encoded();
        view.recording = ui::RecordingNow{recorder->name(), encoded.seconds(), encoded.frames(),
                                          static_cast<double>(encoded.bytes())};
    }
    if (controller.replay) {
        const RunningReplay& running = *controller.replay;
        ui::ReplayNow now;
        now.name = running.replay.record().name;
        now.file = running.file;
        now.frame = running.replay.next();
        now.frames = running.endS.size();
        now.timeS = running.replay.timeS();
        now.durationS = running.endS.back();
        now.seeking = running.seek.has_value();
        now.controls = running.controls;
        now.framesDifferent = running.replay.framesDifferent();
        if (const auto& first = running.replay.firstDifference()) now.difference = textOf(*first);
        now.ticks = running.ticks;
        view.replay = std::move(now);
    }
    return view;
}

namespace {

// Discards the measured LOD changes: the difference from the frame before a restart or a jump is no level
// change.
void forgetChanges(const ReplayContext& context) {
    context.instruments.changes.clear();
    forgetPops(context.instruments.pops);
    forgetPopsOfA(context.compare);
}

// Reports the outcome of the recording that was just stopped; the log already has it.
void tellSaved(const RecordingController& controller, Notices& notices) {
    if (!controller.saveProblem.empty())
        showError(notices,
                  {"The recording was not saved", controller.saveProblem,
                   controller.unwritten ? "The recording is kept: free disk space and stop it again." : ""});
    else if (!controller.saved.empty())
        show(notices, fmt::format("Recording saved: {}", controller.savedFile.string()));
}

struct RecordingHandler {
    RecordingController& controller;
    Scene* scene;
    const ReplayContext& context;
    Notices& notices;

    void operator()(const ui::StartRecording& command) const {
        if (!scene || !context.camera.rig) return;
        endReplay(controller, scene, context);
        if (succeeded(notices, startRecording(controller, *scene->planet, command.name), "Recording failed"))
            notices.log.info("Recording {}: starting with the six root chunks", controller.recorder->name());
        forgetChanges(context);
        context.frames.stepOnce = true;  // there is no selection now
    }
    void operator()(const ui::StopRecording&) const {
        stopRecording(controller, scene ? scene->planet.get() : nullptr, notices.log);
        tellSaved(controller, notices);
        context.camera.flights = availableFlights();
    }
    void operator()(const ui::DeleteRecording& command) const {
        if (succeeded(notices, deleteRecording(controller, command.file), "The recording was not deleted"))
            confirm(notices, fmt::format("Recording {} deleted", command.file.stem().string()));
        context.camera.flights = availableFlights();
    }
    void operator()(const ui::StartReplay& command) const;
    void operator()(const ui::MoveReplay& command) const { moveReplay(controller, command.frame); }
    void operator()(const ui::MoveReplayTo& command) const { moveReplayTo(controller, command.timeS); }
    void operator()(const ui::SetReplay& command) const {
        if (scene)
            succeeded(notices, setReplay(controller, *scene, command.controls), "The replay was not changed");
    }
    void operator()(const ui::StopReplay&) const { endReplay(controller, scene, context); }
};

void RecordingHandler::operator()(const ui::StartReplay& command) const {
    CameraController& camera = context.camera;
    if (!scene || !camera.rig)
        return tellCannotOpen(notices, command.file,
                              {planet::ErrorKind::BadInput,
                               fmt::format("{}: no planet is open; open one first", command.file.string())});
    const bool wasRecording = controller.recorder || controller.unwritten;
    stopRecording(controller, scene->planet.get(), notices.log);
    if (wasRecording) tellSaved(controller, notices);
    endInspection(camera,
                  {scene, context.settings, context.instruments.pops.side, context.frames.stepOnce,
                   context.frames.paused, controller.replay ? &controller.replay->controls : nullptr});
    endReplay(controller, scene, context);
    const BeforeReplay before{context.settings.view, camera.rig->camera, context.paging.paused,
                              camera.lodView, camera.lodFrozen};
    const Result<void> started = startReplay(controller, command.file, *scene, before);
    if (started) {
        camera.lodFrozen = false;
        camera.rig->glide.reset();  // it would go on after the replay
    } else
        tellCannotOpen(notices, command.file, started.error());
    forgetChanges(context);
    context.frames.stepOnce = true;
}

// Sets the settings that affect selection and loading from the recording; the user may change the others.
void holdRecordedSettings(const ViewSettings& recorded, ViewSettings& settings) {
    settings.lod = recorded.lod;
    settings.paging = recorded.paging;
    settings.overlay.cube = recorded.overlay.cube;
    settings.surface.exaggeration = recorded.surface.exaggeration;
    settings.camera.fovDeg = recorded.camera.fovDeg;
}

}  // namespace

void execute(RecordingController& controller, const ui::RecordingCommand& command, Scene* scene,
             const ReplayContext& context, Notices& notices) {
    std::visit(RecordingHandler{controller, scene, context, notices}, command);
}

void endReplay(RecordingController& controller, Scene* scene, const ReplayContext& context) {
    if (!controller.replay) return;
    CameraController& camera = context.camera;
    camera.beforeInspection.reset();  // belonged to the replay
    const BeforeReplay before = stopReplay(controller, scene);
    context.settings.view = before.settings;
    context.paging.paused = before.pagingPaused;
    if (camera.rig) camera.rig->camera = before.camera;
    camera.lodView = before.lodView;
    camera.lodFrozen = before.lodFrozen;
    forgetChanges(context);
    context.frames.stepOnce = true;
}

void replayFrame(RecordingController& controller, Scene& scene, const ReplayContext& context, double seconds,
                 Notices& notices) {
    const FlightReplay& replayed = controller.replay->replay;
    const std::size_t frameBefore = replayed.next();
    CameraController& camera = context.camera;
    Pops& pops = context.instruments.pops;
    ViewSettings& settings = context.settings.view;
    glm::dvec3 fromM = camera.lodView.eyeM;
    const ReplayWatcher watcher{
        [&](const planet::Selection& selection) {
            if (replayed.next() == 1) forgetChanges(context);
            context.instruments.changes.add(selection, context.frames.timeS);
            const glm::dvec3& toM = replayed.view().eyeM;
            const double passedS = std::max(replayed.timeS() - pops.meter.lastTimeS(), 0.0);
            camera.jumped = planet::isCameraJump(std::exchange(fromM, toM), toM,
                                                 scene.planet->tree().shape.radiusM, passedS);
            measurePops(scene, replayed.view(), replayed.timeS(), camera.jumped, pops);
        },
        [&](const ViewSettings& recorded, bool pagingPaused) {
            const CameraSettings cameraSettings = settings.camera;
            const CompareSettings compare = settings.compare;
            settings = recorded;
            settings.camera = cameraSettings;
            settings.compare = compare;
            context.paging.paused = pagingPaused;
        }};
    if (const auto done = advanceReplay(*controller.replay, scene, seconds, watcher); !done) {
        tellError(notices, {"The replay ended", done.error().message, ""});
        return endReplay(controller, &scene, context);
    }
    if (replayed.next() > 0) holdRecordedSettings(replayed.settings(), settings);
    // Between replayed frames the camera may be at a pop that is being inspected.
    if (replayed.next() == frameBefore) return;
    camera.beforeInspection.reset();  // when it plays on, the replay moves the camera
    pops.side = PopSide::Live;
    camera.lodView = replayed.view();
    camera.rig->camera = {camera.lodView.eyeM, camera.lodView.right, camera.lodView.back};
}

void giveSettings(RecordingController& controller, Scene& scene, const ViewSettings& settings,
                  bool pagingPaused, const Log& log) {
    const auto applied = applyLiveSettings(scene, settings, pagingPaused);
    if (!applied) log.error("{}", applied.error().message);
    if (!controller.recorder) return;
    if (applied) return controller.recorder->givenSettings(*scene.planet, settings, pagingPaused);
    // A replay could not reproduce which of the settings the planet has kept.
    log.warn("Recording stopped: settings were refused");
    stopRecording(controller, scene.planet.get(), log);
}

bool recordFrame(RecordingController& controller, planet::Planet& planet, const Log& log) {
    if (!controller.recorder) return false;
    constexpr std::array<double, 2> priorityFactors = {1, observerPriorityFactor};
    controller.recorder->stepped(planet, priorityFactors);
    if (!controller.recorder->encoded().full()) return false;
    log.warn("Recording stopped: the limit of {} frames or {} MiB is reached", maxFlightFrames,
             maxFlightBytes >> 20);
    stopRecording(controller, &planet, log);
    return true;
}

}  // namespace worldy
