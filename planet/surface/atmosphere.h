// The optics of an Earth-like atmosphere: extinction and scattering of light. Pure functions, any thread.
//
//   Bruneton and Neyret, "Precomputed Atmospheric Scattering" (EGSR 2008): the model. Its coefficients and
//   its table of transmittance are those of Bruneton's revision of 2017.
//   Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (EGSR 2020): multiple
//   scattering in closed form in a small table; single scattering summed along each ray.
//
// Lengths are kilometres of the Earth: on another planet, one such kilometre is radius / 6371, so that small
// planets look alike. Heights are above the planet's radius. A rise is the cosine of a direction to the
// zenith. Colours are linear; the sun's light above the atmosphere is 1.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

namespace planet {

// The settings for users, as factors on the Earth's values unless noted.
struct AirSettings {
    double rayleigh = 1;   // scattering by molecules, which makes the sky blue; [0, 5]
    double haze = 1;       // dust and droplets (Mie); [0, 20]
    double ozone = 1;      // absorption that keeps the zenith blue at dusk; [0, 5]
    double forward = 0.8;  // Mie asymmetry g of haze: forward scattering; [0, 0.95]
    double thickness = 1;  // all scale heights; [0.25, 4]

    bool operator==(const AirSettings&) const = default;
};

inline constexpr double airRadiusKm = 6371;
inline constexpr double sunRadiusRad = 0.004654;  // angular radius

struct Atmosphere {
    glm::dvec3 rayleigh{5.802e-3, 13.558e-3, 33.1e-3};  // scattering, 1/km at height 0
    double rayleighHeightKm = 8;                        // height over which it falls to 1/e
    double hazeScattered = 3.996e-3;                    // scattering, 1/km at height 0
    double hazeTaken = 4.44e-3;                         // extinction, scattering and absorption, 1/km
    double hazeHeightKm = 1.2;
    double forward = 0.8;
    glm::dvec3 ozone{0.65e-3, 1.881e-3, 0.085e-3};  // absorption, 1/km at its densest
    double ozoneMiddleKm = 25;                      // height of the densest layer
    double ozoneHalfKm = 15;                        // distance from that height to zero density
    double topKm = 100;
    double groundAlbedo = 0.2;  // share of the light that the ground reflects
};

Atmosphere atmosphereOf(const AirSettings& settings);

// Texels are stored row by row; the centres of the outer texels lie on the table's edges. The slices of a
// volume follow each other.
struct AirTable {
    int width = 0;
    int height = 0;
    int depth = 1;
    std::vector<glm::vec4> texels;  // rgb; unused

    std::size_t bytesOnGpu() const { return 8 * texels.size(); }  // as half floats
};

struct AirTables {
    Atmosphere air;
    AirTable transmittance;  // from a height to the top of the atmosphere; by horizon distance and height
    // Slice 0: isotropic light that was scattered at least once, relative to the sun's. Slice 1: the sky's
    // irradiance on a level square. Both by sun and height.
    AirTable glow;
    AirTable sky;  // radiance of the sky at height 0: by rise, by angle from the sun, by the sun's rise

    std::size_t bytesOnGpu() const {
        return transmittance.bytesOnGpu() + glow.bytesOnGpu() + sky.bytesOnGpu();
    }
};

// Computes the tables on all cores. The result is bit-identical for any number of cores.
AirTables makeAirTables(const Atmosphere& air);

// Return the transmittance from a height to the top of the atmosphere, where no ground is in the way. The
// first one integrates, to make the table; the second one reads the table.
glm::dvec3 transmittanceBySteps(const Atmosphere& air, double heightKm, double rise, int steps);
glm::dvec3 transmittance(const AirTables& tables, double heightKm, double rise);

// Returns the transmittance of the sun's light; 0 behind the ground.
glm::dvec3 sunThrough(const AirTables& tables, double heightKm, double sunRise);

// Returns the sky's irradiance on a level square, relative to the sun's on a square that faces it.
glm::dvec3 skyIrradiance(const AirTables& tables, double heightKm, double sunRise);

struct AirRay {
    double heightKm = 0;     // of its start, >= 0
    double rise = 1;         // of the ray
    double sunRise = 1;      // of the sun, at the ray's start
    double sunAlongRay = 1;  // cosine between ray and sun
    // The length of the ray. Infinite: to the top of the atmosphere, or to the ground at height 0.
    double lengthKm = std::numeric_limits<double>::infinity();
};

struct AirLight {
    glm::dvec3 scattered{0};  // into the ray: radiance relative to the sun's irradiance
    glm::dvec3 through{1};    // transmittance from the ray's end
};

// Computes the light along a ray as shaders/air.glsl does. steps: >= 1.
AirLight lightAlong(const AirTables& tables, const AirRay& ray, int steps);

// Returns the sky's radiance at height 0, from the table. Below the horizon, it is the horizon's.
glm::dvec3 skyRadiance(const AirTables& tables, double rise, double sunRise, double sunAlongRay);

}  // namespace planet
