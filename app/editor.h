// What happens in a frame of the window, and all that it remembers from one frame to the next.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/bookmarks.h"
#include "app/camera_rig.h"
#include "app/compare_desk.h"
#include "app/cracks.h"
#include "app/error_job.h"
#include "app/flight_desk.h"
#include "app/layer_desk.h"
#include "app/log.h"
#include "app/pops.h"
#include "app/presets.h"
#include "app/session.h"
#include "app/settings.h"
#include "app/surface_costs.h"
#include "app/sweep_desk.h"
#include "app/undo.h"
#include "app/viewport.h"
#include "app/window.h"
#include "ui/editor_view.h"
#include "ui/menu_bar.h"
#include "ui/message_box.h"
#include "ui/open_dialog.h"

namespace worldy {

// The camera and the freezing of LOD as they were before a place was inspected.
struct BeforeInspection {
    Camera camera;
    planet::View lodView;
    bool lodFrozen = false;
    bool replayPlaying = false;
};

// Where the user is, looks and has got to. Plain state; owns no window and no planet.
struct Editor {
    Settings settings;

    std::optional<CameraRig> rig;       // once a planet is open
    std::optional<CameraRig> observer;  // once it was looked through
    ui::CameraSettings observerControls;
    planet::View lodView;       // follows the camera but while frozen
    bool cameraJumped = false;  // in the last frame, for what measures pops
    bool lodFrozen = false;
    std::optional<BeforeInspection> beforeInspection;
    bool framesPaused = false;
    bool stepOneFrame = false;
    bool pagingPaused = false;
    Viewport viewport;
    ui::ChunkFocus focus;
    std::shared_ptr<const int> lastScene;  // of the frame before, to see that another took its place
    double lastRadiusM = 0;

    double timeS = 0;  // since the window opened
    ui::FrameStats stats;
    ui::AllocationsView allocations;
    std::deque<ui::FrameSample> history;
    planet::LodChanges changes;
    Pops pops;
    ui::ProbeView probe;
    std::deque<ui::LogLine> logLines;
    CrackInstrument cracks;
    CostInstrument costs;

    ErrorMeter errors;

    ui::PanelStates panels;
    ui::MenuState menu;
    ui::OpenDialogState openDialog;
    ui::Message message;
    ui::Confirmation confirmation;

    UndoHistory undo;
    PresetShelf presets{presetFolders()};
    Bookmarks bookmarks;
    std::vector<std::filesystem::path> flights;
    std::vector<std::filesystem::path> recent;            // as kept
    std::vector<std::filesystem::path> recentShown;       // those that are there
    std::optional<ui::TakeScreenshot> screenshotPending;  // once a frame is drawn as it is set
    std::filesystem::path itemMapFile;                    // where to write where controls are; empty: nowhere
    std::uint64_t frames = 0;                             // run so far
    FlightDesk desk;
    SweepDesk sweep;
    CompareDesk compare;
    LayerDesk layers = openLayerDesk();
};

Editor openEditor(const Settings& settings, const Log& log);

// The planet has begun anew or gone back in a replay: what differs from the frame before is no change of
// level.
void forgetChanges(Editor& editor);

// Moves the camera and freezes LOD at lodView; pauses a replay instead of freezing. Wants a rig.
void inspect(Editor& editor, const Camera& camera, const planet::View& lodView);
// Gives back what was before the first inspect(); does nothing if there was none.
void endInspection(Editor& editor);

inline constexpr double confirmationS = 5;  // how long one is shown
// Says in the log and for some seconds in the viewport that something asked for is done.
void confirm(Editor& editor, const Log& log, const std::string& text);
// Says in the log and in front of the user why something asked for was not done, and what to do about it.
void tellError(Editor& editor, const Log& log, ui::Message message);

// Ends the replay, if one runs, and gives back the settings and the camera of before. scene: null where its
// planet is gone.
void endReplay(Editor& editor, Scene* scene);

// Before the window closes: keeps what is being recorded, and gives back what a replay has taken.
void endFlights(Session& session, Editor& editor, const Log& log);

void runFrame(Window& window, Session& session, Editor& editor, Log& log, double secondsSinceLast);

}  // namespace worldy
