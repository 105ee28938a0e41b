// All that panels may read, gathered once a frame by the application. Pointers and references hold for the
// frame.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/base/log_lines.h"
#include "app/data/worlds.h"
#include "app/scene/frame_stats.h"
#include "app/scene/overlay_lines.h"
#include "app/settings/setting_difference.h"
#include "app/settings/view_settings.h"
#include "planet/bake/bake_estimate.h"
#include "planet/measure/lod_changes.h"
#include "planet/planet.h"
#include "ui/model/allocations_view.h"
#include "ui/model/commands.h"
#include "ui/model/compare_view.h"
#include "ui/model/cracks_view.h"
#include "ui/model/errors_view.h"
#include "ui/model/layers_view.h"
#include "ui/model/light_view.h"
#include "ui/model/pops_view.h"
#include "ui/model/probe_view.h"
#include "ui/model/recording_view.h"
#include "ui/model/sweep_view.h"

namespace worldy::ui {

struct FrameSample {
    double timeS = 0;  // since the program began
    FrameStats stats;  // as measured, not smoothed
};

struct DataView {
    std::string name;                 // "elevation.tif"
    std::filesystem::path source;     // what was opened
    std::filesystem::path chunkFile;  // what is drawn
    bool hasColourImage = false;
    bool hasPreviousBake = false;  // kept for comparison
    bool showsPreviousBake = false;
    std::string previousName;                       // "33 vertices, 2049 samples, 5.1 MiB"
    std::string problem;                            // why there is nothing to show
    std::span<const std::filesystem::path> recent;  // files opened, newest first
};

// A shaded picture of a source.
struct SourcePreview {
    void* texture = nullptr;              // ImTextureID, top row first; null until there is one
    std::optional<PreviewRequest> shown;  // what it is of
    double lowM = 0;                      // of the heights in it
    double highM = 0;
    double seconds = 0;    // that it took
    bool working = false;  // another one is on its way
    std::string problem;   // why the last one could not be made
};

struct BakeView {
    BakeRequest current;            // what the open file was baked with, as far as it is known
    bool compressionKnown = false;  // of current: only what was baked in this session
    bool canBake = false;           // the source is known and there
    // What the open file's colours were made of, where it is not known where that lies: "colour.jpg, 2048 x
    // 1024 uint8, equirectangular".
    std::string lostColours{};
    std::optional<BakeRequest> running;
    bool stopping = false;  // cancelled, but not yet at its end
    planet::BakeProgress progress;
    std::string lastProblem;  // why the last bake came to nothing
    std::optional<planet::BakeReport> lastReport;
    bool estimating = false;
    std::optional<planet::BakeEstimate> estimate;  // of the request last asked about
    std::string estimateProblem;
    std::span<const World> worlds{};
    SourcePreview preview{};
};

struct Bookmark {
    std::string name;
    planet::CameraPose pose;
    bool shipped = false;  // came with Worldy and cannot be removed
};

struct FlightView {
    std::string name;
    double timeS = 0;
    double durationS = 0;
    bool paused = false;
};

struct CameraView {
    planet::CameraPose pose;
    std::optional<double> seaSurfaceM{};  // above the planet's radius, where it is drawn as water
    double speedFactor = 1;
    std::span<const Bookmark> bookmarks;
    std::span<const std::filesystem::path> flights;  // that can be followed
    std::optional<FlightView> flight;                // being followed
};

struct PresetView {
    std::string name;
    std::filesystem::path file{};
    std::string problem{};                         // why it cannot be read; empty: it can
    std::vector<SettingDifference> differences{};  // from the settings as they are
    bool shipped = false;                          // came with Worldy and cannot be deleted
};

struct EditorView {
    const planet::Planet* planet = nullptr;  // null while none is open
    const FrameStats& stats;                 // smoothed
    const std::deque<FrameSample>& history;  // the last 10 s, oldest first
    const planet::LodChanges& changes;
    const std::deque<LogLine>& log;
    planet::View lodView{};
    planet::View renderView{};
    bool lodFrozen = false;
    bool inspecting = false;  // EndInspection leads back
    bool framesPaused = false;
    bool pagingPaused = false;
    double timeS = 0;
    ChunkFocus focus{};
    DataView data{};
    BakeView bake{};
    CameraView camera{};
    std::span<const PresetView> presets{};
    std::string undoName{};  // "Tolerance τ 2 -> 3 px"; empty: nothing to undo
    std::string redoName{};
    ErrorsView errors{};
    CracksView cracks{};
    PopsView pops{};
    ProbeView probe{};
    RecordingView recording{};
    CompareView compare{};
    SweepView sweep{};
    LayersView layers{};
    LightView light{};
    AllocationsView allocations{};
};

}  // namespace worldy::ui
