// Recording and replaying of flights in the window: the Flight panel's commands, and a frame of each. Main
// thread.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/log.h"
#include "app/editor/camera_controller.h"
#include "app/editor/compare_controller.h"
#include "app/editor/frame_controller.h"
#include "app/editor/instruments_controller.h"
#include "app/editor/notices.h"
#include "app/editor/paging_controller.h"
#include "app/flight/flight_replay.h"
#include "app/flight/recorder.h"
#include "app/scene/camera_control.h"
#include "app/scene/scene.h"
#include "ui/model/commands.h"
#include "ui/model/recording_view.h"

namespace worldy {

// The state before a replay, which is restored at its end.
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
struct RecordingController {
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
RecordingController openRecordings(const std::filesystem::path& folder);
void listRecordings(RecordingController& controller);

// Starts a recording. name: follows the rules for presets; empty: the next free "flight 1", "flight 2" ...
// The Error says what is wrong with the name, that it is taken, or that the recording before is not
// saved yet.
planet::Result<void> startRecording(RecordingController& controller, planet::Planet& planet,
                                    std::string name);
// Saves the recording under its name, or under the next free one if that is taken by now. A recording that
// cannot be saved is kept and tried again at the next call; one without frames is discarded. planet: null if
// it is gone.
void stopRecording(RecordingController& controller, planet::Planet* planet, const Log& log);
planet::Result<void> deleteRecording(RecordingController& controller, const std::filesystem::path& file);

// Resets the planet and replays up to the first frame.
planet::Result<void> startReplay(RecordingController& controller, const std::filesystem::path& file,
                                 Scene& scene, const BeforeReplay& before);
// Changes the controls. Another kind of paging replays up to the same frame.
planet::Result<void> setReplay(RecordingController& controller, Scene& scene,
                               const ui::ReplayControls& controls);
void moveReplay(RecordingController& controller, std::size_t frame);
// Goes to the last frame that ends no later.
void moveReplayTo(RecordingController& controller, double timeS);
// Returns the state before the replay. scene: null if it is gone.
BeforeReplay stopReplay(RecordingController& controller, Scene* scene);

// stepped is called after each replayed frame, changed for each recorded change of settings.
struct ReplayWatcher {
    std::function<void(const planet::Selection&)> stepped;
    std::function<void(const ViewSettings&, bool pagingPaused)> changed;
};
// Replays the frames that are due so many seconds later, but no more than fit into a frame of the window.
// seconds 0: those of a jump alone. A replay that is too slow goes on slower and leaves out no frame.
planet::Result<void> advanceReplay(RunningReplay& running, Scene& scene, double seconds,
                                   const ReplayWatcher& watcher);

// The parts of other features that a replay takes over from the user and restores at its end.
struct ReplayContext {
    Settings& settings;
    CameraController& camera;
    PagingController& paging;
    FrameController& frames;
    InstrumentsController& instruments;
    CompareController& compare;
};
// scene: null while no planet is open.
void execute(RecordingController& controller, const ui::RecordingCommand& command, Scene* scene,
             const ReplayContext& context, Notices& notices);

// Ends the replay, if one runs, and restores the settings and the camera from before it. scene: null if its
// planet is gone.
void endReplay(RecordingController& controller, Scene* scene, const ReplayContext& context);
// Runs a frame of the replay, in place of moving the camera, giving the planet its settings, and choosing.
void replayFrame(RecordingController& controller, Scene& scene, const ReplayContext& context, double seconds,
                 const Log& log);

// Gives the planet its settings, and records them.
void giveSettings(RecordingController& controller, Scene& scene, const ViewSettings& settings,
                  bool pagingPaused, const Log& log);
// Records the frame that was just chosen, if a flight is being recorded. Returns true if it was the last one
// that fits, which ends the recording.
bool recordFrame(RecordingController& controller, planet::Planet& planet, const Log& log);

ui::RecordingView recordingViewOf(const RecordingController& controller, const ViewSettings& settings);

}  // namespace worldy
