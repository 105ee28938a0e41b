// Settings for drawing the ground and the sky (chunk_renderer.h), as plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "planet/surface/feature_use.h"
#include "planet/surface/layer_drawing.h"
#include "planet/surface/light_drawing.h"

namespace planet::gl {

// A colour blended over a drawn chunk, unlit and in front of the atmosphere: sRGB and opacity, [0, 255]. At
// opacity 255 the pixels are exactly this colour; at 0 they do not change.
struct ChunkTint {
    std::array<std::uint8_t, 4> rgba{};
};

// A colour of the height ramp. Colours are interpolated between stops and constant beyond the outer ones.
struct RampStop {
    double heightM = 0;         // above the sea level
    glm::vec3 colour{0, 0, 0};  // sRGB, [0, 1]

    bool operator==(const RampStop&) const = default;
};

enum class SkirtPaint : std::uint8_t { AsGround, Loud, LoudAlone };  // Loud: one glaring colour

enum class SurfaceColour : std::uint8_t { Image, HeightRamp };

inline constexpr std::size_t maxRampStops = 32;

struct RenderSettings {
    SurfaceColour surface = SurfaceColour::Image;  // Image falls back to HeightRamp if none is loaded
    double imageOpacity = 1;                       // of the image over the ramp, [0, 1]
    // On: the planet's own colours replace the image if setColours was given a pool.
    bool streamed = true;
    // The TileSettings::texelsPerPixel of streamed colours. Larger values are sharper and may shimmer.
    double texelsPerPixel = 1;
    // PlanetRenderer draws streamed colours from a clipmap with windows of this many texels per side: a power
    // of two, [smallestClipmapPx, largestClipmapPx] (planet/surface/colour_clipmap.h). Unset: from the tiles.
    // ChunkRenderer ignores it (setColourClipmap).
    std::optional<int> clipmapPx{};
    double rampTopM = 6000;  // the height ramp's highest band, metres, > 0; the sea is darkest as far below 0
    // Replace the built-in ramp if not empty; lowest first, at most maxRampStops. The built-in sea keeps its
    // colours unless a stop lies below the sea level.
    std::vector<RampStop> ramp;
    bool sea = true;       // ground below the sea level is sea; off: dry land, as on the Moon
    double seaLevelM = 0;  // metres above the planet's radius
    // Exaggeration of the drawn heights, > 0. Waves, and the height and slope ranges of layers, are not
    // exaggerated.
    double exaggeration = 1;
    bool wireframe = false;  // draws the mesh's lines over a dimmed surface
    bool outlines = false;   // draws the chunks' borders
    SkirtPaint skirtPaint = SkirtPaint::AsGround;
    // Moves edge vertices onto a coarser neighbour's edge (DrawItem::coarserBy), so that no skirt is needed.
    // Off: coarserBy is ignored, and an edge beside a coarser neighbour morphs like the rest of the chunk.
    bool stitched = false;
    bool cube = false;  // draws the unprojected cube, without atmosphere
    bool atmosphere = true;
    bool lighting = true;  // off: flat colour, no atmosphere
    // Adds procedural detail to near ground, between the samples of the heights and the image. It changes
    // lighting and colour only; no vertex moves. It is off with tints or without lighting, and where the
    // samples are finer than two pixels.
    FeatureUse detail = FeatureUse::Automatic;
    glm::dvec3 sunDirection{0.75, 0.45, 0.48};  // world, any length but 0
    LightDrawing light;
    // Materials on near ground that is not sea; their heights are relative to seaLevelM.
    LayerDrawing layers;
};

}  // namespace planet::gl
