// All data that panels may read, gathered once per frame by the application. Pointers and references are
// valid for the frame.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/base/log_lines.h"
#include "app/data/layout_library.h"
#include "app/data/worlds.h"
#include "app/measure/frame_timeline.h"
#include "app/scene/frame_stats.h"
#include "app/scene/overlay_lines.h"
#include "app/scene/steering.h"
#include "app/settings/setting_difference.h"
#include "app/settings/view_settings.h"
#include "planet/bake/bake_estimate.h"
#include "planet/bake/job/unit_feed.h"
#include "planet/measure/lod_changes.h"
#include "planet/planet.h"
#include "ui/model/allocations_view.h"
#include "ui/model/atlas_view.h"
#include "ui/model/commands.h"
#include "ui/model/compare_view.h"
#include "ui/model/cracks_view.h"
#include "ui/model/errors_view.h"
#include "ui/model/layers_view.h"
#include "ui/model/light_view.h"
#include "ui/model/notes_view.h"
#include "ui/model/pops_view.h"
#include "ui/model/probe_view.h"
#include "ui/model/recording_view.h"
#include "ui/model/ruler_view.h"
#include "ui/model/sources_view.h"
#include "ui/model/suggest_view.h"
#include "ui/model/sweep_view.h"
#include "ui/model/trace_view.h"

namespace worldy::ui {

struct FrameSample {
    double timeS = 0;  // seconds since the program began
    FrameStats stats;  // as measured, not smoothed
};

struct FramesView {
    const FrameStats& stats;                 // smoothed
    const std::deque<FrameSample>& history;  // the last 10 s, oldest first
    double timeS = 0;
    bool paused = false;
    const char* drawnBecause = "";  // completes "Frames are drawn because ..."
    bool fullSpeed = false;         // DrawAtFullSpeed
    int limit = 0;                  // most frames a second now; 0: none
    const FrameTimeline* timeline = nullptr;
    bool recordsTimeline = true;
    std::optional<std::int64_t> gpuClockErrorNs{};  // of the GPU's spans; unset: the GPU has no clock
};

struct DataView {
    std::string name;                 // "elevation.tif"
    std::filesystem::path source;     // the file that was opened
    std::filesystem::path chunkFile;  // the file that is drawn
    bool isFirstLook = false;         // a coarse bake, shown until the whole one is done
    bool hasColourImage = false;
    bool isReadingColourImage = false;  // the height ramp is drawn meanwhile
    bool hasPreviousBake = false;       // kept for comparison
    bool showsPreviousBake = false;
    std::string previousName;                       // "33 vertices, 2049 samples, 5.1 MiB"
    std::string problem;                            // why there is nothing to show
    std::span<const std::filesystem::path> recent;  // opened files, newest first
};

// A shaded preview of a source.
struct SourcePreview {
    void* texture = nullptr;              // ImTextureID, top row first; null until there is one
    std::optional<PreviewRequest> shown;  // the request that it shows
    double lowM = 0;                      // lowest height in the picture
    double highM = 0;
    double seconds = 0;    // rendering time
    bool working = false;  // another one is being made
    std::string problem;   // why the last one failed
};

struct BakeView {
    BakeRequest current;            // the open file's bake settings, as far as they are known
    bool compressionKnown = false;  // of current; only for bakes of this session
    bool canBake = false;           // the source is known and exists
    // Describes the source of the open file's colours if its path is unknown: "colour.jpg, 2048 x 1024 uint8,
    // equirectangular".
    std::string lostColours{};
    std::optional<BakeRequest> running;
    bool stopping = false;         // cancelled, but not finished yet
    planet::JobProgress progress;  // without units if the bake runs in this program
    std::string lastProblem;       // why the last bake failed
    std::optional<planet::BakeReport> lastReport;
    bool estimating = false;
    std::optional<planet::BakeEstimate> estimate;  // of the last EstimateBake
    std::string estimateProblem;
    std::span<const World> worlds{};
    SourcePreview preview{};
};

struct Bookmark {
    std::string name;
    planet::CameraPose pose;
    bool shipped = false;  // comes with Worldy and cannot be removed
};

struct FlightView {
    std::string name;
    double timeS = 0;
    double durationS = 0;
    bool paused = false;
};

// The devices that steer the camera, besides keyboard and mouse.
struct SteeringView {
    std::span<const SteeringState> devices{};  // that are connected
    double sensitivity = 1;
    bool inverted = false;
};

struct CameraView {
    planet::CameraPose pose;
    std::optional<double> seaSurfaceM{};  // metres above the planet's radius, if drawn as water
    double speedFactor = 1;
    std::span<const Bookmark> bookmarks;
    std::span<const std::filesystem::path> flights;  // the flights that can be followed
    std::optional<FlightView> flight;                // the flight being followed
    planet::View lodView;
    planet::View renderView;  // of the main picture
    bool lodFrozen = false;
    bool inspecting = false;  // EndInspection goes back
    SteeringView steering{};
};

struct PresetView {
    std::string name;
    std::filesystem::path file{};
    std::string problem{};                         // why it cannot be read; empty: it can
    std::vector<SettingDifference> differences{};  // from the current settings
    bool shipped = false;                          // comes with Worldy and cannot be deleted
};

struct SettingsView {
    std::span<const PresetView> presets{};
    std::string undoName{};  // "Tolerance τ 2 -> 3 px"; empty: nothing to undo
    std::string redoName{};
    std::span<const NamedLayout> layouts{};  // of the window
    bool hasUnsavedLayout = false;           // for RestoreLayout
    bool hasUnsavedRegions = false;
    std::filesystem::path regionsFile{};  // that SaveRegions writes
    std::string regionsQuestion{};        // what SaveRegions would destroy; empty: it asks nothing
    std::vector<std::string>
        quitQuestion{};  // regions files whose changes are lost if Worldy quits; empty: it does not
};

// Finished and running measurements of the planet.
struct InstrumentsView {
    const planet::LodChanges& changes;
    AllocationsView allocations{};
    AtlasView atlas{};
    CracksView cracks{};
    ErrorsView errors{};
    LightView light{};
    PopsView pops{};
    ProbeView probe{};
    RulerView ruler{};
    SuggestView suggest{};
};

// One member per feature, filled by its controller.
struct EditorView {
    const planet::Planet* planet = nullptr;  // null while none is open
    FramesView frames;
    const std::deque<LogLine>& log;
    bool pagingPaused = false;
    ChunkFocus focus{};
    std::optional<glm::dvec3>
        pointedM{};  // the drawn ground under the pointer, metres from the planet's centre
    DataView data{};
    BakeView bake{};
    CameraView camera{};
    SettingsView settings{};
    InstrumentsView instruments;
    RecordingView recording{};
    CompareView compare{};
    SweepView sweep{};
    LayersView layers{};
    SourcesView sources{};
    TraceView trace{};
    NotesView notes{};
};

}  // namespace worldy::ui
