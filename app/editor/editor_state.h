// The state that the editor keeps from one frame to the next, without what runs it (app/editor/editor.h).
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/base/log_lines.h"
#include "app/editor/bookmarks.h"
#include "app/editor/camera_rig.h"
#include "app/editor/compare_desk.h"
#include "app/editor/flight_desk.h"
#include "app/editor/layer_desk.h"
#include "app/editor/presets.h"
#include "app/editor/sweep_desk.h"
#include "app/editor/undo.h"
#include "app/editor/viewport.h"
#include "app/measure/cracks.h"
#include "app/measure/error_job.h"
#include "app/measure/pops.h"
#include "app/measure/surface_costs.h"
#include "app/scene/frame_stats.h"
#include "app/settings/settings.h"
#include "ui/model/editor_view.h"
#include "ui/shell/menu_bar.h"
#include "ui/shell/message_box.h"
#include "ui/shell/open_dialog.h"
#include "ui/shell/panels.h"

namespace worldy {

// The camera and the freezing of LOD before a place was inspected.
struct BeforeInspection {
    Camera camera;
    planet::View lodView;
    bool lodFrozen = false;
    bool replayPlaying = false;
};

// The state of the window from one frame to the next. Owns no window and no planet. Main thread.
struct Editor {
    Settings settings;

    std::optional<CameraRig> rig;       // once a planet is open
    std::optional<CameraRig> observer;  // once it was looked through
    CameraSettings observerControls;
    planet::View lodView;       // follows the camera but while frozen
    bool cameraJumped = false;  // in the last frame, for what measures pops
    bool lodFrozen = false;
    std::optional<BeforeInspection> beforeInspection;
    bool framesPaused = false;
    bool stepOneFrame = false;
    bool pagingPaused = false;
    Viewport viewport;
    ChunkFocus focus;
    std::shared_ptr<const int> lastScene;  // of the frame before, to see that another took its place
    double lastRadiusM = 0;

    double timeS = 0;  // since the window opened
    FrameStats stats;
    ui::AllocationsView allocations;
    std::deque<ui::FrameSample> history;
    planet::LodChanges changes;
    Pops pops;
    ui::ProbeView probe;
    std::deque<LogLine> logLines;
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
    std::optional<std::filesystem::path> opening;         // asked for, and not known to be open yet
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

}  // namespace worldy
