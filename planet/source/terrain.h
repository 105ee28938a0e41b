// Procedural terrain, and procedural detail below the resolution of any source: height sources like those
// from files.
//
// Sizes are degrees of arc seen from the planet's centre, so that a terrain has no radius of its own: on
// Earth a degree is 111 km. All kinds are functions of the direction or of the point of the cube alone, so
// they are seamless over faces, edges and corners, and bit-identical with any number of threads.
//
// The defaults are part of how files name their source (terrainText), so they stay as they are.
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

// Fractal Brownian motion: octaves of Perlin's gradient noise (gradient_noise.h), octave i at lacunarity^i
// times the frequency and gain^i times the height. An octave whose lattice is finer than two steps of the
// grid is left out.
struct FractalTerrain {
    std::uint32_t seed = 1;
    int octaves = 14;          // [1, 24]
    double lacunarity = 2;     // [1.2, 4]
    double gain = 0.52;        // [0, 0.95]
    double amplitudeM = 9000;  // all heights lie within offsetM +- this, five times their root mean square
    double featureDeg = 45;    // the first octave's lattice cell, degrees of arc; [0.01, 180]
    double offsetM = 0;        // added to every height
};

// Ridged multifractal (Musgrave in Ebert et al., "Texturing and Modeling", 3rd ed., 2003): octaves of (1 -
// |noise|)^2, each weighed by sharpness times the one before, so that ridges are rough and valleys smooth.
// The mean is subtracted, so that a coarse grid, which leaves octaves out, lies no lower than a fine one.
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
// Terrain Programming", 2003): count random planes cut the sphere, and plane i raises the ground on one side
// by faultDeltaM. Less half the sum of all, so that the mean is about offsetM.
//
// The books then run a filter y[i] = k y[i-1] + (1 - k) x[i] over the rows and the columns, there and back. A
// sphere has no rows, and a filter that runs over all samples before it depends on where a face begins. But
// across a straight fault, there and back, it makes of a step exactly
//     e^(x/w) / 2 left of the fault, 1 - e^(-x/w) / 2 right of it,  w = -spacing / ln k
// at the distance x: here each fault is that soft step, with x the arc to it. So it does not depend on the
// grid and has no direction and no seam. On a grid coarser than 2 w, w is half a grid step.
struct FaultTerrain {
    std::uint32_t seed = 1;
    int count = 600;          // n, [1, 20000]
    double maxDeltaM = 400;   // [0, 1e6]
    double minDeltaM = 20;    // [0, maxDeltaM]
    double smoothDeg = 0.15;  // w, degrees of arc; [0, 30]
    double offsetM = 0;
};
// dt = maxDelta - (maxDelta - minDelta) * i / n, metres; i from 0 to n - 1.
double faultDeltaM(const FaultTerrain& terrain, int i);

// Midpoint displacement (Fournier, Fussell and Carpenter, "Computer Rendering of Stochastic Models", CACM
// 1982) by diamonds and squares, from the cube's eight corners on. A cell's middle is the mean of its four
// corners, and an edge's of its two ends and the middles of the cells on both sides, over an edge of the cube
// too; each plus a random offset that is a hash of its point on the cube. With each halving the offsets
// shrink by 2^-(1 - roughness) (Saupe in "The Science of Fractal Images", 1988), so the surface's fractal
// dimension is 2 + roughness. It uses integers, whose sums do not depend on their order, so faces agree to
// the last bit. A finer grid keeps every height of a coarser one.
struct MidpointTerrain {
    std::uint32_t seed = 1;
    double roughness = 0.25;   // [0, 1]
    double amplitudeM = 9000;  // heights lie within offsetM +- this
    double offsetM = 0;
};

// Craters over fBm ground. Sizes halve from the largest on; those of a size are scattered by a hash of the
// cells of a lattice around the sphere, one a cell at most. A crater is a bowl with a raised rim and ejecta
// that thin out with the cube of the distance (Pike, "Size-dependence in the shape of fresh impact craters on
// the Moon", 1977: the rim stands a fifth as high as the bowl is deep); larger ones have a flat floor and a
// central peak. Sizes under four steps of the grid are left out.
struct CraterTerrain {
    std::uint32_t seed = 1;
    int sizes = 9;             // [1, 16]
    double largestDeg = 14;    // diameter of the largest, degrees of arc; [0.01, 60]
    double depthM = 4200;      // of the largest, from the ground around it, metres; [0, 1e5]
    double depthPower = 0.62;  // depth goes with diameter to this; [0.2, 1.5]
    double density = 0.55;     // share of the lattice's cells that hold a crater; [0, 1]
    int octaves = 12;          // of the ground; [1, 24]
    double gain = 0.5;         // [0, 0.95]
    double amplitudeM = 5000;  // of the ground, five times its root mean square; [0, 1e6]
    double featureDeg = 50;    // degrees of arc; [0.01, 180]
    double offsetM = 0;
};

// Detail below the resolution of another source: octaves of noise, the first with a lattice cell of the
// source's own grid step (of its natural face size), as high as strength times the source's relief there, the
// range of a sample and its eight neighbours. So rough ground gets rougher and flat ground stays flat. On
// grids up to the source's own nothing is added, to the last bit.
struct DetailTerrain {
    std::uint32_t seed = 1;
    int octaves = 6;        // [1, 16]: 6 make 76 m of Earth's 4.9 km
    double lacunarity = 2;  // [1.2, 4]
    double gain = 0.55;     // [0, 0.95]
    double strength = 1;    // 1 goes on as the source ends; [0, 8]
    double ridged = 0.5;    // 0: round, 1: ridges; [0, 1]
    double limitM = 1000;   // max height change, metres; [0, 1e5]
    double flatM = 15;      // relief up to this counts as flat, metres; [0, 1e5]
    double seaM = 0;        // the sea's level: below it detail fades out ...
    double coastM = 120;    // ... from this far above to this far below, metres; [0, 1e5]
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
    double usualLeast = 0;  // what a slider spans
    double usualMost = 0;
    bool whole = false;        // a whole number
    bool logarithmic = false;  // spans powers of ten: how a slider should go
    std::string_view about;    // what it means and what gets worse
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

// The Error names the setting, its value and its range.
Result<void> checkTerrain(const TerrainSettings& settings);

// The content of a terrain's text.
struct TerrainSource {
    TerrainSettings settings;
    std::filesystem::path of;  // of detail: the source that it is added to, a path or another terrain's text
};

// "noise:ridged,seed=7,amplitude_m=6000" or "detail:strength=0.8,of=PATH": the kind, then settings that are
// not the defaults, in any order, each once; of comes last and takes the rest. A text may replace any path.
// Returns whether a path is meant as a text, valid or not.
bool isTerrainText(const std::filesystem::path& path);
// The Error names the wrong part, and the nearest name or the range.
Result<TerrainSource> terrainFromText(const std::filesystem::path& text);
// Returns the shortest text from which terrainFromText gives the same source.
std::string terrainText(const TerrainSource& source);

// Returns the shortest text with an absolute path, which is enough to open the source again.
Result<std::string> wholeTerrainText(const std::filesystem::path& text);

// Makes the heights of the settings, which must not be detail; their text describes the source.
Result<HeightSource> makeTerrain(const TerrainSettings& settings);
// Adds detail to a source.
Result<HeightSource> amplified(HeightSource source, const DetailTerrain& detail);

}  // namespace planet
