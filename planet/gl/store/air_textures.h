// The physical atmosphere on the GPU: its tables as textures, and the uniform block of shaders/air.glsl.
// All calls require the same current context; one thread.
#pragma once

#include <cstddef>
#include <future>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/surface/atmosphere.h"
#include "planet/surface/light_drawing.h"

namespace planet::gl {

// Members have std140 offsets because every vec3 is aligned to 16 bytes; shaders/air.glsl describes them.
struct AirUniforms {
    alignas(16) glm::vec3 rayleigh;
    float perRayleighHeight;
    alignas(16) glm::vec3 ozone;
    float perOzoneHalf, ozoneMiddleKm;
    float hazeScattered, hazeTaken, perHazeHeight, forward;
    float radiusKm, topKm, farthestKm, kmPerM;
    alignas(16) glm::vec3 light;
    float steps;
    alignas(16) glm::vec3 eyeUp;
    float eyeKm;
    alignas(16) glm::vec3 skySize;
    float glowSize;
    glm::vec2 transmittanceSize;
};

// Returns the uniform block. eyeM: metres from the planet's centre. sun: unit vector.
AirUniforms airUniforms(const AirTables& tables, const AirDrawing& drawing, const glm::dvec3& eyeM,
                        double radiusM, const glm::dvec3& sun);

class AirTextures {
public:
    AirTextures();

    // Makes the tables for these settings. In the background, the last tables (none at first) stay in use
    // until the new ones are ready; otherwise the call waits. Returns an Error once if the context is out of
    // memory for them; the last tables then stay.
    Result<void> follow(const AirSettings& settings, bool inBackground);
    bool exist() const { return transmittance_.name() != 0; }

    // Fills the uniform block, and binds it and the tables.
    void bind(const AirDrawing& drawing, const glm::dvec3& eyeM, double radiusM, const glm::dvec3& sun) const;

    const AirTables& tables() const { return tables_; }
    const AirFigures& figures() const { return figures_; }

private:
    struct Made {
        AirSettings settings;
        AirTables tables;
        double ms = 0;
    };
    static Made made(const AirSettings& settings);
    Result<void> take(Made&& made);

    AirTables tables_;
    AirSettings settings_;                // of the tables
    std::optional<AirSettings> refused_;  // out of memory for their tables
    AirFigures figures_;
    Texture transmittance_, glow_, sky_;
    Buffer frame_;
    std::future<Made> next_;
};

}  // namespace planet::gl
