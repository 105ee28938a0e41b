// The editor in its window: one controller per feature, and the order in which they run in a frame. Main
// thread.
#pragma once

#include <filesystem>

#include "app/base/log.h"
#include "app/editor/bake_controller.h"
#include "app/editor/camera_controller.h"
#include "app/editor/chunk_controller.h"
#include "app/editor/compare_controller.h"
#include "app/editor/file_controller.h"
#include "app/editor/frame_controller.h"
#include "app/editor/instruments_controller.h"
#include "app/editor/layer_controller.h"
#include "app/editor/paging_controller.h"
#include "app/editor/recording_controller.h"
#include "app/editor/settings_controller.h"
#include "app/editor/sweep_controller.h"
#include "app/editor/viewport.h"
#include "app/editor/window_controller.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/window/window.h"

namespace worldy {

// Owns no window and no planet.
class Editor {
public:
    // settingsFile: what the caller saves the settings in, empty if it does not.
    Editor(const Settings& settings, const std::filesystem::path& settingsFile, const Log& log);

    // Returns the settings to save. A budget's τ is not the user's.
    Settings settings() const;
    // Writes the positions of controls into a file after each frame.
    void keepItemMap(const std::filesystem::path& file) { window_.itemMapFile = file; }

    // Opens the trace and moves the camera of a session in the first frames, and shows its results. A session without a
    // planet is a trace that was named alone, whose panels are shown. problem: why the session or a part of it cannot be
    // opened, which the first frames tell; empty if there is none.
    void resume(const LastSession& session, const KeptResults& results, const std::string& problem);
    // Reports a problem in the log and in a message box.
    void tell(const std::string& title, const std::string& problem);
    // Return what the next start can go on with. No results are known while some are being measured.
    LastSession lastSession(const Session& session) const;
    std::optional<KeptResults> keptResults() const;

    // Waits for input while nothing changes, and as the frame limit requires. Call before each frame.
    void rest(const Window& window, const Session& session);
    // Runs one frame: input, planet, panels, and the panels' commands. secondsSinceLast: >= 0.
    void runFrame(Window& window, Session& session, double secondsSinceLast);
    // Saves the recording and ends the replay. Call before the window closes.
    void endFlights(Session& session);

private:
    void tellProblems(const Session& session);
    bool replaying() const { return recording_.replay.has_value(); }
    CameraContext cameraContext(const Scene* scene);
    ReplayContext replayContext();
    WindowContent windowContent(const Session& session) const;
    int frameLimit() const;
    void restWhileStill(const Window& window, const Session& session);

    void meetPlanet(Scene& scene);
    FrameStats runPlanet(Scene& scene, double seconds, ui::Commands& commands);
    void movePlanet(Scene& scene, const FrameStep& step);
    void chooseChunks(Scene& scene, const FrameStep& step);
    void drawPictures(Scene& scene);
    void takeUpSession(const Session& session, ui::Commands& commands);
    std::size_t runningJobs() const;
    FrameActivity activity(const Session& session, const FrameStats& stats) const;
    ui::EditorView view(Session& session);
    void execute(const ui::Command& command, const Window& window, Session& session);
    void execute(const ui::Commands& commands, const Window& window, Session& session);
    void watchAllocations(const Session& session);

    Notices notices_;
    Viewport viewport_;
    SettingsController settings_;
    CameraController camera_;
    ChunkController chunks_;
    PagingController paging_;
    FrameController frames_;
    FileController files_;
    BakeController bakes_;
    WindowController window_;
    LayerController layers_;
    InstrumentsController instruments_;
    RecordingController recording_;
    SweepController sweep_;
    CompareController compare_;
};

}  // namespace worldy
