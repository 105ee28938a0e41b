// The inputs of a vertex shader: each is written once, in the list that both linkProgram and the vertex array
// follow.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>

namespace planet::gl {

enum class InputKind { Integer, Float, Normalised };  // Normalised: integers as [0, 1]

// Its location is its place in the list.
struct VertexInput {
    const char* name = "";  // in GLSL
    GLint components = 1;
    GLenum type = GL_FLOAT;
    InputKind kind = InputKind::Float;
    std::size_t offset = 0;  // bytes, in a vertex or an instance
};

// Tells the bound vertex array to read inputs [first, first + count) of a program from the bound
// GL_ARRAY_BUFFER, whose elements are `stride` bytes apart. divisor: 0 for one element per vertex, 1 for one
// per instance.
void describeInputs(std::span<const VertexInput> inputs, GLuint first, GLsizei stride, GLuint divisor);

}  // namespace planet::gl
