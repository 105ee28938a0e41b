// Procedural terrain, and procedural detail below the resolution of any source. Both are height sources like
// those from files.
//
// Sizes are degrees of arc seen from the planet's centre, so that a terrain does not depend on a radius: on
// Earth one degree is 111 km. All kinds are functions of only the direction or the point of the cube. So they
// are seamless over faces, edges and corners, and bit-identical with any number of threads.
//
// Files name their source by terrainText, which omits defaults. So the defaults must not change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "planet/base/result.h"
#include "planet/source/height_source_types.h"

namespace planet {

// Fractal Brownian motion: octaves of Perlin's gradient noise (gradient_noise.h). Octave i has lacunarity^i
// times the frequency and gain^i times the height. An octave whose lattice is finer than two steps of the
// grid is omitted.
struct FractalTerrain {
    std::uint32_t seed = 1;
    int octaves = 14;          // [1, 24]
    double lacunarity = 2;     // [1.2, 4]
    double gain = 0.52;        // [0, 0.95]
    double amplitudeM = 9000;  // all heights lie within offsetM +- this, 5 times their root mean square
    double featureDeg = 45;    // the first octave's lattice cell, degrees of arc; [0.01, 180]
    double offsetM = 0;        // added to every height
};

// Ridged multifractal (Musgrave in Ebert et al., "Texturing and Modeling", 3rd ed., 2003): octaves of (1 -
// |noise|)^2, each weighted by sharpness times the one before, so that ridges are rough and valleys smooth.
// The mean is subtracted, so that a coarse grid, which omits octaves, is no lower than a fine one.
struct RidgedTerrain {
    std::uint32_t seed = 1;
    int octaves = 13;          // [1, 24]
    double lacunarity = 2.1;   // [1.2, 4]
    double gain = 0.5;         // [0, 0.95]
    double sharpness = 2;      // [0, 8]
    double amplitudeM = 9000;  // heights lie from offsetM - 1.8 times this to offsetM + this
    double featureDeg = 35;    // degrees of arc; [0.01, 180]
    double offsetM = 0;
};

// Fault formation (Krten, "Generating Realistic Terrain", Dr. Dobb's Journal, July 1994; Polack, "Focus on 3D
// Terrain Programming", 2003): `count` random planes cut the sphere, and plane i raises the ground on one
// side by faultDeltaM. Half the sum of all is subtracted, so that the mean is about offsetM.
//
// The books then run a filter y[i] = k y[i-1] + (1 - k) x[i] along rows and columns, in both directions. A
// sphere has no rows, and a filter over all previous samples depends on where a face begins. But across a
// straight fault, the filter in both directions turns a step into exactly
//     e^(x/w) / 2 left of the fault, 1 - e^(-x/w) / 2 right of it,  w = -spacing / ln k
// at the distance x. Here each fault is this soft step, with x the arc to the fault. So it does not depend on
// the grid and has no direction and no seam. On a grid coarser than 2 w, w is half a grid step.
struct FaultTerrain {
    std::uint32_t seed = 1;
    int count = 600;          // n, [1, 20000]
    double maxDeltaM = 400;   // [0, 1e6]
    double minDeltaM = 20;    // [0, maxDeltaM]
    double smoothDeg = 0.15;  // w, degrees of arc; [0, 30]
    double offsetM = 0;
};
// Returns maxDelta - (maxDelta - minDelta) * i / n, metres; i: [0, n - 1].
double faultDeltaM(const FaultTerrain& terrain, int i);

// Midpoint displacement (Fournier, Fussell and Carpenter, "Computer Rendering of Stochastic Models", CACM
// 1982) by the diamond-square scheme, starting from the cube's eight corners. A cell's middle is the mean of
// its four corners. An edge's middle is the mean of its two ends and the middles of the cells on both sides,
// also across an edge of the cube. To each a random offset is added, a hash of its point on the cube. With
// each halving the offsets shrink by 2^-(1 - roughness) (Saupe in "The Science of Fractal Images", 1988), so
// the surface's fractal dimension is 2 + roughness. It uses integers, whose sums do not depend on their
// order, so faces are bit-identical. A finer grid keeps every height of a coarser one.
struct MidpointTerrain {
    std::uint32_t seed = 1;
    double roughness = 0.25;   // [0, 1]
    double amplitudeM = 9000;  // heights lie within offsetM +- this
    double offsetM = 0;
};

// Craters over fBm ground. Sizes halve from the largest on. Craters of one size are scattered by a hash of
// the cells of a lattice around the sphere, at most one per cell. A crater is a bowl with a raised rim, and
// ejecta that thin out with the cube of the distance (Pike, "Size-dependence in the shape of fresh impact
// craters on the Moon", 1977: the rim is a fifth as high as the bowl is deep). Larger ones have a flat floor
// and a central peak. Sizes below four steps of the grid are omitted.
struct CraterTerrain {
    std::uint32_t seed = 1;
    int sizes = 9;             // [1, 16]
    double largestDeg = 14;    // diameter of the largest crater, degrees of arc; [0.01, 60]
    double depthM = 4200;      // of the largest crater, below the ground around it, metres; [0, 1e5]
    double depthPower = 0.62;  // exponent of depth over diameter; [0.2, 1.5]
    double density = 0.55;     // share of the lattice's cells with a crater; [0, 1]
    int octaves = 12;          // of the ground; [1, 24]
    double gain = 0.5;         // [0, 0.95]
    double amplitudeM = 5000;  // of the ground, 5 times its root mean square; [0, 1e6]
    double featureDeg = 50;    // degrees of arc; [0.01, 180]
    double offsetM = 0;
};

// Detail below the resolution of another source: octaves of noise. The first has a lattice cell of the
// source's own grid step (of its natural face size). Its height is strength times the source's local relief,
// the range of a sample and its eight neighbours. So rough ground becomes rougher and flat ground stays flat.
// On grids up to the source's own, heights are unchanged bit for bit.
struct DetailTerrain {
    std::uint32_t seed = 1;
    int octaves = 6;        // [1, 16]: 6 octaves refine Earth's 4.9 km to 76 m
    double lacunarity = 2;  // [1.2, 4]
    double gain = 0.55;     // [0, 0.95]
    double strength = 1;    // 1 continues the source's roughness; [0, 8]
    double ridged = 0.5;    // 0: round, 1: ridged; [0, 1]
    double limitM = 1000;   // largest height change, metres; [0, 1e5]
    double flatM = 15;      // relief below this counts as flat, metres; [0, 1e5]
    double seaM = 0;        // sea level, metres; detail fades out towards the sea
    double coastM = 120;  // the fade begins this far above seaM and ends this far below it, metres; [0, 1e5]
};

using TerrainSettings =
    std::variant<FractalTerrain, RidgedTerrain, FaultTerrain, MidpointTerrain, CraterTerrain, DetailTerrain>;

// A setting, for texts, checks and panels.
struct TerrainField {
    std::string_view name;   // "amplitude_m"
    std::string_view label;  // "Amplitude"
    std::string_view unit;   // "m"; empty: a plain number
    double least = 0;
    double most = 0;
    double usualLeast = 0;  // range of a slider
    double usualMost = 0;
    bool whole = false;        // an integer
    bool logarithmic = false;  // sliders are logarithmic
    std::string_view about;    // its meaning and its costs
    double (*get)(const TerrainSettings& settings) = nullptr;
    void (*set)(TerrainSettings& settings, double value) = nullptr;
};

struct TerrainKind {
    std::string_view name;   // "noise:fbm", "detail"
    std::string_view title;  // "Perlin fBm"
    std::string_view about;
    TerrainSettings defaults;
    std::span<const TerrainField> fields;
};
// Returns the kinds in the order of the variant.
std::span<const TerrainKind> terrainKinds();
const TerrainKind& kindOf(const TerrainSettings& settings);

// Checks the ranges. The Error names the setting, its value and its range.
Result<void> checkTerrain(const TerrainSettings& settings);

// The content of a terrain text.
struct TerrainSource {
    TerrainSettings settings;
    std::filesystem::path of;  // only for detail: the source to add it to, a path or another terrain text
};

// Returns whether a path is meant as a terrain text, valid or not. A text may replace any path. It is
// "noise:ridged,seed=7,amplitude_m=6000" or "detail:strength=0.8,of=PATH": the kind, then settings that
// differ from the defaults, in any order, each once. `of` comes last and takes the rest of the text.
bool isTerrainText(const std::filesystem::path& path);
// Parses a text. The Error names the wrong part, and the nearest name or the range.
Result<TerrainSource> terrainFromText(const std::filesystem::path& text);
// Returns the shortest text for which terrainFromText returns the same source.
std::string terrainText(const TerrainSource& source);

// Returns the shortest text with an absolute path, with which the source can be opened again.
Result<std::string> wholeTerrainText(const std::filesystem::path& text);

// Makes the terrain of the settings, which must not be detail. Its text is the source's description.
Result<HeightSource> makeTerrain(const TerrainSettings& settings);
// Adds detail to a source.
Result<HeightSource> amplified(HeightSource source, const DetailTerrain& detail);

}  // namespace planet
