// Measures the ground between two places that the user clicks: the ruler of the window. The heights between them are
// measured on a thread of their own, on a copy of the chunks of one frame. Main thread.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/measure/ground_profile.h"
#include "planet/planet.h"
#include "planet/sphere/view.h"

namespace worldy {

// The heights between the two ends, and the chunks that were drawn when they were measured.
struct MeasuredGround {
    planet::GroundProfile profile;
    planet::ProfileSummary summary;
    std::vector<planet::DrawItem> drawn;
    double exaggeration = 1;
};

struct Ruler {
    bool takesClicks = false;  // clicks on the ground place ends instead of selecting chunks
    std::vector<glm::dvec3>
        ends;  // at most two, where the drawn ground was clicked, metres from the planet's centre

    std::shared_ptr<planet::FinestHeights> heights{};  // of the current planet
    std::unique_ptr<Job<planet::Result<planet::GroundProfile>>> job{};
    MeasuredGround running{};  // without its profile
    std::optional<MeasuredGround> last{};
    bool current = false;  // last is of these ends and of the chunks of the last frame
    double startedAtS = 0;
    std::string problem{};                 // why the ground cannot be measured
    std::optional<std::size_t> pointed{};  // the point of the profile that the pictures of this frame mark
};

// Places the first end, then the second one; after both, begins again with the first.
void placeRulerEnd(Ruler& ruler, const glm::dvec3& positionM);
// Return and set the ends as places on the globe, which are kept for the next start. The poses' directions mean nothing, and
// at most two places are used.
std::vector<planet::CameraPose> rulerPlaces(const Ruler& ruler, double radiusM);
void setRulerPlaces(Ruler& ruler, std::span<const planet::CameraPose> places, double radiusM);
void swapRulerEnds(Ruler& ruler);
void clearRuler(Ruler& ruler);
// Call when another planet is shown. The ends stay at their latitudes and longitudes.
void forgetGround(Ruler& ruler);

// Takes a finished measurement, and starts one if the ends or the drawn chunks have changed, at most twice a second and
// only while no chunks load. Call once per frame after the selection.
void advanceRuler(const planet::Planet& planet, double timeS, Ruler& ruler);

// An end of the ruler in a picture.
struct RulerEndInPicture {
    std::optional<glm::dvec2> atPx{};  // from the top left; none behind the camera
    double pixelM = 0;  // length across the line of sight that covers a pixel in the middle, metres
};
RulerEndInPicture rulerEndIn(const planet::View& view, const glm::dvec3& endM);

// Returns the ruler's line over the finest ground, as far as it is measured, a post at each end, and a cross at the pointed
// point of the profile.
planet::Lines rulerLines(const Ruler& ruler, const planet::View& view, double radiusM);

}  // namespace worldy
