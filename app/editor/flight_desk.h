// Recording and replaying in the window: what the Flight panel's commands do, and what becomes of it from
// frame to frame. One thread, the window's.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/flight/flight_replay.h"
#include "app/flight/recorder.h"
#include "app/scene/camera_control.h"
#include "app/scene/scene.h"
#include "ui/model/recording_view.h"

namespace worldy {

// What a replay takes the place of, and gives back at its end.
struct BeforeReplay {
    ViewSettings settings;
    Camera camera;
    bool pagingPaused = false;
    planet::View lodView{};
    bool lodFrozen = false;
};

struct RunningReplay {
    FlightReplay replay;
    std::filesystem::path file;
    ui::ReplayControls controls;
    BeforeReplay before;
    std::vector<double> endS;  // of each frame, from the recording's start
    std::vector<ui::FlightTick> ticks;
    double playedS = 0;               // how far it has been played
    std::optional<std::size_t> seek;  // frames to make before it plays on
};

// Recorded flights and the one that is recorded or replayed now; never both.
struct FlightDesk {
    std::filesystem::path folder;  // of the recordings; need not exist yet
    std::vector<ui::RecordedFlight> flights;
    std::optional<Recorder> recorder;
    std::optional<Recorder> unwritten;  // has ended, and its file could not be written yet
    std::string saveProblem;            // why the last recording could not be saved
    std::string saved;                  // name under which the last recording was saved, until it is deleted
    std::optional<RunningReplay> replay;
};

// The folder "flights" beside the settings.
std::filesystem::path recordingsFolder();
FlightDesk openFlightDesk(const std::filesystem::path& folder);
void listRecordings(FlightDesk& desk);

// A name as a preset's, or empty for the next free "flight 1", "flight 2" ... The Error says what is wrong
// with it, or that there is one of that name, or that the one before is not written yet.
planet::Result<void> startRecording(FlightDesk& desk, planet::Planet& planet, std::string name);
// Writes what was recorded and says so: under its name, or the next that is free where there is a file of
// that name by now. What cannot be written is kept, and tried again at the next call; of no frames it is
// dropped. planet: null where it is gone.
void stopRecording(FlightDesk& desk, planet::Planet* planet, const Log& log);
planet::Result<void> deleteRecording(FlightDesk& desk, const std::filesystem::path& file);

// The planet starts anew, and stands at the first frame.
planet::Result<void> startReplay(FlightDesk& desk, const std::filesystem::path& file, Scene& scene,
                                 const BeforeReplay& before);
// Another kind of paging replays up to the same frame.
planet::Result<void> setReplay(FlightDesk& desk, Scene& scene, const ui::ReplayControls& controls);
void moveReplay(FlightDesk& desk, std::size_t frame);
// To the last frame that ends no later.
void moveReplayTo(FlightDesk& desk, double timeS);
// What was before, to be given back. scene: null where it is gone.
BeforeReplay stopReplay(FlightDesk& desk, Scene* scene);

// Called as each replayed frame has been made, and when settings of the recording have come.
struct ReplayWatcher {
    std::function<void(const planet::Selection&)> stepped;
    std::function<void(const ViewSettings&, bool pagingPaused)> changed;
};
// Makes the frames that are due so many seconds later, but no more than fit into a frame of the window;
// seconds 0: those of a jump alone. A replay that is too slow goes on slower, it leaves out nothing.
planet::Result<void> advanceReplay(RunningReplay& running, Scene& scene, double seconds,
                                   const ReplayWatcher& watcher);

ui::RecordingView recordingViewOf(const FlightDesk& desk, const ViewSettings& settings);

}  // namespace worldy
