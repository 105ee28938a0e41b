// The window's comparison: B, a second planet with settings of its own, beside A, which is what the window
// shows anyway. Both are seen by A's camera and choose for A's lod view. Wants the window's GL context
// current; one thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/presets.h"
#include "app/editor/session.h"
#include "app/editor/viewport.h"
#include "app/measure/comparison_job.h"
#include "app/measure/error_job.h"
#include "planet/gl/measure/picture_comparer.h"
#include "planet/measure/pop_meter.h"
#include "ui/model/commands.h"
#include "ui/model/compare_view.h"

namespace worldy {

// What is kept of either side while comparing.
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

// What was measured last was measured of.
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

struct CompareDesk {
    std::optional<ComparedOther> other{};
    std::array<ComparedMeters, 2> meters{};
    std::shared_ptr<const int> lastScene{};  // of A, to see that another took its place
    std::optional<MeasuredOf> measuredOf{};
    std::string problem{};  // why there is no B
    // Asked for; done with the next frame, since what is shown in this one still uses B's picture.
    bool ending = false;

    std::vector<SettingDifference> different{};
    std::optional<std::pair<ViewSettings, ViewSettings>> differentOf{};

    PlanetPicture picture{};  // B's
    std::optional<planet::gl::PictureComparer> comparer{};
    std::optional<planet::gl::RenderTarget> mixed{};
    std::optional<ui::PictureDifferenceNow> difference{};

    std::unique_ptr<ComparisonJob> job{};
    std::optional<ComparedPair> flown{};
    std::string flownName{};  // of the job that runs, or of what has flown
    std::string flownProblem{};
};

// On an Error, which is also the desk's problem, what was compared before stays.
planet::Result<void> startCompare(CompareDesk& desk, const Session& session, const PresetShelf& presets,
                                  const ViewSettings& settings, const ui::StartCompare& wanted);
// Gives back B's planet, its memory and its files. A flight that is measured goes on.
void stopCompare(CompareDesk& desk);
// A's planet has begun anew or gone to another frame of a replay: what it does then is no change of level.
void forgetPopsOfA(CompareDesk& desk);
// A gets B's settings, but for those of the camera and of the comparison, and its planet; and the other way
// round. Returns A's.
ViewSettings swapCompared(CompareDesk& desk, Session& session, const ViewSettings& settings, const Log& log);

// One frame of B, after A has chosen its chunks. Ends comparing where A's planet has become one of another
// radius.
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
void stepCompared(CompareDesk& desk, const CompareFrame& now, const Log& log);

// Draws B as A's picture was just drawn, and what is shown of both into the main picture. counting: also
// counts the pixels that differ.
void drawCompared(CompareDesk& desk, Viewport& viewport, const ViewSettings& settings,
                  const ChunkFocus& focus, bool counting, const Log& log);

// True error, in the background, and cracks of this view, of both.
planet::Result<void> measureCompared(CompareDesk& desk, Scene& a, const ViewSettings& settings,
                                     const planet::View& view);

// The Error names the flight's file and what is wrong with it.
planet::Result<void> compareFlight(CompareDesk& desk, const Session& session, const ViewSettings& settings,
                                   const planet::View& view, const ui::CompareOverFlight& wanted);

// statsOfA: smoothed. Holds until the desk changes.
ui::CompareView compareViewOf(CompareDesk& desk, const Session& session, const ViewSettings& settings,
                              const FrameStats& statsOfA, const planet::View& view);

std::size_t gpuBytes(const CompareDesk& desk);

}  // namespace worldy
