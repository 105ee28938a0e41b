// The optics of an air like the Earth's: what it takes from light on its way and what it scatters into it.
//   Bruneton and Neyret, "Precomputed Atmospheric Scattering" (EGSR 2008): the model; its coefficients and
//   the table of transmittance are those of Bruneton's revision of 2017 Hillaire, "A Scalable and Production
//   Ready Sky and Atmosphere Rendering Technique" (EGSR 2020): light scattered more than once as a closed
//   form in a small table, light scattered once summed along each ray
// Pure functions, any thread.
//
// Lengths are kilometres of an Earth: on another planet a kilometre is radius / 6371, so that small planets
// look alike. Heights are above the planet's radius. A rise is the cosine of a direction to the zenith.
// Colours are linear; the sun's light above the air is 1.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

namespace planet {

// What people turn.
struct AirSettings {
    double rayleigh = 1;   // molecules, which make the sky blue, in units of the Earth's; [0, 5]
    double haze = 1;       // dust and droplets (Mie), likewise; [0, 20]
    double ozone = 1;      // which keeps the zenith blue at dusk, likewise; [0, 5]
    double forward = 0.8;  // how far forward haze scatters: Mie's asymmetry g; [0, 0.95]
    double thickness = 1;  // heights over which air thins out, likewise; [0.25, 4]

    bool operator==(const AirSettings&) const = default;
};

inline constexpr double airRadiusKm = 6371;
inline constexpr double sunRadiusRad = 0.004654;  // half of what it covers of the sky

struct Atmosphere {
    glm::dvec3 rayleigh{5.802e-3, 13.558e-3, 33.1e-3};  // scattered a kilometre at height 0
    double rayleighHeightKm = 8;                        // over which it falls to 1 / e
    double hazeScattered = 3.996e-3;                    // a kilometre at height 0
    double hazeTaken = 4.44e-3;                         // what it scatters and what it swallows
    double hazeHeightKm = 1.2;
    double forward = 0.8;
    glm::dvec3 ozone{0.65e-3, 1.881e-3, 0.085e-3};  // swallowed a kilometre where it is densest
    double ozoneMiddleKm = 25;                      // there; none of it half its depth above and below
    double ozoneHalfKm = 15;
    double topKm = 100;
    double groundAlbedo = 0.2;  // of light that comes up again
};

Atmosphere atmosphereOf(const AirSettings& settings);

// Texels row by row, their middles on the table's edges. Slices of a volume follow each other.
struct AirTable {
    int width = 0;
    int height = 0;
    int depth = 1;
    std::vector<glm::vec4> texels;  // rgb; unused

    std::size_t bytesOnGpu() const { return 8 * texels.size(); }  // halves
};

struct AirTables {
    Atmosphere air;
    AirTable transmittance;  // from a height to the air's end: by its horizon distance and by height
    // Slice 0: light that arrives evenly from all sides where the sun stands so, scattered once or more
    // before, over the sun's. Slice 1: what a level square there gets from the sky. By sun and height.
    AirTable glow;
    AirTable sky;  // of the sky's light at height 0: by rise, by side from the sun, by the sun's rise

    std::size_t bytesOnGpu() const {
        return transmittance.bytesOnGpu() + glow.bytesOnGpu() + sky.bytesOnGpu();
    }
};

// On all cores; the same to the last bit on any number of them.
AirTables makeAirTables(const Atmosphere& air);

// What is left of light on its way from a height to the air's end or back, where no ground is in its way.
// By integration, which makes the table; the other one is the table's.
glm::dvec3 transmittanceBySteps(const Atmosphere& air, double heightKm, double rise, int steps);
glm::dvec3 transmittance(const AirTables& tables, double heightKm, double rise);

// What arrives of the sun's light: the same, but behind the ground there is none.
glm::dvec3 sunThrough(const AirTables& tables, double heightKm, double sunRise);

// The sky's light on a level square, over the sun's on one that faces it.
glm::dvec3 skyIrradiance(const AirTables& tables, double heightKm, double sunRise);

struct AirRay {
    double heightKm = 0;     // of its start, >= 0
    double rise = 1;         // its own
    double sunRise = 1;      // the sun's, at its start
    double sunAlongRay = 1;  // cosine between the two
    // To where light comes from. Infinite: to the air's end, or to the ground at height 0.
    double lengthKm = std::numeric_limits<double>::infinity();
};

struct AirLight {
    glm::dvec3 scattered{0};  // into the ray, over the sun's irradiance; radiance
    glm::dvec3 through{1};    // what is left of light from its end
};

// As shaders/air.glsl does it. steps >= 1.
AirLight lightAlong(const AirTables& tables, const AirRay& ray, int steps);

// The sky's light at height 0 by the table; below the horizon: the horizon's.
glm::dvec3 skyRadiance(const AirTables& tables, double rise, double sunRise, double sunAlongRay);

}  // namespace planet
