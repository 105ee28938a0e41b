#include "planet/gl/store/air_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <utility>

#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/shader_inputs.h"

namespace planet::gl {

namespace {

// The light of a white, level square under the sun at the zenith. It is close to that of the analytic
// atmosphere at noon, so that tone mapping shows daylit ground equally bright in both. Above the air, the sun
// is slightly warmer than a screen's white.
constexpr double noonLight = 3.6;
constexpr glm::dvec3 sunColour(1.03, 1, 0.955);

// Views from space, where all the light of the air lies over the ground, get less exposure; views at dusk get
// more.
constexpr double spaceExposure = 0.6;
constexpr double duskExposure = 6;

double smoothShare(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double exposureAt(double heightKm, double sunRise) {
    const double inSpace = smoothShare(std::log(3.0), std::log(300.0), std::log(std::max(heightKm, 1.0)));
    const double dusk = smoothShare(0.15, -0.12, sunRise) * (1 - inSpace);
    return std::pow(spaceExposure, inSpace) * std::pow(duskExposure, dusk);
}

Texture uploaded(GLenum target, const AirTable& table) {
    Texture texture = makeTexture();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(target, texture.name());
    if (target == GL_TEXTURE_2D)
        glTexImage2D(target, 0, GL_RGBA16F, table.width, table.height, 0, GL_RGBA, GL_FLOAT,
                     table.texels.data());
    else
        glTexImage3D(target, 0, GL_RGBA16F, table.width, table.height, table.depth, 0, GL_RGBA, GL_FLOAT,
                     table.texels.data());
    constexpr std::array<GLenum, 3> wraps = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
    for (const GLenum wrap : wraps) glTexParameteri(target, wrap, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

}  // namespace

AirUniforms airUniforms(const AirTables& tables, const AirDrawing& drawing, const glm::dvec3& eyeM,
                        double radiusM, const glm::dvec3& sun) {
    const Atmosphere& air = tables.air;
    const double kmPerM = airRadiusKm / radiusM;
    const double eyeRadiusM = glm::length(eyeM);
    const glm::dvec3 up = eyeRadiusM > 0 ? eyeM / eyeRadiusM : glm::dvec3(1, 0, 0);
    const double eyeKm = std::max(eyeRadiusM - radiusM, 0.0) * kmPerM;
    const double exposure = noonLight * drawing.exposure * exposureAt(eyeKm, glm::dot(up, sun));
    AirUniforms uniforms{};
    uniforms.rayleigh = air.rayleigh;
    uniforms.perRayleighHeight = toFloat(1 / air.rayleighHeightKm);
    uniforms.ozone = air.ozone;
    uniforms.perOzoneHalf = toFloat(1 / air.ozoneHalfKm);
    uniforms.ozoneMiddleKm = toFloat(air.ozoneMiddleKm);
    uniforms.hazeScattered = toFloat(air.hazeScattered);
    uniforms.hazeTaken = toFloat(air.hazeTaken);
    uniforms.perHazeHeight = toFloat(1 / air.hazeHeightKm);
    uniforms.forward = toFloat(air.forward);
    uniforms.radiusKm = toFloat(airRadiusKm);
    uniforms.topKm = toFloat(air.topKm);
    uniforms.farthestKm = toFloat(std::sqrt(air.topKm * (2 * airRadiusKm + air.topKm)));
    uniforms.kmPerM = toFloat(kmPerM);
    uniforms.light = exposure * sunColour;
    uniforms.steps = toFloat(std::clamp(drawing.steps, 4, 64));
    uniforms.eyeUp = up;
    uniforms.eyeKm = toFloat(eyeKm);
    uniforms.skySize = {tables.sky.width, tables.sky.height, tables.sky.depth};
    uniforms.glowSize = toFloat(tables.glow.width);
    uniforms.transmittanceSize = {tables.transmittance.width, tables.transmittance.height};
    return uniforms;
}

AirTextures::AirTextures() : frame_(makeBuffer()) {}

// Keeps the last tables in a static. They do not depend on the planet, so a planet that replaces another one
// need not wait for them.
AirTextures::Made AirTextures::made(const AirSettings& settings) {
    static std::mutex guard;
    static std::optional<Made> last;
    {
        const std::lock_guard lock(guard);
        if (last && last->settings == settings) return *last;
    }
    const auto start = std::chrono::steady_clock::now();
    Made made{settings, makeAirTables(atmosphereOf(settings)), 0};
    made.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const std::lock_guard lock(guard);
    last = made;
    return made;
}

Result<void> AirTextures::take(Made&& made) {
    Texture transmittance, glow, sky;
    const bool fit = hasRoomFor([&] {
        transmittance = uploaded(GL_TEXTURE_2D, made.tables.transmittance);
        glow = uploaded(GL_TEXTURE_2D_ARRAY, made.tables.glow);
        sky = uploaded(GL_TEXTURE_3D, made.tables.sky);
    });
    if (!fit) {
        refused_ = made.settings;
        return badInput(
            fmt::format("GPU out of memory: {} KiB of atmosphere tables", made.tables.bytesOnGpu() / 1024));
    }
    refused_.reset();
    settings_ = made.settings;
    tables_ = std::move(made.tables);
    transmittance_ = std::move(transmittance);
    glow_ = std::move(glow);
    sky_ = std::move(sky);
    figures_.tablesMs = made.ms;
    figures_.tableBytes = tables_.bytesOnGpu();
    return {};
}

Result<void> AirTextures::follow(const AirSettings& settings, bool inBackground) {
    Result<void> followed;
    if (next_.valid() &&
        (!inBackground || next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready))
        followed = take(next_.get());
    const bool done = refused_ == settings || (exist() && settings_ == settings);
    if (!done && inBackground && !next_.valid())
        next_ = std::async(std::launch::async, made, settings);
    else if (!done && !next_.valid())
        followed = take(made(settings));
    figures_.working = next_.valid();
    return followed;
}

void AirTextures::bind(const AirDrawing& drawing, const glm::dvec3& eyeM, double radiusM,
                       const glm::dvec3& sun) const {
    fillUniforms(frame_, airUniforms(tables_, drawing, eyeM, radiusM, sun));
    bindUniforms(UniformBlock::Air, frame_);
    bindTexture(Sampler::airTransmittance, GL_TEXTURE_2D, transmittance_.name());
    bindTexture(Sampler::airGlow, GL_TEXTURE_2D_ARRAY, glow_.name());
    bindTexture(Sampler::airSky, GL_TEXTURE_3D, sky_.name());
}

}  // namespace planet::gl
