// Records and replays flights in the window: the Flight panel's commands, and the frames of both. Main
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
#include "app/editor/paging_controller.h"
#include "app/flight/flight_replay.h"
#include "app/flight/recorder.h"
#include "app/scene/camera_control.h"
#include "app/scene/scene.h"
#include "app/session/notices.h"
#include "ui/model/commands.h"
#include "ui/model/recording_view.h"

namespace worldy {

// The state before a replay, restored at its end.
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
    double playedS = 0;               // replayed time, seconds
    std::optional<std::size_t> seek;  // number of frames to make before it continues to play
};

// The recorded flights, and the one being recorded or replayed; never both.
struct RecordingController {
    std::filesystem::path folder;  // of the recordings; may not exist yet
    std::vector<ui::RecordedFlight> flights;
    std::optional<Recorder> recorder;
    std::optional<Recorder> unwritten;  // ended, but its file could not be written yet
    std::string saveProblem;            // why the last recording could not be saved
    std::string saved;                  // name of the last saved recording; empty once it is deleted
    std::filesystem::path savedFile;    // its file
    std::optional<RunningReplay> replay;
};

// Returns the folder "flights" beside the settings.
std::filesystem::path recordingsFolder();
RecordingController openRecordings(const std::filesystem::path& folder);
void listRecordings(RecordingController& controller);

// Starts a recording. name: follows the rules for presets; empty: the next free "flight 1", "flight 2" ...
// The Error says that the name is invalid or taken, or that the previous recording is not saved yet.
planet::Result<void> startRecording(RecordingController& controller, planet::Planet& planet,
                                    std::string name);
// Saves the recording under its name, or under the next free one if it is taken by now. A recording that
// cannot be saved is kept and retried at the next call; one without frames is discarded. planet: null if it
// no longer exists.
void stopRecording(RecordingController& controller, planet::Planet* planet, const Log& log);
planet::Result<void> deleteRecording(RecordingController& controller, const std::filesystem::path& file);

// Resets the planet and replays up to the first frame.
planet::Result<void> startReplay(RecordingController& controller, const std::filesystem::path& file,
                                 Scene& scene, const BeforeReplay& before);
// Changes the controls. If block arrival changes, replays up to the same frame.
planet::Result<void> setReplay(RecordingController& controller, Scene& scene,
                               const ui::ReplayControls& controls);
void moveReplay(RecordingController& controller, std::size_t frame);
// Moves to the last frame that ends no later than timeS.
void moveReplayTo(RecordingController& controller, double timeS);
// Ends the replay and returns the state from before it. scene: null if it no longer exists.
BeforeReplay stopReplay(RecordingController& controller, Scene* scene);

// Callbacks: stepped after each replayed frame, changed after each recorded change of settings.
struct ReplayWatcher {
    std::function<void(const planet::Selection&)> stepped;
    std::function<void(const ViewSettings&, bool pagingPaused)> changed;
};
// Replays the frames due in the next seconds, as far as they fit into a frame of the window. seconds 0: only
// those of a jump. A replay that is too slow runs slower but skips no frame.
planet::Result<void> advanceReplay(RunningReplay& running, Scene& scene, double seconds,
                                   const ReplayWatcher& watcher);

// Parts of other features that a replay controls and restores at its end.
struct ReplayContext {
    Settings& settings;
    CameraController& camera;
    PagingController& paging;
    FrameController& frames;
    InstrumentsController& instruments;
    CompareController& compare;
};
// scene: null if no planet is open.
void execute(RecordingController& controller, const ui::RecordingCommand& command, Scene* scene,
             const ReplayContext& context, Notices& notices);

// Ends a running replay and restores settings and camera from before it. scene: null if its planet no longer
// exists.
void endReplay(RecordingController& controller, Scene* scene, const ReplayContext& context);
// Runs a frame of the replay, instead of moving the camera, applying the settings, and selecting.
void replayFrame(RecordingController& controller, Scene& scene, const ReplayContext& context, double seconds,
                 Notices& notices);

// Applies the settings to the planet, and records them.
void giveSettings(RecordingController& controller, Scene& scene, const ViewSettings& settings,
                  bool pagingPaused, const Log& log);
// Records the frame just selected if a recording is running. Returns true if the recording is full and has
// ended.
bool recordFrame(RecordingController& controller, planet::Planet& planet, const Log& log);

ui::RecordingView recordingViewOf(const RecordingController& controller);

}  // namespace worldy
