// Measures a candidate of a suggestion over flights, recordings and viewpoints, in simulated time: the same figures on any
// machine. Draws nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/flight/flight_path.h"
#include "app/flight/flight_record.h"
#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "app/suggest/frame_cost.h"
#include "app/suggest/suggest_search.h"
#include "planet/measure/atlas.h"
#include "planet/planet.h"
#include "planet/sphere/view.h"

namespace worldy {

// A frame to measure. A pose above the ground, or a whole view that is taken as it is.
struct SuggestFrame {
    planet::View view;
    bool keepsClear = false;  // the eye is lifted above the resident ground, as the camera of the window is
    double elapsedS = 0;      // since the frame before
};

// Frames that follow each other, or viewpoints.
struct SuggestLeg {
    std::string name;         // for users
    bool isFlown = false;     // its frames follow each other in time; otherwise each is settled on its own
    bool isRecorded = false;  // its views have sizes of their own
    std::vector<SuggestFrame> frames;  // at least one
};
// Returns the frames of a flight, one every stepS seconds, > 0. The Error is that of flightViews.
planet::Result<SuggestLeg> legOf(const FlightPath& path, double stepS, double radiusM, double fovDeg,
                                 const PictureSize& size);
// Returns the frames of a recording with the views that it holds.
SuggestLeg legOf(const FlightRecord& record);
// Returns the viewpoints of an atlas.
SuggestLeg legOf(const planet::Atlas& atlas);

// The percentile of the frames of a flight that must meet the budgets. Of viewpoints, each must.
inline constexpr double suggestShare = 0.999;

// A view that is not loaded after this time of the simulated disk is not waited for, in seconds.
inline constexpr double suggestSettleS = 120;

// A frame with a large value.
struct SuggestWorst {
    std::size_t leg = 0;
    std::size_t frame = 0;
    planet::View view;
    double value = 0;
};

// The figures of a measurement, and what they come from.
struct SuggestMeasured {
    SuggestFigures figures;
    std::vector<SuggestValues> byLeg;  // at the percentile, in the order of the legs
    std::array<std::vector<SuggestWorst>, suggestLimitCount>
        worst;  // by limit, of places apart from each other, the worst first; empty in a sample
};

// The ground of a drawn chunk.
struct SuggestGround {
    glm::dvec3 direction{0, 0, 1};  // of its middle, of length 1
    double angleRad = 0;            // from there to its corners
    double heightM = 0;  // of its middle between lowest and highest, above the radius, without exaggeration
};

// Returns the planet's regions, and those of a candidate, whose names must differ. If the planet's are switched off, each of
// them is switched off by itself, so that those of the candidate can apply and none is lost.
RegionSettings regionsWith(const RegionSettings& now, const std::vector<planet::Region>& more);
// The settings of now with those of a candidate.
ViewSettings settingsWith(const ViewSettings& now, const SuggestCandidate& candidate);
// Returns the candidate that the settings of now are.
SuggestCandidate candidateOf(const ViewSettings& now);

// Returns an upper bound of the distance between the drawn surface and the finest data, in pixels: the drawn bound
// (planet/select/drawn_bound.h) by the tight metric, whatever metric has selected. So selections by both compare.
double drawnErrorPx(const planet::ChunkTree& tree, const planet::Selection& selection,
                    const planet::View& view, const planet::LodSettings& lod);

// Measures with one planet, one candidate after the other. One thread at a time.
class SuggestMeter {
public:
    // now: settings that do not vary; its budgets of the governor count as off. cost: without one, frame times are not
    // known.
    SuggestMeter(std::unique_ptr<planet::Planet> planet, ViewSettings now, std::vector<SuggestLeg> legs,
                 std::optional<FrameCost> cost);

    // goOn is called for each frame with the share that is done, [0, 1]. Returning false ends with an Error of kind
    // Cancelled. Other Errors are of settings that the planet refuses.
    planet::Result<SuggestMeasured> measure(const SuggestCandidate& candidate, SuggestScope scope,
                                            const std::function<bool(double share)>& goOn);

    // Returns the ground of each chunk that a candidate draws from a settled view. The Error says that it was not loaded
    // within suggestSettleS.
    planet::Result<std::vector<SuggestGround>> groundIn(const SuggestCandidate& candidate,
                                                        const planet::View& view);

    const std::vector<SuggestLeg>& legs() const { return legs_; }
    const planet::Planet& planet() const { return *planet_; }

private:
    planet::Result<void> apply(const ViewSettings& settings);

    std::unique_ptr<planet::Planet> planet_;
    ViewSettings now_;
    std::vector<SuggestLeg> legs_;
    std::optional<FrameCost> cost_;
};

}  // namespace worldy
