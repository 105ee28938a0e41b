#include "planet/gl/draw/drawing_state.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "planet/base/result.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/device/shader_inputs.h"
#include "planet/gl/draw/chunk_grid.h"
#include "planet/gl/draw/chunk_instances.h"
#include "planet/gl/draw/sky.h"
#include "planet/gl/store/shadow_maps.h"

namespace planet::gl {

namespace {

constexpr std::size_t largestUniformBlock = 16384;

constexpr auto targets =
    std::to_array<std::pair<GLenum, GLenum>>({{GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                                              {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                                              {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D}});

// Zeros for all inputs of a program.
struct EmptyInputs {
    Buffer uniforms = makeBuffer();
    Buffer gridVertices = makeBuffer();
    Buffer indices = makeBuffer();
    Buffer instances = makeBuffer();
    VertexArray vertices = makeVertexArray();
};

EmptyInputs bindEmptyInputs(ProgramUse use) {
    EmptyInputs inputs;
    const std::vector<std::uint8_t> zeros(largestUniformBlock);
    glBindBuffer(GL_UNIFORM_BUFFER, inputs.uniforms.name());
    glBufferData(GL_UNIFORM_BUFFER, largestUniformBlock, zeros.data(), GL_STATIC_DRAW);
    for (GLuint binding = 0; binding < uniformBlockCount; ++binding)
        glBindBufferBase(GL_UNIFORM_BUFFER, binding, inputs.uniforms.name());
    glBindVertexArray(inputs.vertices.name());
    if (use == ProgramUse::Sky || use == ProgramUse::Stars) {
        glBindBuffer(GL_ARRAY_BUFFER, inputs.gridVertices.name());
        glBufferData(GL_ARRAY_BUFFER, 3 * sizeof(Star), zeros.data(), GL_STATIC_DRAW);
        describeStars(inputs.gridVertices);
        return inputs;
    }
    glBindBuffer(GL_ARRAY_BUFFER, inputs.gridVertices.name());
    glBufferData(GL_ARRAY_BUFFER, sizeof(GridVertex), zeros.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, inputs.instances.name());
    glBufferData(GL_ARRAY_BUFFER, sizeof(ChunkInstance), zeros.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, inputs.indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, 3 * sizeof(std::uint16_t), zeros.data(), GL_STATIC_DRAW);
    describeChunkVertices(inputs.gridVertices, inputs.instances);
    return inputs;
}

}  // namespace

void beginDepthTest(bool reversedZ) {
    if (reversedZ) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(reversedZ ? GL_GEQUAL : GL_LEQUAL);
    glClearDepth(reversedZ ? 0 : 1);
}

void endDepthTest(bool reversedZ) {
    if (reversedZ) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glClearDepth(1);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

int boundSamples() {
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    return std::max(samples, 1);
}

DrawingState currentDrawingState(bool reversedZ) {
    DrawingState state{.reversedZ = reversedZ, .samples = boundSamples(), .textures = {}};
    for (GLuint unit = 0; unit < samplerCount; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (const auto& [target, binding] : targets) {
            GLint name = 0;
            glGetIntegerv(binding, &name);
            if (name != 0) state.textures.push_back({unit, target, static_cast<GLuint>(name)});
        }
    }
    glActiveTexture(GL_TEXTURE0);
    return state;
}

void drawNothing(const Program& program, ProgramUse use, const DrawingState& state) {
    const EmptyInputs inputs = bindEmptyInputs(use);
    for (const BoundTexture& texture : state.textures) {
        glActiveTexture(GL_TEXTURE0 + texture.unit);
        glBindTexture(texture.target, texture.name);
    }
    std::optional<Result<RenderTarget>> target;
    std::optional<Result<ShadowMaps>> maps;
    constexpr int sizePx = 4;
    if (use == ProgramUse::Depth) {
        maps = ShadowMaps::create(sizePx);
        if (!*maps) return;
        (*maps)->begin(0);
    } else {
        target = RenderTarget::create(sizePx, sizePx, state.samples);
        if (!*target) return;
        (*target)->bind();
        glViewport(0, 0, sizePx, sizePx);
        beginDepthTest(state.reversedZ);
        if (use == ProgramUse::Sky || use == ProgramUse::Stars) glDepthMask(GL_FALSE);
    }
    // A chunk's three vertices coincide, so no pixel is covered. The sky covers a few pixels of the target
    // made here.
    glUseProgram(program.name());
    if (use == ProgramUse::Sky) {
        glDrawArrays(GL_TRIANGLES, 0, 3);
    } else if (use == ProgramUse::Stars) {
        beginStars();
        glDrawArrays(GL_POINTS, 0, 1);
        endStars();
    } else {
        glEnable(GL_CULL_FACE);
        glDrawElementsInstanced(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, nullptr, 1);
        glDisable(GL_CULL_FACE);
    }
    glUseProgram(0);
    glBindVertexArray(0);
    if (use == ProgramUse::Depth)
        ShadowMaps::end();
    else
        endDepthTest(state.reversedZ);
    glDepthMask(GL_TRUE);
    glFinish();
}

}  // namespace planet::gl
