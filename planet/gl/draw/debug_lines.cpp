#include "planet/gl/draw/debug_lines.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>
#include <vector>

#include "planet/gl/device/shader_source.h"

namespace planet::gl {

namespace {

constexpr std::array<std::string_view, 1> lineVertexFiles = {"lines.vert"};
constexpr std::array<std::string_view, 1> lineFragmentFiles = {"lines.frag"};
constexpr float faintOpacity = 0.25f;
constexpr double nearestM = 0.1;  // of lines; a non-reversed near plane clamps their depth

// One end of a line, in the layout of shaders/lines.vert.
struct LineEnd {
    glm::vec3 fromEyeM{0, 0, 0};
    LineColour colour{};
};
static_assert(sizeof(LineEnd) == 16);

constexpr auto lineInputs = std::to_array<VertexInput>({
    {"start", 3, GL_FLOAT, InputKind::Float, offsetof(LineEnd, fromEyeM)},
    {"startColour", 4, GL_UNSIGNED_BYTE, InputKind::Normalised, offsetof(LineEnd, colour)},
    {"end", 3, GL_FLOAT, InputKind::Float, sizeof(LineEnd) + offsetof(LineEnd, fromEyeM)},
    {"endColour", 4, GL_UNSIGNED_BYTE, InputKind::Normalised, sizeof(LineEnd) + offsetof(LineEnd, colour)},
});

std::vector<LineEnd> relativeTo(const glm::dvec3& eyeM, std::span<const LineVertex> lines) {
    std::vector<LineEnd> ends;
    ends.reserve(lines.size());
    for (const LineVertex& vertex : lines) ends.push_back({vertex.positionM - eyeM, vertex.colour});
    return ends;
}

}  // namespace

Result<DebugLines> DebugLines::create() {
    const Result<ShaderText> vertex = readShader({}, lineVertexFiles);
    if (!vertex) return tl::unexpected(vertex.error());
    const Result<ShaderText> fragment = readShader({}, lineFragmentFiles);
    if (!fragment) return tl::unexpected(fragment.error());
    Result<Program> program = linkProgram(*vertex, *fragment, {.inputs = lineInputs});
    if (!program) return tl::unexpected(program.error());
    DebugLines lines;
    lines.program_ = std::move(*program);
    lines.array_ = makeVertexArray();
    lines.vertices_ = makeBuffer();
    glBindVertexArray(lines.array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, lines.vertices_.name());
    describeInputs(lineInputs, 0, 2 * sizeof(LineEnd), 1);
    glBindVertexArray(0);
    return lines;
}

void DebugLines::upload(const glm::dvec3& eyeM, std::span<const LineVertex> lines) {
    const std::vector<LineEnd> ends = relativeTo(eyeM, lines);
    bytes_ = ends.size() * sizeof(LineEnd);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes_), ends.data(), GL_STREAM_DRAW);
}

void DebugLines::setUniforms(const View& view, const Projection& projection, float widthPx) const {
    const glm::mat4 clipFromWorld = projection.clipFromCamera * glm::dmat4(cameraFromWorldRotation(view));
    const auto place = [&](const char* name) { return glGetUniformLocation(program_.name(), name); };
    glUniformMatrix4fv(place("clipFromWorld"), 1, GL_FALSE, glm::value_ptr(clipFromWorld));
    glUniform2f(place("halfViewportPx"), 0.5f * static_cast<float>(view.widthPx),
                0.5f * static_cast<float>(view.heightPx));
    glUniform1f(place("halfWidthPx"), 0.5f * widthPx);
    glUniform1f(place("nearestM"), static_cast<float>(std::min(projection.nearM, nearestM)));
}

void DebugLines::drawPass(GLsizei lineCount, GLenum depthFunction, float opacity) const {
    glDepthFunc(depthFunction);
    glUniform1f(glGetUniformLocation(program_.name(), "opacity"), opacity);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lineCount);
}

void DebugLines::draw(const View& view, const Projection& projection, std::span<const LineVertex> lines,
                      float widthPx, LineDepth depth) {
    assert(lines.size() % 2 == 0);
    if (lines.empty()) return;
    upload(view.eyeM, lines);
    glUseProgram(program_.name());
    glBindVertexArray(array_.name());
    setUniforms(view, projection, std::clamp(widthPx, 1.0f, 16.0f));

    glViewport(0, 0, view.widthPx, view.heightPx);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_DEPTH_CLAMP);  // lines beyond the near or far plane are drawn at its depth
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    if (projection.reversedZ) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const auto count = static_cast<GLsizei>(lines.size() / 2);
    const GLenum before = projection.reversedZ ? GL_GEQUAL : GL_LEQUAL;
    const GLenum behind = projection.reversedZ ? GL_LESS : GL_GREATER;
    if (depth == LineDepth::Faint) drawPass(count, behind, faintOpacity);
    drawPass(count, depth == LineDepth::InFront ? GL_ALWAYS : before, 1);

    if (projection.reversedZ) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_DEPTH_CLAMP);
    glBlendFunc(GL_ONE, GL_ZERO);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    glUseProgram(0);
}

}  // namespace planet::gl
