// The physical atmosphere on the GPU: its tables as textures, and what shaders/air.glsl is told once a frame.
// Wants a current context, and the same one throughout; one thread.
#pragma once

#include <cstddef>
#include <future>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/surface/atmosphere.h"
#include "planet/surface/light_drawing.h"

namespace planet::gl {

// std140: only members of 16 bytes.
struct AirUniforms {
    glm::vec4 molecules, haze, ozone, shape, sun, eye, sizes, skySizes;
};
static_assert(sizeof(AirUniforms) == 8 * 16);

// eyeM: metres from the planet's centre. sun: unit.
AirUniforms airUniforms(const AirTables& tables, const AirDrawing& drawing, const glm::dvec3& eyeM,
                        double radiusM, const glm::dvec3& sun);

class AirTextures {
public:
    AirTextures();

    // The tables for these settings. In the background: what there was stays, at first nothing, until the new
    // ones have come; else it waits. The Error, once: the context has no memory for them, and
    // what there was stays.
    Result<void> follow(const AirSettings& settings, bool inBackground);
    // Whether there is anything to bind.
    bool exist() const { return transmittance_.name() != 0; }

    // To the uniform block and the texture units below.
    void bind(const AirDrawing& drawing, const glm::dvec3& eyeM, double radiusM, const glm::dvec3& sun) const;
    static void connect(GLuint program);

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
    std::optional<AirSettings> refused_;  // for whose tables there was no memory
    AirFigures figures_;
    Texture transmittance_, glow_, sky_;
    Buffer frame_;
    std::future<Made> next_;
};

}  // namespace planet::gl
