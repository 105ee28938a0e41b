#include "app/editor/flight_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/places.h"
#include "app/base/stopwatch.h"
#include "app/editor/presets.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

// So long may a frame of the window be busy with replaying, so that it can still be used.
constexpr double busyMs = 25;

bool hasFlight(const FlightDesk& desk, const std::string& name) {
    return std::any_of(desk.flights.begin(), desk.flights.end(),
                       [&](const ui::RecordedFlight& flight) { return flight.name == name; });
}

std::string freeName(const FlightDesk& desk) {
    for (int number = 1;; ++number) {
        std::string name = fmt::format("flight {}", number);
        if (!hasFlight(desk, name)) return name;
    }
}

// The name itself, or with the next number: "flight 2" after "flight 1", "canyon 2" after "canyon".
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

// Another window may have taken the name since the recording began, or take it just now.
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

// Gives the planet the recording's first settings, and lets the replay begin.
Result<void> rewind(RunningReplay& running, Scene& scene) {
    ViewSettings settings;
    for (const CalledInFlight& called : running.replay.record().frames[0].calls)
        static_cast<void>(applyFlightSettings(called.settings, settings));
    // What was refused before is refused again rather than passed over, and then the planet stays as it is.
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
    return fmt::format("frame {} at {:.2f} s, its {}:{}{}", difference.frame + 1, difference.timeS,
                       difference.what, textOf("+", difference.onlyReplayed),
                       textOf("-", difference.onlyRecorded));
}

}  // namespace

fs::path recordingsFolder() {
    return configFolder() / "flights";
}

FlightDesk openFlightDesk(const fs::path& folder) {
    FlightDesk desk;
    desk.folder = folder;
    listRecordings(desk);
    return desk;
}

void listRecordings(FlightDesk& desk) {
    desk.flights.clear();
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(desk.folder, status)) {
        if (!isFlightRecord(entry.path()) || entry.path().filename().string().starts_with('.')) continue;
        const std::uintmax_t bytes = entry.file_size(status);
        desk.flights.push_back(
            {entry.path().stem().string(), entry.path(), status ? 0 : static_cast<double>(bytes)});
    }
    std::sort(desk.flights.begin(), desk.flights.end(),
              [](const ui::RecordedFlight& a, const ui::RecordedFlight& b) { return a.name < b.name; });
}

Result<void> startRecording(FlightDesk& desk, planet::Planet& planet, std::string name) {
    listRecordings(desk);
    if (name.empty()) name = freeName(desk);
    if (Result<void> good = checkPresetName(name); !good) return good;
    if (desk.unwritten) {
        return planet::badInput(fmt::format("The recording \"{}\" is not saved yet; stop it again to retry",
                                            desk.unwritten->name()));
    }
    if (hasFlight(desk, name)) {
        return planet::badInput(
            fmt::format("A recorded flight \"{}\" already exists; expected another name", name));
    }
    desk.recorder.emplace(planet, std::move(name));
    return {};
}

void stopRecording(FlightDesk& desk, planet::Planet* planet, const Log& log) {
    if (desk.recorder) {
        if (planet) desk.recorder->stop(*planet);
        desk.unwritten = std::move(desk.recorder);
        desk.recorder.reset();
    }
    if (!desk.unwritten) return;
    Recorder& recorder = *desk.unwritten;
    std::error_code status;
    fs::create_directories(desk.folder, status);
    const std::string name = recorder.name();
    const FlightEncoder& encoded = recorder.encoded();
    const Result<fs::path> file = writeUnderFreeName(desk.folder, recorder);
    desk.saved = file ? recorder.name() : "";
    desk.saveProblem = file ? "" : file.error().message;
    if (file && recorder.name() != name)
        log->warn("A recorded flight \"{}\" now exists; this one is saved as \"{}\"", name, recorder.name());
    if (file)
        log->info("Recorded {}: {} frames over {:.1f} s", file->string(), encoded.frames(),
                  encoded.seconds());
    else if (encoded.frames() > 0)
        log->error("{}; the recording is kept: free disk space and stop it again", file.error().message);
    else
        log->error("{}", file.error().message);
    if (file || encoded.frames() == 0) desk.unwritten.reset();
    listRecordings(desk);
}

Result<void> deleteRecording(FlightDesk& desk, const fs::path& file) {
    std::error_code status;
    fs::remove(file, status);
    listRecordings(desk);
    if (file.stem() == desk.saved) desk.saved.clear();
    if (!status) return {};
    return planet::ioError(fmt::format("{}: cannot be deleted: {}", file.string(), status.message()));
}

Result<void> startReplay(FlightDesk& desk, const fs::path& file, Scene& scene, const BeforeReplay& before) {
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
    desk.replay.emplace(std::move(running));
    return {};
}

Result<void> setReplay(FlightDesk& desk, Scene& scene, const ui::ReplayControls& controls) {
    if (!desk.replay) return {};
    RunningReplay& running = *desk.replay;
    const bool otherPaging = controls.simulated != running.controls.simulated;
    // At its end there is nothing left to play.
    const bool fromTheEnd = controls.playing && !running.controls.playing && running.replay.atEnd();
    running.controls = controls;
    if (fromTheEnd) moveReplay(desk, 1);
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

void moveReplay(FlightDesk& desk, std::size_t frame) {
    if (!desk.replay) return;
    RunningReplay& running = *desk.replay;
    running.seek = std::clamp<std::size_t>(frame, 1, running.endS.size());
    running.playedS = running.endS[*running.seek - 1];
}

void moveReplayTo(FlightDesk& desk, double timeS) {
    if (!desk.replay) return;
    const std::vector<double>& endS = desk.replay->endS;
    moveReplay(desk,
               static_cast<std::size_t>(std::upper_bound(endS.begin(), endS.end(), timeS) - endS.begin()));
}

BeforeReplay stopReplay(FlightDesk& desk, Scene* scene) {
    BeforeReplay before = std::move(desk.replay->before);
    desk.replay.reset();
    if (scene) scene->planet->tools().keepMoves(false);
    return before;
}

Result<void> advanceReplay(RunningReplay& running, Scene& scene, double seconds,
                           const ReplayWatcher& watcher) {
    // What is drawn is counted from here, as it is from a step of the scene.
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
    if (due()) running.playedS = replay.timeS();  // too slow
    if (!replay.atEnd() || !running.controls.playing) return {};
    running.playedS = 0;
    if (running.controls.loop)
        running.seek = 1;
    else
        running.controls.playing = false;
    return {};
}

ui::RecordingView recordingViewOf(const FlightDesk& desk, const ViewSettings& settings) {
    ui::RecordingView view;
    view.flights = desk.flights;
    view.saved = desk.saved;
    const std::optional<Recorder>& recorder = desk.recorder ? desk.recorder : desk.unwritten;
    if (recorder && !desk.replay) {
        const FlightEncoder& encoded = recorder->encoded();
        view.recording = ui::RecordingNow{recorder->name(), encoded.seconds(), encoded.frames(),
                                          static_cast<double>(encoded.bytes()), settings.paging.simulated};
    }
    if (desk.replay) {
        const RunningReplay& running = *desk.replay;
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

}  // namespace worldy
