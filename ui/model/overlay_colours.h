// What the colours of chunks mean, in the viewport, in the net of faces and in legends alike. Pure functions.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "planet/chunk_explanation.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/planet.h"
#include "ui/model/errors_view.h"
#include "ui/model/view_settings.h"

namespace ui {

// sRGB in [0, 1].
std::uint32_t packedColour(const glm::vec3& colour);  // opaque, as 0xAABBGGRR

glm::vec3 levelColour(int level);          // neighbouring levels are far apart in hue
glm::vec3 errorColour(double epsOverTau);  // green 0, yellow 1, red 2 and over
glm::vec3 rampColour(double share);        // dark blue 0 to light yellow 1: for amounts without a good or bad
glm::vec3 stateColour(planet::ChunkState state);

// Where a value stands on its scale, [0, 1].
double deltaShare(double deltaCM, double topM);  // logarithmic over the four decades below the top
double ageShare(double ageS, double topS);       // 1 just loaded, 0 at the top and older

// Returns the tints of what a selection draws, in its order; none where chunks are not coloured.
// measured: for ColourBy::Measured; a chunk that it does not know is grey.
std::vector<planet::gl::ChunkTint> chunkTints(const planet::Planet& planet,
                                              const planet::Selection& selection,
                                              const OverlaySettings& overlay, double tauPx,
                                              const ErrorMeasurement* measured = nullptr);

struct LegendEntry {
    glm::vec3 colour{0, 0, 0};
    std::string label;  // "3", "1.5 px", "12.5 m"
};
// What those tints mean, with units; empty where there are none.
struct Legend {
    std::string title;
    std::vector<LegendEntry> entries;
};
Legend legendOf(const OverlaySettings& overlay, double tauPx, std::uint32_t deepestLevel);

}  // namespace ui
