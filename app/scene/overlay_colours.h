// What the colours of chunks mean, in the viewport, in the net of faces and in legends alike. Pure functions.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/scene/error_measurement.h"
#include "app/settings/view_settings.h"
#include "planet/chunk_explanation.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/planet.h"

namespace worldy {

// sRGB in [0, 1].
std::uint32_t packedColour(const glm::vec3& colour);  // opaque, as 0xAABBGGRR

glm::vec3 levelColour(int level);          // neighbouring levels are far apart in hue
glm::vec3 errorColour(double epsOverTau);  // green 0, yellow 1, red 2 and over
glm::vec3 rampColour(double share);        // dark blue 0 to light yellow 1: for amounts without a good or bad
inline const glm::vec3 unmeasuredColour(0.5f);  // of a chunk without a measurement
glm::vec3 stateColour(planet::ChunkState state);

// Where a value stands on its scale, [0, 1].
inline constexpr double deltaDecades = 4;
double deltaShare(double deltaCM, double topM);  // logarithmic over the four decades below the top
double ageShare(double ageS, double topS);       // 1 just loaded, 0 at the top and older

// Returns the tints of what a selection draws, in its order; none where chunks are not coloured.
// measured: for ColourBy::Measured; a chunk that it does not know is grey.
std::vector<planet::gl::ChunkTint> chunkTints(const planet::Planet& planet,
                                              const planet::Selection& selection,
                                              const OverlaySettings& overlay, double tauPx,
                                              const ErrorMeasurement* measured = nullptr);

}  // namespace worldy
