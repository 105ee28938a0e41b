// Compares two planets in the window: A, which the window shows, and B with its own settings. Both are seen
// by A's camera and selected for A's LOD view. Needs the window's GL context current. Main thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/settings_controller.h"
#include "app/editor/viewport.h"
#include "app/measure/comparison_job.h"
#include "app/measure/error_job.h"
#include "app/measure/kept_results.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "app/settings/session_file.h"
#include "planet/gl/measure/picture_comparer.h"
#include "planet/measure/pop_meter.h"
#include "ui/model/commands.h"
#include "ui/model/compare_view.h"

namespace worldy {

// The measurements of one planet while comparing.
struct ComparedMeters {
    planet::PopMeter pops;  // since comparing began
    std::uint64_t bytesReadBefore = 0;
    ErrorMeter errors;  // of the last measured view
    std::optional<CrackMeasurement> cracks;
};

struct ComparedOther {
    OpenPlanet planet;
    ViewSettings settings;  // camera, cracks and compare are A's
    std::string origin;     // "snapshot", "preset popping"
    FrameStats stats;       // smoothed
};

// The view and settings of the last measurement.
struct MeasuredOf {
    planet::View view;
    ViewSettings settings;
    ViewSettings settingsOfB;
};

// Returns the settings that compared pictures are drawn with: without the fill light.
inline ViewSettings comparedSettings(ViewSettings settings) {
    settings.surface.light.fill = 0;
    return settings;
}

// A flight over which both planets are measured in the background.
struct ComparedFlight {
    std::unique_ptr<ComparisonJob> job{};
    std::optional<ComparedPair> last{};
    std::string name{};                 // of the running job, or of the last one
    std::vector<MeasuredFile> files{};  // of A and B, as they were when it began
    std::string problem{};
    bool cancelled = false;  // the problem is that the user cancelled
};

struct CompareController {
    std::optional<ComparedOther> other{};
    std::array<ComparedMeters, 2> meters{};
    std::shared_ptr<const int> lastScene{};  // A's; to detect that another planet is shown
    std::optional<MeasuredOf> measuredOf{};
    std::string problem{};  // why there is no B
    // Comparing ends in the next frame, because this one still shows B's picture.
    bool ending = false;

    std::vector<SettingDifference> different{};
    std::optional<std::pair<ViewSettings, ViewSettings>> differentOf{};

    PlanetPicture picture{};  // of B
    std::optional<planet::gl::PictureComparer> comparer{};
    std::optional<planet::gl::RenderTarget> mixed{};
    std::optional<ui::PictureDifferenceNow> difference{};

    ComparedFlight flight{};
};

// Starts comparing. On an Error, which is also stored as the controller's problem, the previous comparison
// continues.
planet::Result<void> startCompare(CompareController& controller, const Session& session,
                                  const PresetLibrary& presets, const ViewSettings& settings,
                                  const ui::StartCompare& wanted);
// Returns what the next start can compare A with.
LastComparison lastComparisonOf(const ComparedOther& other, const OpenPlanet& a);
// Compares again as in the last session; fails like startCompare().
planet::Result<void> resumeCompare(CompareController& controller, const Session& session,
                                   const LastComparison& last, const ViewSettings& settings);
// Frees B's planet, its memory and its files. The measurement of a flight continues.
void stopCompare(CompareController& controller);
// Call when A's planet was reset or a replay jumped; the change of chunks is then no level change.
void forgetPopsOfA(CompareController& controller);
// Swaps the planets and settings of A and B, except the settings of the camera and the comparison. Returns
// A's.
ViewSettings swapCompared(CompareController& controller, Session& session, const ViewSettings& settings);

// Runs one frame of B, after A has chosen its chunks. Ends comparing if A's planet now has another radius.
struct CompareFrame {
    const Scene& a;
    const ViewSettings& settings;
    const planet::View& lodView;
    const planet::View& view;
    double timeS = 0;
    std::uint64_t frame = 0;
    bool cameraJumped = false;  // PopConditions::cameraJumped
    bool goesOn = true;         // false: frames are paused
    bool pagingPaused = false;
};
void stepCompared(CompareController& controller, const CompareFrame& now, const Log& log);

// Draws B with A's view, and both pictures mixed into the main picture. counting: also counts the pixels that
// differ.
void drawCompared(CompareController& controller, Viewport& viewport, const ViewSettings& settings,
                  const ChunkFocus& focus, bool counting, const Log& log);

// Measures cracks and true error of both in this view, the error in the background.
planet::Result<void> measureCompared(CompareController& controller, Scene& a, const ViewSettings& settings,
                                     const planet::View& view);

// Starts measuring both over a flight. The Error names the flight's file and what is wrong with it.
planet::Result<void> compareFlight(CompareController& controller, const Session& session,
                                   const ViewSettings& settings, const planet::View& view,
                                   const ui::CompareOverFlight& wanted);

// Adds the figures over the last flight to the results that the next start shows again. Call while none is measured.
void keepResults(const ComparedFlight& flight, KeptResults& kept);
// Shows them again, unless a file has changed since; the flight's problem and the log then say so.
void restoreResults(ComparedFlight& flight, const KeptResults& kept, const Log& log);

// statsOfA: smoothed. Valid until the controller changes.
ui::CompareView compareViewOf(CompareController& controller, const Session& session,
                              const ViewSettings& settings, const FrameStats& statsOfA,
                              const planet::View& view);

std::size_t gpuBytes(const CompareController& controller);

// Parts of other features that comparison commands use and change.
struct CompareContext {
    Session& session;
    SettingsController& settings;
    const planet::View* view;  // of the main picture; null if no planet was shown
    bool& stepOnce;            // FrameController::stepOnce
    bool replaying = false;    // settings then stay as they are
};
void execute(CompareController& controller, const ui::CompareCommand& command, const CompareContext& context,
             Notices& notices);

}  // namespace worldy
