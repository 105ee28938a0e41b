// Measures one viewpoint of an atlas on a planet of its own, in simulated time: the same numbers on any machine.
//
// The view is settled from the root chunks alone over the simulated disk of the paging settings. Then the errors and
// costs of what is drawn are read. Then the standard move is flown over the same disk: in 0.5 s, the eye moves ahead by
// its altitude above the ground, and in 0.5 s back, in 30 frames.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "planet/measure/atlas.h"
#include "planet/measure/ground_profile.h"
#include "planet/paging/finest_heights.h"
#include "planet/planet.h"

namespace planet {

// The settings of a survey, as the library takes them.
struct AtlasSettings {
    ViewInput input;        // its view is not used
    PagingSettings paging;  // its time must be Simulated
    double exaggeration = 1;
    std::vector<Region> regions{};
    bool stitched = false;         // edges are drawn with RenderSettings::stitched
    std::optional<double> seaM{};  // level of a sea that is drawn as water, metres above the radius
};

// The wall time that measuring has taken, seconds.
struct AtlasCosts {
    double groundS = 0;  // finding the height of the ground
    double settleS = 0;  // what is drawn and read, and the time until it is sharp
    double errorS = 0;   // true error
    double moveS = 0;    // pops and thrashes

    AtlasCosts& operator+=(const AtlasCosts& other);
};

// Measures viewpoints one after the other. One thread at a time.
class AtlasMeter {
public:
    // The planet must be open with the settings' paging, and have their exaggeration and regions. It and the heights, which
    // other meters may share, must outlive the meter.
    AtlasMeter(Planet& planet, FinestHeights& heights, const AtlasSurvey& survey,
               const AtlasSettings& settings);

    // eyeM: the altitude of the eye above the radius; by default, that of the grid above the ground or the sea. goOn is
    // called often; if it returns false, the result is an Error of kind Cancelled. Other Errors name the file and the chunk
    // that could not be read.
    Result<AtlasViewpoint> measure(const AtlasPlace& place, std::optional<double> eyeM,
                                   const std::function<bool()>& goOn);

    const AtlasCosts& costs() const { return costs_; }

private:
    Result<double> eyeOver(const AtlasPlace& place);
    View viewOf(const AtlasViewpoint& viewpoint) const;
    void step(const View& view, double elapsedS);
    Result<void> measureStill(const View& view, AtlasFigures& figures, const std::function<bool()>& goOn);
    Result<void> measureMove(const View& view, double aheadM, AtlasFigures& figures,
                             const std::function<bool()>& goOn);

    Planet& planet_;
    FinestHeights& heights_;
    const AtlasSurvey& survey_;
    const AtlasSettings& settings_;
    ProfileGround ground_;  // of the roots alone
    AtlasCosts costs_;
};

}  // namespace planet
