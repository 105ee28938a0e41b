#include "planet/gl/draw/shader_prologue.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>
#include <type_traits>

#include "planet/format/colour_tile.h"
#include "planet/gl/draw/chunk_instances.h"
#include "planet/gl/draw/frame_uniforms.h"
#include "planet/gl/draw/layer_uniforms.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/gl/draw/sea_uniforms.h"
#include "planet/gl/store/tile_pool.h"
#include "planet/select/shadow_cascades.h"
#include "planet/sphere/vertex_position.h"
#include "planet/surface/star_field.h"

namespace planet::gl {

namespace {

template <class Value>
std::string declared(const char* name, Value value) {
    if constexpr (std::is_floating_point_v<Value>)
        return fmt::format("const float {} = {:#.9g};\n", name, value);
    else if constexpr (std::is_same_v<Value, std::uint32_t>)
        return fmt::format("const uint {} = {}u;\n", name, value);
    else
        return fmt::format("const int {} = {};\n", name, value);
}

std::string sharedConstants() {
    std::string text;
#define PLANET_DECLARE(constant) text += declared(#constant, constant);
    PLANET_DECLARE(faceCount)
    PLANET_DECLARE(fineGridLog2)
    PLANET_DECLARE(noSlot)
    PLANET_DECLARE(tileCells)
    PLANET_DECLARE(tileBorderBefore)
    PLANET_DECLARE(tileTexels)
    PLANET_DECLARE(noTile)
    PLANET_DECLARE(coarsestRootMipmap)
    PLANET_DECLARE(maxColourLevel)
    PLANET_DECLARE(maxRampStops)
    PLANET_DECLARE(maxLayers)
    PLANET_DECLARE(layerRepeatLevels)
    PLANET_DECLARE(layerRepeatLevelStep)
    PLANET_DECLARE(seaWaveCount)
    PLANET_DECLARE(shadowCascadeCount)
    PLANET_DECLARE(radiusScaleHeights)
    PLANET_DECLARE(starCellRad)
#undef PLANET_DECLARE
    for (int octave = 0; octave < 3; ++octave) {
        const glm::mat3 turn = detailTurn(octave);
        text += fmt::format("const mat3 detailTurn{} = mat3({:.9g});\n", octave,
                            fmt::join(glm::value_ptr(turn), glm::value_ptr(turn) + 9, ", "));
    }
    return text;
}

}  // namespace

std::string shaderPrologue(Switches on) {
    std::string text = sharedConstants();
    for (unsigned i = 0; i < switchCount; ++i)
        text += fmt::format("const bool {} = {};\n", switchNames[i], (on >> i & 1) != 0);
    return text;
}

}  // namespace planet::gl
