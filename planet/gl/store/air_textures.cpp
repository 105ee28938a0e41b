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

namespace planet::gl {

namespace {

constexpr GLuint airBinding = 5;
constexpr GLint transmittanceUnit = 10;
constexpr GLint glowUnit = 11;
constexpr GLint skyUnit = 12;

// Light of a white level square below the sun, near to what the thin atmosphere has at noon: with it the tone
// mapping shows the ground by day as bright in both. The sun above the air is a little warmer than a screen's
// white.
constexpr double noonLight = 3.6;
constexpr glm::dvec3 sunColour(1.03, 1, 0.955);

// Pictures are exposed as people would: less from space, where the ground comes with all of the air's light
// over it, and more at dusk.
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
    const double farthestKm = std::sqrt(air.topKm * (2 * airRadiusKm + air.topKm));
    AirUniforms uniforms;
    uniforms.molecules = glm::dvec4(air.rayleigh, 1 / air.rayleighHeightKm);
    uniforms.haze = glm::dvec4(air.hazeScattered, air.hazeTaken, 1 / air.hazeHeightKm, air.forward);
    uniforms.ozone = glm::dvec4(air.ozone, 1 / air.ozoneHalfKm);
    uniforms.shape = glm::dvec4(airRadiusKm, air.topKm, kmPerM, air.ozoneMiddleKm);
    const double eyeKm = std::max(eyeRadiusM - radiusM, 0.0) * kmPerM;
    const double exposure = noonLight * drawing.exposure * exposureAt(eyeKm, glm::dot(up, sun));
    uniforms.sun = glm::dvec4(exposure * sunColour, std::clamp(drawing.steps, 4, 64));
    uniforms.eye = glm::dvec4(up, eyeKm);
    uniforms.sizes =
        glm::dvec4(tables.transmittance.width, tables.transmittance.height, tables.glow.width, farthestKm);
    uniforms.skySizes = glm::dvec4(tables.sky.width, tables.sky.height, tables.sky.depth, 0);
    return uniforms;
}

AirTextures::AirTextures() : frame_(makeBuffer()) {}

// They are the same for every planet, so that one that takes another's place need not wait for them.
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
    const AirUniforms uniforms = airUniforms(tables_, drawing, eyeM, radiusM, sun);
    glBindBuffer(GL_UNIFORM_BUFFER, frame_.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(uniforms), &uniforms, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, airBinding, frame_.name());
    glActiveTexture(GL_TEXTURE0 + transmittanceUnit);
    glBindTexture(GL_TEXTURE_2D, transmittance_.name());
    glActiveTexture(GL_TEXTURE0 + glowUnit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, glow_.name());
    glActiveTexture(GL_TEXTURE0 + skyUnit);
    glBindTexture(GL_TEXTURE_3D, sky_.name());
}

void AirTextures::connect(GLuint program) {
    const GLuint block = glGetUniformBlockIndex(program, "Air");
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(program, block, airBinding);
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "airTransmittance"), transmittanceUnit);
    glUniform1i(glGetUniformLocation(program, "airGlow"), glowUnit);
    glUniform1i(glGetUniformLocation(program, "airSky"), skyUnit);
    glUseProgram(0);
}

}  // namespace planet::gl
