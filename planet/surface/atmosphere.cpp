#include "planet/surface/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <numbers>

#include "planet/base/parallel.h"

namespace planet {

namespace {

using std::numbers::pi;

constexpr int transmittanceWidth = 256;
constexpr int transmittanceHeight = 64;
constexpr int transmittanceSteps = 40;
constexpr int glowSize = 32;  // texels of suns and of heights
constexpr int glowSteps = 20;
constexpr int glowRises = 8;  // rises of directions over the whole sphere
constexpr int glowSides = 8;
constexpr int skyRises = 32;
constexpr int skySides = 24;
constexpr int skySteps = 24;

// The densities at a height, relative to the densest.
struct Density {
    double rayleigh, haze, ozone;
};

Density densityAt(const Atmosphere& air, double heightKm) {
    const double height = std::max(heightKm, 0.0);
    return {std::exp(-height / air.rayleighHeightKm), std::exp(-height / air.hazeHeightKm),
            std::max(1 - std::abs(height - air.ozoneMiddleKm) / air.ozoneHalfKm, 0.0)};
}

glm::dvec3 takenAt(const Atmosphere& air, const Density& density) {
    return air.rayleigh * density.rayleigh + glm::dvec3(air.hazeTaken * density.haze) +
           air.ozone * density.ozone;
}

double rayleighPhase(double cosine) {
    return 3 / (16 * pi) * (1 + cosine * cosine);
}

// Returns the phase function of Cornette and Shanks.
double hazePhase(double g, double cosine) {
    const double spread = 1 + g * g - 2 * g * cosine;
    return 3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) / ((2 + g * g) * spread * std::sqrt(spread));
}

// The part of a ray inside the atmosphere. Height and rise are those at its start.
struct AirSpan {
    double beforeKm = 0;  // from the ray's start to the span's
    double heightKm = 0;
    double along = 0;  // radius x rise
    double lengthKm = 0;
    bool meetsGround = false;
};

AirSpan spanOf(const Atmosphere& air, double heightKm, double rise, double lengthKm) {
    AirSpan span{0, std::max(heightKm, 0.0), 0, 0, false};
    double radius = airRadiusKm + span.heightKm;
    const double top = airRadiusKm + air.topKm;
    span.along = radius * rise;
    const double inside = span.along * span.along - (span.heightKm - air.topKm) * (radius + top);
    if (inside <= 0 || (span.heightKm >= air.topKm && span.along >= 0)) return span;
    const double root = std::sqrt(inside);
    if (span.heightKm > air.topKm) {
        span.beforeKm = -span.along - root;
        span.heightKm = air.topKm;
        span.along = -root;
        radius = top;
    }
    span.lengthKm = root - span.along;
    const double toGround = span.along * span.along - span.heightKm * (radius + airRadiusKm);
    if (std::isinf(lengthKm) && span.along < 0 && toGround >= 0) {
        span.lengthKm = std::max(-span.along - std::sqrt(toGround), 0.0);
        span.meetsGround = true;
    }
    span.lengthKm = std::clamp(lengthKm - span.beforeKm, 0.0, span.lengthKm);
    return span;
}

// The steps along a span: shortest at the ray's lowest point, and longer with the distance from it.
struct PathSteps {
    double lowestKm, from, width;

    PathSteps(const AirSpan& span, int count) : lowestKm(std::clamp(-span.along, 0.0, span.lengthKm)) {
        from = -std::sqrt(lowestKm);
        width = (std::sqrt(span.lengthKm - lowestKm) - from) / count;
    }
    double at(double step) const {
        const double v = from + step * width;
        return lowestKm + v * std::abs(v);
    }
};

// Interpolates a table of texel centres: maps [0, 1] to a texel and a share of the next one.
struct Between {
    int low;
    double share;

    Between(double at, int count) {
        const double place = std::clamp(at, 0.0, 1.0) * (count - 1);
        low = std::min(static_cast<int>(place), count - 2);
        share = place - low;
    }
};

std::size_t indexOf(const AirTable& table, int x, int y, int z) {
    return static_cast<std::size_t>((z * table.height + y) * table.width + x);
}

glm::dvec3 lookUp(const AirTable& table, double x, double y, int z) {
    const Between column(x, table.width), row(y, table.height);
    const auto at = [&](int right, int up) {
        return glm::dvec3(table.texels[indexOf(table, column.low + right, row.low + up, z)]);
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), column.share), glm::mix(at(0, 1), at(1, 1), column.share),
                    row.share);
}

template <class Value>
AirTable filled(int width, int height, int depth, const Value& value) {
    AirTable table{width, height, depth, {}};
    table.texels.resize(indexOf(table, 0, 0, depth));
    parallelFor(static_cast<std::size_t>(height * depth), [&](std::size_t index) {
        const auto line = static_cast<int>(index);
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 texel = value(x, line % height, line / height);
            table.texels[indexOf(table, x, line, 0)] = glm::vec4(texel, 0);
        }
    });
    return table;
}

double shareOf(int texel, int count) {
    return static_cast<double>(texel) / (count - 1);
}

// Map the sun's rise to a table's coordinate and back; the resolution is finest at sunrise and sunset.
double placeOfSun(double sunRise) {
    return 0.5 + 0.5 * std::copysign(std::sqrt(std::min(std::abs(sunRise), 1.0)), sunRise);
}
double sunAtPlace(double place) {
    const double v = 2 * place - 1;
    return v * std::abs(v);
}

double placeOfHeight(const Atmosphere& air, double heightKm) {
    return std::sqrt(std::clamp(heightKm / air.topKm, 0.0, 1.0));
}

// Bruneton's coordinates: the distance to the top of the atmosphere, from straight up to along the horizon,
// and the distance to the horizon.
struct TransmittancePlace {
    double x, y;
};

double farthestKm(const Atmosphere& air) {
    return std::sqrt(air.topKm * (2 * airRadiusKm + air.topKm));
}

TransmittancePlace transmittancePlace(const Atmosphere& air, double heightKm, double rise) {
    const double height = std::clamp(heightKm, 0.0, air.topKm);
    const double radius = airRadiusKm + height;
    const double most = farthestKm(air);
    const double squared = height * (radius + airRadiusKm);
    const double along = radius * rise;
    const double toEnd = std::sqrt(std::max(along * along + most * most - squared, 0.0)) - along;
    const double horizon = std::sqrt(squared);
    const double nearest = air.topKm - height;
    return {(toEnd - nearest) / (horizon + most - nearest), horizon / most};
}

glm::dvec3 transmittanceTexel(const Atmosphere& air, double x, double y) {
    const double most = farthestKm(air);
    const double horizon = y * most;
    const double radius = std::sqrt(horizon * horizon + airRadiusKm * airRadiusKm);
    const double height = std::clamp(radius - airRadiusKm, 0.0, air.topKm);
    const double nearest = air.topKm - height;
    const double toEnd = nearest + x * (horizon + most - nearest);
    const double rise =
        toEnd > 0 ? (most * most - horizon * horizon - toEnd * toEnd) / (2 * radius * toEnd) : 1.0;
    return transmittanceBySteps(air, height, std::clamp(rise, -1.0, 1.0), transmittanceSteps);
}

// The transmittance of an optical depth, and its mean over the depth.
struct Taken {
    glm::dvec3 left, mean;

    explicit Taken(const glm::dvec3& thickness) : left(glm::exp(-thickness)) {
        const glm::dvec3 least = glm::max(thickness, glm::dvec3(1e-6));
        mean = (1.0 - glm::exp(-least)) / least;
    }
};

// Hillaire's sums along one direction: the light of second-order scattering, if scattering is isotropic, and
// the share of isotropic light that is scattered again.
struct SecondScattering {
    glm::dvec3 light{0}, again{0};
};

SecondScattering secondAlong(const AirTables& tables, double height, double rise, double sunRise,
                             double sunAlongRay) {
    const Atmosphere& air = tables.air;
    const AirSpan span = spanOf(air, height, rise, std::numeric_limits<double>::infinity());
    const PathSteps steps(span, glowSteps);
    SecondScattering sum;
    glm::dvec3 through(1);
    const double radius = airRadiusKm + span.heightKm;
    const auto sunAt = [&](double distance, double& heightThere) {
        const double square = distance * (2 * span.along + distance);
        const double there = std::sqrt(std::max(radius * radius + square, 1.0));
        heightThere = std::max(span.heightKm + square / (there + radius), 0.0);
        return (radius * sunRise + distance * sunAlongRay) / there;
    };
    double heightThere = 0;
    for (int i = 0; i < glowSteps; ++i) {
        const double depth = steps.at(i + 1) - steps.at(i);
        const double sun = sunAt(steps.at(i + 0.5), heightThere);
        const Density density = densityAt(air, heightThere);
        const glm::dvec3 scatters =
            air.rayleigh * density.rayleigh + glm::dvec3(air.hazeScattered * density.haze);
        const Taken taken(takenAt(air, density) * depth);
        const glm::dvec3 step = through * scatters * taken.mean * depth;
        sum.again += step;
        sum.light += step * sunThrough(tables, heightThere, sun) / (4 * pi);
        through *= taken.left;
    }
    if (!span.meetsGround) return sum;
    const double sun = sunAt(span.lengthKm, heightThere);
    sum.light += through * sunThrough(tables, 0, sun) * (std::max(sun, 0.0) * air.groundAlbedo / pi);
    return sum;
}

// Returns the multiply scattered light, integrated over the whole sphere.
glm::dvec3 evenLight(const AirTables& tables, double height, double sunRise) {
    SecondScattering sum;
    const double sunAside = std::sqrt(std::max(1 - sunRise * sunRise, 0.0));
    for (int i = 0; i < glowRises; ++i) {
        const double rise = 2 * (i + 0.5) / glowRises - 1;
        const double aside = std::sqrt(1 - rise * rise);
        for (int k = 0; k < glowSides; ++k) {
            const double turn = pi * (k + 0.5) / glowSides;  // the other half is symmetric
            const double cosine = rise * sunRise + aside * sunAside * std::cos(turn);
            const SecondScattering one = secondAlong(tables, height, rise, sunRise, cosine);
            sum.light += one.light;
            sum.again += one.again;
        }
    }
    constexpr double share = 1.0 / (glowRises * glowSides);
    return sum.light * share / glm::max(1.0 - sum.again * share, glm::dvec3(0.02));
}

glm::dvec3 irradiance(const AirTables& tables, double height, double sunRise) {
    glm::dvec3 sum(0);
    const double sunAside = std::sqrt(std::max(1 - sunRise * sunRise, 0.0));
    for (int i = 0; i < glowRises; ++i) {
        // Square roots of even steps, so that all directions have the same weight on a level square.
        const double rise = std::sqrt((i + 0.5) / glowRises);
        const double aside = std::sqrt(1 - rise * rise);
        for (int k = 0; k < glowSides; ++k) {
            const double turn = pi * (k + 0.5) / glowSides;
            const double cosine = rise * sunRise + aside * sunAside * std::cos(turn);
            sum += lightAlong(tables, {height, rise, sunRise, cosine}, glowSteps).scattered;
        }
    }
    return sum * (pi / (glowRises * glowSides));
}

AirTable makeGlow(const AirTables& tables) {
    return filled(glowSize, glowSize, 1, [&](int x, int y, int) {
        const double height = tables.air.topKm * std::pow(shareOf(y, glowSize), 2);
        return evenLight(tables, height, sunAtPlace(shareOf(x, glowSize)));
    });
}

AirTable makeIrradiance(const AirTables& tables) {
    return filled(glowSize, glowSize, 1, [&](int x, int y, int) {
        const double height = tables.air.topKm * std::pow(shareOf(y, glowSize), 2);
        return irradiance(tables, height, sunAtPlace(shareOf(x, glowSize)));
    });
}

AirTable makeSky(const AirTables& tables) {
    return filled(skyRises, skySides, glowSize, [&](int x, int y, int z) {
        const double rise = std::pow(shareOf(x, skyRises), 2);
        const double sunRise = sunAtPlace(shareOf(z, glowSize));
        const double side = shareOf(y, skySides);
        const double aside = std::sqrt(std::max((1 - rise * rise) * (1 - sunRise * sunRise), 0.0));
        const double cosine = rise * sunRise + aside * (1 - 2 * side * side);
        return lightAlong(tables, {0, rise, sunRise, cosine}, skySteps).scattered;
    });
}

}  // namespace

Atmosphere atmosphereOf(const AirSettings& settings) {
    Atmosphere air;
    const double thickness = std::clamp(settings.thickness, 0.25, 4.0);
    air.rayleigh *= std::max(settings.rayleigh, 0.0);
    air.hazeScattered *= std::max(settings.haze, 0.0);
    air.hazeTaken *= std::max(settings.haze, 0.0);
    air.ozone *= std::max(settings.ozone, 0.0);
    air.forward = std::clamp(settings.forward, 0.0, 0.95);
    for (double* height :
         {&air.rayleighHeightKm, &air.hazeHeightKm, &air.ozoneMiddleKm, &air.ozoneHalfKm, &air.topKm})
        *height *= thickness;
    return air;
}

glm::dvec3 transmittanceBySteps(const Atmosphere& air, double heightKm, double rise, int steps) {
    // A ray that would meet the ground follows it at height 0.
    const AirSpan span = spanOf(air, heightKm, rise, 1e9);
    const PathSteps places(span, steps);
    const double radius = airRadiusKm + span.heightKm;
    glm::dvec3 thickness(0);
    for (int i = 0; i < steps; ++i) {
        const double distance = places.at(i + 0.5);
        const double square = distance * (2 * span.along + distance);
        const double there = std::sqrt(std::max(radius * radius + square, 1.0));
        const Density density = densityAt(air, span.heightKm + square / (there + radius));
        thickness += takenAt(air, density) * (places.at(i + 1) - places.at(i));
    }
    return glm::exp(-thickness);
}

glm::dvec3 transmittance(const AirTables& tables, double heightKm, double rise) {
    const TransmittancePlace place = transmittancePlace(tables.air, heightKm, rise);
    return lookUp(tables.transmittance, place.x, place.y, 0);
}

glm::dvec3 sunThrough(const AirTables& tables, double heightKm, double sunRise) {
    const double height = std::max(heightKm, 0.0);
    const double radius = airRadiusKm + height;
    const double above = sunRise + std::sqrt(height * (radius + airRadiusKm)) / radius;
    const double soft = sunRadiusRad * airRadiusKm / radius;
    const double seen = std::clamp(0.5 + 0.5 * above / soft, 0.0, 1.0);
    if (seen <= 0) return glm::dvec3(0);
    return transmittance(tables, height, sunRise) * (seen * seen * (3 - 2 * seen));
}

glm::dvec3 skyIrradiance(const AirTables& tables, double heightKm, double sunRise) {
    return lookUp(tables.glow, placeOfSun(sunRise), placeOfHeight(tables.air, heightKm), 1);
}

AirLight lightAlong(const AirTables& tables, const AirRay& ray, int stepCount) {
    const Atmosphere& air = tables.air;
    const AirSpan span = spanOf(air, ray.heightKm, ray.rise, ray.lengthKm);
    AirLight light;
    if (span.lengthKm <= 0) return light;
    const double start = airRadiusKm + std::max(ray.heightKm, 0.0);
    const double sunAlong = start * ray.sunRise + span.beforeKm * ray.sunAlongRay;
    const double radius = airRadiusKm + span.heightKm;
    const double rayleigh = rayleighPhase(ray.sunAlongRay);
    const double haze = hazePhase(air.forward, ray.sunAlongRay);
    const PathSteps steps(span, stepCount);
    for (int i = 0; i < stepCount; ++i) {
        const double distance = steps.at(i + 0.5);
        const double depth = steps.at(i + 1) - steps.at(i);
        const double square = distance * (2 * span.along + distance);
        const double there = std::sqrt(std::max(radius * radius + square, 1.0));
        const double height = std::max(span.heightKm + square / (there + radius), 0.0);
        const double sunRise = (sunAlong + distance * ray.sunAlongRay) / there;
        const Density density = densityAt(air, height);
        const glm::dvec3 molecules = air.rayleigh * density.rayleigh;
        const double dust = air.hazeScattered * density.haze;
        const glm::dvec3 even = lookUp(tables.glow, placeOfSun(sunRise), placeOfHeight(air, height), 0);
        const glm::dvec3 scatters =
            sunThrough(tables, height, sunRise) * (molecules * rayleigh + glm::dvec3(dust * haze)) +
            even * (molecules + glm::dvec3(dust));
        const Taken taken(takenAt(air, density) * depth);
        light.scattered += light.through * scatters * taken.mean * depth;
        light.through *= taken.left;
    }
    return light;
}

glm::dvec3 skyRadiance(const AirTables& tables, double rise, double sunRise, double sunAlongRay) {
    const double up = std::clamp(rise, 0.0, 1.0);
    const double aside = std::sqrt(std::max((1 - up * up) * (1 - sunRise * sunRise), 1e-12));
    const double turn = std::clamp((sunAlongRay - up * sunRise) / aside, -1.0, 1.0);
    const Between slice(placeOfSun(sunRise), tables.sky.depth);
    const double x = std::sqrt(up), y = std::sqrt(0.5 - 0.5 * turn);
    return glm::mix(lookUp(tables.sky, x, y, slice.low), lookUp(tables.sky, x, y, slice.low + 1),
                    slice.share);
}

AirTables makeAirTables(const Atmosphere& air) {
    AirTables tables;
    tables.air = air;
    tables.transmittance = filled(transmittanceWidth, transmittanceHeight, 1, [&](int x, int y, int) {
        return transmittanceTexel(air, shareOf(x, transmittanceWidth), shareOf(y, transmittanceHeight));
    });
    tables.glow = makeGlow(tables);
    const AirTable irradiances = makeIrradiance(tables);
    tables.glow.texels.insert(tables.glow.texels.end(), irradiances.texels.begin(), irradiances.texels.end());
    tables.glow.depth = 2;
    tables.sky = makeSky(tables);
    return tables;
}

}  // namespace planet
