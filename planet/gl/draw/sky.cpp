#include "planet/gl/draw/sky.h"

#include <array>
#include <cstddef>
#include <vector>

namespace planet::gl {

namespace {

constexpr auto vertexInputs =
    std::to_array<VertexInput>({{"star", 3, GL_FLOAT, InputKind::Float, offsetof(Star, direction)},
                                {"starLight", 1, GL_FLOAT, InputKind::Float, offsetof(Star, light)}});

void drawStars(const StarField& field, const View& view) {
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    for (const StarRange& range : starsInView(field, view)) {
        firsts.push_back(static_cast<GLint>(range.first));
        counts.push_back(static_cast<GLsizei>(range.count));
    }
    beginStars();
    glMultiDrawArrays(GL_POINTS, firsts.data(), counts.data(), static_cast<GLsizei>(firsts.size()));
    endStars();
}

}  // namespace

std::span<const VertexInput> starInputs() {
    return vertexInputs;
}

void describeStars(const Buffer& stars) {
    glBindBuffer(GL_ARRAY_BUFFER, stars.name());
    describeInputs(vertexInputs, 0, sizeof(Star), 0);
}

void beginStars() {
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
}

void endStars() {
    glBlendFunc(GL_ONE, GL_ZERO);
    glDisable(GL_BLEND);
    glDisable(GL_PROGRAM_POINT_SIZE);
}

Sky::Sky() : field_(makeStarField()), vertices_(makeBuffer()), array_(makeVertexArray()) {
    const std::span<const Star> stars = field_.stars;
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(stars.size_bytes()), stars.data(), GL_STATIC_DRAW);
    describeStars(vertices_);
    glBindVertexArray(0);
}

void Sky::draw(const View& view, const Program* air, const Program* stars) const {
    glDepthMask(GL_FALSE);
    glBindVertexArray(array_.name());
    if (air) {
        glUseProgram(air->name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    if (stars) {
        glUseProgram(stars->name());
        drawStars(field_, view);
    }
    glDepthMask(GL_TRUE);
}

}  // namespace planet::gl
