// Compares two planets in the window: A, which the window shows anyway, and B with settings of its own. Both
// are seen by A's camera and choose for A's LOD view. Wants the window's GL context current. Main thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/presets.h"
#include "app/editor/session.h"
#include "app/editor/settings_controller.h"
#include "app/editor/viewport.h"
#include "app/measure/comparison_job.h"
#include "app/measure/error_job.h"
#include "planet/gl/measure/picture_comparer.h"
#include "planet/measure/pop_meter.h"
#include "ui/model/commands.h"
#include "ui/model/compare_view.h"

namespace worldy {

// Measurements of either side while comparing.
struct ComparedMeters {
    planet::PopMeter pops;  // since comparing began
    std::uint64_t bytesReadBefore = 0;
    ErrorMeter errors;  // of the view last measured
    std::optional<CrackMeasurement> cracks;
};

struct ComparedOther {
    OpenPlanet planet;
    ViewSettings settings;  // camera, cracks and compare are A's
    std::string origin;     // "settings kept", "preset popping"
    FrameStats stats;       // smoothed
};

// The view and settings of the last measurement.
struct MeasuredOf {
    planet::View view;
    ViewSettings settings;
    ViewSettings settingsOfB;
};

// Returns the settings that a compared picture is drawn with: without the fill light.
inline ViewSettings comparedSettings(ViewSettings settings) {
    settings.surface.light.fill = 0;
    return settings;
}

// A flight that both are measured over, in the background.
struct ComparedFlight {
    std::unique_ptr<ComparisonJob> job{};
    std::optional<ComparedPair> last{};
    std::string name{};  // of the job that runs, or of the last one
    std::string problem{};
};

struct CompareController {
    std::optional<ComparedOther> other{};
    std::array<ComparedMeters, 2> meters{};
    std::shared_ptr<const int> lastScene{};  // of A, to see that another took its place
    std::optional<MeasuredOf> measuredOf{};
    std::string problem{};  // why there is no B
    // Asked for, and done with the next frame: this one still shows B's picture.
    bool ending = false;

    std::vector<SettingDifference> different{};
    std::optional<std::pair<ViewSettings, ViewSettings>> differentOf{};

    PlanetPicture picture{};  // B's
    std::optional<planet::gl::PictureComparer> comparer{};
    std::optional<planet::gl::RenderTarget> mixed{};
    std::optional<ui::PictureDifferenceNow> difference{};

    ComparedFlight flight{};
};

// Starts comparing. On an Error, which is also the controller's problem, the comparison before goes on.
planet::Result<void> startCompare(CompareController& controller, const Session& session,
                                  const PresetLibrary& presets, const ViewSettings& settings,
                                  const ui::StartCompare& wanted);
// Frees B's planet, its memory and its files. A flight that is being measured goes on.
void stopCompare(CompareController& controller);
// Call when A's planet was reset or went to another frame of a replay, which is no change of level.
void forgetPopsOfA(CompareController& controller);
// Swaps planets and settings of A and B, except the settings of the camera and the comparison. Returns A's.
ViewSettings swapCompared(CompareController& controller, Session& session, const ViewSettings& settings,
                          const Log& log);

// Runs one frame of B, after A has chosen its chunks. Ends comparing if A's planet has another radius by now.
struct CompareFrame {
    const Scene& a;
    const ViewSettings& settings;
    const planet::View& lodView;
    const planet::View& view;
    double timeS = 0;
    std::uint64_t frame = 0;
    bool cameraJumped = false;  // as of planet::PopConditions
    bool goesOn = true;         // false: frames are paused
    bool pagingPaused = false;
};
void stepCompared(CompareController& controller, const CompareFrame& now, const Log& log);

// Draws B as A's picture was just drawn, and what is shown of both into the main picture. counting: also
// counts the pixels that differ.
void drawCompared(CompareController& controller, Viewport& viewport, const ViewSettings& settings,
                  const ChunkFocus& focus, bool counting, const Log& log);

// Measures the cracks of this view, and the true error in the background, of both.
planet::Result<void> measureCompared(CompareController& controller, Scene& a, const ViewSettings& settings,
                                     const planet::View& view);

// The Error names the flight's file and what is wrong with it.
planet::Result<void> compareFlight(CompareController& controller, const Session& session,
                                   const ViewSettings& settings, const planet::View& view,
                                   const ui::CompareOverFlight& wanted);

// statsOfA: smoothed. Holds until the controller changes.
ui::CompareView compareViewOf(CompareController& controller, const Session& session,
                              const ViewSettings& settings, const FrameStats& statsOfA,
                              const planet::View& view);

std::size_t gpuBytes(const CompareController& controller);

// The parts of other features that commands of comparing use and change.
struct CompareContext {
    Session& session;
    SettingsController& settings;
    const planet::View* view;  // of the main picture; null while no planet was shown
    bool& stepOnce;            // as of FrameController
    bool replaying = false;    // then settings stay as they are
};
void execute(CompareController& controller, const ui::CompareCommand& command, const CompareContext& context,
             Notices& notices);

}  // namespace worldy
