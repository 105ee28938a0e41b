// The air's tables against light marched through the air step by step, written here a second time: plain
// vectors, small even steps, no tables.
#include "planet/surface/atmosphere.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace planet {
namespace {

using std::numbers::pi;

const AirTables& earthTables() {
    static const AirTables tables = makeAirTables(atmosphereOf({}));
    return tables;
}

glm::dvec3 takenAtHeight(const Atmosphere& air, double height) {
    return air.rayleigh * std::exp(-height / air.rayleighHeightKm) +
           glm::dvec3(air.hazeTaken) * std::exp(-height / air.hazeHeightKm) +
           air.ozone * std::max(1 - std::abs(height - air.ozoneMiddleKm) / air.ozoneHalfKm, 0.0);
}

// To the air's end, or to where the ground is.
double endOfRay(const Atmosphere& air, const glm::dvec3& from, const glm::dvec3& ray, bool& ground) {
    const double along = glm::dot(from, ray);
    const double squared = glm::dot(from, from);
    const double ofGround = along * along - squared + airRadiusKm * airRadiusKm;
    ground = along < 0 && ofGround > 0;
    if (ground) return -along - std::sqrt(ofGround);
    const double top = airRadiusKm + air.topKm;
    return -along + std::sqrt(along * along - squared + top * top);
}

glm::dvec3 marchedTransmittance(const Atmosphere& air, const glm::dvec3& from, const glm::dvec3& ray,
                                int steps) {
    bool ground = false;
    const double end = endOfRay(air, from, ray, ground);
    if (ground) return glm::dvec3(0);
    glm::dvec3 thickness(0);
    for (int i = 0; i < steps; ++i) {
        // Finer near the start, where the air is.
        const double a = end * std::pow(static_cast<double>(i) / steps, 2);
        const double b = end * std::pow(static_cast<double>(i + 1) / steps, 2);
        thickness += (b - a) * takenAtHeight(air, glm::length(from + 0.5 * (a + b) * ray) - airRadiusKm);
    }
    return glm::exp(-thickness);
}

glm::dvec3 marchedOnce(const Atmosphere& air, const glm::dvec3& from, const glm::dvec3& ray,
                       const glm::dvec3& sun, double length, int steps) {
    const double cosine = glm::dot(ray, sun), g = air.forward;
    const double rayleigh = 3 / (16 * pi) * (1 + cosine * cosine);
    const double haze = 3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) /
                        ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    glm::dvec3 thickness(0), light(0);
    const double step = length / steps;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 place = from + (i + 0.5) * step * ray;
        const double height = glm::length(place) - airRadiusKm;
        const glm::dvec3 taken = takenAtHeight(air, height) * step;
        const glm::dvec3 scatters =
            air.rayleigh * (rayleigh * std::exp(-height / air.rayleighHeightKm)) +
            glm::dvec3(air.hazeScattered * haze * std::exp(-height / air.hazeHeightKm));
        light += glm::exp(-(thickness + 0.5 * taken)) * scatters * step *
                 marchedTransmittance(air, place, sun, 150);
        thickness += taken;
    }
    return light;
}

glm::dvec3 directionAt(double rise, double turn) {
    const double aside = std::sqrt(1 - rise * rise);
    return {rise, aside * std::cos(turn), aside * std::sin(turn)};
}

void expectWithin(const glm::dvec3& value, const glm::dvec3& wanted, double share, double least,
                  const std::string& where) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(value[channel], wanted[channel], share * wanted[channel] + least)
            << where << ", channel " << channel;
}

TEST(Atmosphere, TransmittanceIsThatOfAMarchThroughTheAir) {
    const AirTables& tables = earthTables();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 200; ++i) {
        const double height = 99 * std::pow(share(random), 2);
        const double radius = airRadiusKm + height;
        const double horizon = -std::sqrt(1 - std::pow(airRadiusKm / radius, 2));
        const double rise = horizon + 1e-4 + (0.999 - horizon) * std::pow(share(random), 2);
        const glm::dvec3 marched =
            marchedTransmittance(tables.air, {radius, 0, 0}, directionAt(rise, 1), 4000);
        expectWithin(transmittance(tables, height, rise), marched, 0.01, 0.004,
                     std::to_string(height) + " km, rise " + std::to_string(rise));
    }
}

TEST(Atmosphere, TransmittanceGrowsWithHeightAndWithTheSunsRise) {
    const AirTables& tables = earthTables();
    for (int channel = 0; channel < 3; ++channel) {
        double last = 0;
        for (double height = 0; height < 100; height += 1.7) {
            const double here = transmittance(tables, height, 0.1)[channel];
            EXPECT_GE(here, last - 1e-6) << height << " km";
            last = here;
        }
        last = 0;
        for (double rise = 0; rise <= 1; rise += 0.01) {
            const double here = transmittance(tables, 0.5, rise)[channel];
            EXPECT_GE(here, last - 1e-6) << "rise " << rise;
            last = here;
        }
    }
}

TEST(Atmosphere, LightScatteredOnceIsThatOfAMarchWithinAFewPercent) {
    AirTables once = earthTables();
    std::fill(once.glow.texels.begin(), once.glow.texels.end(), glm::vec4(0));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 60; ++i) {
        const double height = i % 3 == 0 ? 0.01 : 60 * share(random);
        const glm::dvec3 from(airRadiusKm + height, 0, 0);
        const glm::dvec3 sun = directionAt(share(random), 0);
        const glm::dvec3 ray = directionAt(2 * share(random) - 1, 2 * pi * share(random));
        bool ground = false;
        double end = endOfRay(once.air, from, ray, ground);
        AirRay described{height, ray.x, sun.x, glm::dot(ray, sun)};
        if (i % 2 == 0) described.lengthKm = end = end * share(random);
        const glm::dvec3 marched = marchedOnce(once.air, from, ray, sun, end, 1500);
        expectWithin(
            lightAlong(once, described, 32).scattered, marched, 0.04, 1e-4,
            std::to_string(height) + " km, rise " + std::to_string(ray.x) + ", sun " + std::to_string(sun.x));
    }
}

TEST(Atmosphere, LightFromSpaceIsThatOfTheAirItCrosses) {
    const AirTables& tables = earthTables();
    // The same ray from afar and from where it comes into the air.
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.7, 0.2));
    for (const double closest : {6300.0, 6375.0, 6400.0, 6460.0}) {
        const glm::dvec3 ray(-1, 0, 0);
        const double top = airRadiusKm + tables.air.topKm;
        const glm::dvec3 entry(std::sqrt(top * top - closest * closest), closest, 0);
        const glm::dvec3 far = entry - 50000.0 * ray;
        const auto lightFrom = [&](const glm::dvec3& from) {
            const glm::dvec3 up = glm::normalize(from);
            return lightAlong(
                tables,
                {glm::length(from) - airRadiusKm, glm::dot(up, ray), glm::dot(up, sun), glm::dot(ray, sun)},
                32);
        };
        expectWithin(lightFrom(far).scattered, lightFrom(entry).scattered, 1e-3, 1e-6, "scattered");
        expectWithin(lightFrom(far).through, lightFrom(entry).through, 1e-3, 1e-6, "through");
    }
    EXPECT_EQ(lightAlong(tables, {50000, 0.5, 0.5, 0.5}, 32).scattered, glm::dvec3(0));
    EXPECT_EQ(lightAlong(tables, {50000, -0.1, 0.5, 0.5}, 32).through, glm::dvec3(1));
}

TEST(Atmosphere, ARayToTheGroundEndsThereWithoutAStep) {
    const AirTables& tables = earthTables();
    for (const double height : {0.002, 2.0, 20.0, 400.0}) {
        const double radius = airRadiusKm + height;
        const double horizon = -std::sqrt(1 - std::pow(airRadiusKm / radius, 2));
        for (const double rise : {horizon - 1e-6, horizon - 1e-3, horizon - 0.1}) {
            bool ground = false;
            const double end = endOfRay(tables.air, {radius, 0, 0}, directionAt(rise, 0), ground);
            ASSERT_TRUE(ground);
            const AirLight to = lightAlong(tables, {height, rise, 0.4, 0.3, end}, 32);
            const AirLight on = lightAlong(tables, {height, rise, 0.4, 0.3}, 32);
            expectWithin(to.scattered, on.scattered, 0.01, 1e-6, std::to_string(height) + " km");
        }
    }
}

TEST(Atmosphere, ThirtyTwoStepsAreAsGoodAsAThousand) {
    const AirTables& tables = earthTables();
    for (const double height : {0.0, 5.0, 400.0}) {
        for (double rise = -0.4; rise < 1; rise += 0.037) {
            for (const double sunRise : {-0.12, -0.03, 0.0, 0.05, 0.5, 1.0}) {
                const AirRay ray{height, rise, sunRise, rise * sunRise};
                expectWithin(lightAlong(tables, ray, 32).scattered, lightAlong(tables, ray, 1000).scattered,
                             0.05, 2e-4,
                             std::to_string(height) + " km, rise " + std::to_string(rise) + ", sun " +
                                 std::to_string(sunRise));
            }
        }
    }
}

TEST(Atmosphere, NoMoreLightArrivesThanTheSunSends) {
    const AirTables& tables = earthTables();
    for (double sunRise = 0.1; sunRise <= 1; sunRise += 0.1) {
        const glm::dvec3 all = sunThrough(tables, 0, sunRise) * sunRise + skyIrradiance(tables, 0, sunRise);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_LT(all[channel], 1.05 * sunRise) << sunRise;
            EXPECT_GT(all[channel], 0.4 * sunRise) << sunRise;
        }
    }
}

TEST(Atmosphere, TheSkyIsBluePalerAtTheHorizonAndRedWhereTheSunSets) {
    const AirTables& tables = earthTables();
    const glm::dvec3 zenith = skyRadiance(tables, 1, 0.7, 0.7);
    const glm::dvec3 horizon = skyRadiance(tables, 0.02, 0.7, 0.1);
    EXPECT_GT(zenith.b, 2 * zenith.r);
    EXPECT_GT(zenith.b, 1.4 * zenith.g);
    EXPECT_LT(horizon.b / horizon.r, 0.7 * zenith.b / zenith.r);
    EXPECT_GT(horizon.g, 2 * zenith.g);
    const glm::dvec3 sunset = skyRadiance(tables, 0.03, 0.01, 0.999);
    EXPECT_GT(sunset.r, 1.5 * sunset.b);
    const glm::dvec3 duskZenith = skyRadiance(tables, 1, -0.03, -0.03);
    EXPECT_GT(duskZenith.b, duskZenith.r);  // the work of ozone
    const AirTables without = makeAirTables(atmosphereOf({.ozone = 0}));
    const glm::dvec3 yellower = skyRadiance(without, 1, -0.03, -0.03);
    EXPECT_GT(duskZenith.b / duskZenith.r, 1.1 * yellower.b / yellower.r);
}

TEST(Atmosphere, TheTableOfTheSkyIsTheLightAlongItsRays) {
    const AirTables& tables = earthTables();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 100; ++i) {
        const double sunRise = 0.02 + 0.98 * share(random);
        const glm::dvec3 sun = directionAt(sunRise, 0);
        const glm::dvec3 ray = directionAt(share(random), 2 * pi * share(random));
        const double cosine = glm::dot(ray, sun);
        if (cosine > 0.95) continue;  // its glow is finer than the table
        expectWithin(skyRadiance(tables, ray.x, sunRise, cosine),
                     lightAlong(tables, {0, ray.x, sunRise, cosine}, 64).scattered, 0.08, 2e-3,
                     "rise " + std::to_string(ray.x) + ", sun " + std::to_string(sunRise));
    }
}

TEST(Atmosphere, EverythingIsFiniteAndNothingNegativeAtTheEndsOfAllRanges) {
    for (const AirSettings& settings :
         {AirSettings{0, 20, 5, 0.95, 0.25}, AirSettings{5, 0, 0, 0, 4}, AirSettings{5, 20, 5, 0.95, 4}}) {
        const AirTables tables = makeAirTables(atmosphereOf(settings));
        for (const AirTable* table : {&tables.transmittance, &tables.glow, &tables.sky}) {
            for (const glm::vec4& texel : table->texels) {
                for (int channel = 0; channel < 3; ++channel) {
                    ASSERT_TRUE(texel[channel] >= 0 && texel[channel] < 100)
                        << settings.rayleigh << " " << settings.haze << ": " << texel[channel];
                }
            }
        }
    }
}

TEST(Atmosphere, WithoutAirLightIsAsAboveIt) {
    const AirTables tables = makeAirTables(atmosphereOf({0, 0, 0, 0.8, 1}));
    EXPECT_EQ(sunThrough(tables, 0, 0.5), glm::dvec3(1));
    EXPECT_EQ(sunThrough(tables, 0, -0.5), glm::dvec3(0));
    const AirLight light = lightAlong(tables, {0, 0.3, 0.5, 0.2}, 32);
    EXPECT_EQ(light.scattered, glm::dvec3(0));
    EXPECT_EQ(light.through, glm::dvec3(1));
}

TEST(Atmosphere, TablesAreTheSameOnOneThread) {
    AirTables alone;
    tbb::task_arena(1).execute([&] { alone = makeAirTables(atmosphereOf({})); });
    EXPECT_EQ(alone.transmittance.texels, earthTables().transmittance.texels);
    EXPECT_EQ(alone.glow.texels, earthTables().glow.texels);
    EXPECT_EQ(alone.sky.texels, earthTables().sky.texels);
}

}  // namespace
}  // namespace planet
