// The colours of chunks in the viewport, the net of faces and the legends. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/data/leaf_depths.h"
#include "app/scene/atlas_drape.h"
#include "app/scene/error_measurement.h"
#include "app/scene/source_tops.h"
#include "app/settings/view_settings.h"
#include "planet/chunk_explanation.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/planet.h"

namespace worldy {

// Colours are sRGB in [0, 1].
std::uint32_t packedColour(const glm::vec3& colour);  // opaque, as 0xAABBGGRR
std::array<std::uint8_t, 4> colourBytes(const glm::vec3& colour, std::uint8_t opacity);

glm::vec3 levelColour(int level);          // adjacent levels differ in hue
glm::vec3 errorColour(double epsOverTau);  // green 0, yellow 1, red 2 and over
glm::vec3 rampColour(double share);        // dark blue 0, light yellow 1: for neutral quantities
glm::vec3 changeColour(double share);      // light blue 0, dark grey 0.5, light orange 1: better, same, worse
inline const glm::vec3 unmeasuredColour(0.5f);  // for chunks without a measurement
glm::vec3 stateColour(planet::ChunkState state);

// Return the position of a value on its scale, [0, 1].
inline constexpr double deltaDecades = 4;
double deltaShare(double deltaCM, double topM);        // logarithmic over the four decades below the top
double ageShare(double ageS, double topS);             // 1: just loaded, 0: topS or older
double spacingShare(int leafLevel, int deepestLevel);  // 1: the finest samples of the planet; logarithmic
// Returns the mean distance in metres between the samples of the leaves of a level, which may be a fraction.
double leafSpacingM(const planet::PlanetShape& shape, double level);

glm::vec3 layerColour(std::size_t layer);     // of the source; neighbours differ in hue
inline const glm::vec3 noLayerColour(0.25f);  // for chunks in whose middle no layer has a height

// Returns the colour of a region, by its place in the list.
glm::vec3 regionColour(std::size_t region);
inline const glm::vec3 noRegionColour(0.35f);  // for chunks about which no region decides
// Returns the colour of a chunk: that of the region that decides about it, mixed with noRegionColour in the soft border.
glm::vec3 demandColour(const planet::ChunkTree& tree, const planet::ChunkDemand& demand);

// Returns the colour of a value on the scale of an atlas.
glm::vec3 drapeColour(const AtlasDrape& drape, double value);
inline const glm::vec3 unboundedColour(0.86f, 0.14f, 0.12f);  // where there is no bound, or it was lost
inline const glm::vec3 gainedColour(0.12f, 0.75f, 0.65f);     // where a bound was gained
// Returns the colour of a chunk by an atlas; grey where the atlas is null or has no value.
glm::vec3 atlasColour(const AtlasDrape* atlas, const planet::ChunkId& chunk);

// Some tints depend on these; the chunks are grey where one is null.
struct TintData {
    const ErrorMeasurement* measured = nullptr;  // for ColourBy::Measured
    const LeafDepths* depths = nullptr;          // for ColourBy::LeafDepth and Spacing
    const SourceTops* tops = nullptr;            // for ColourBy::Source
    const AtlasDrape* atlas = nullptr;           // for ColourBy::Atlas
};

// Returns the tints of the drawn chunks of a selection, in its order; none if chunks are not coloured. Chunks of which
// the data says nothing are grey.
std::vector<planet::gl::ChunkTint> chunkTints(const planet::Planet& planet,
                                              const planet::Selection& selection,
                                              const OverlaySettings& overlay, double tauPx,
                                              const TintData& data = {});

}  // namespace worldy
