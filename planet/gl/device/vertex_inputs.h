// The inputs of a vertex shader. Each is declared once, in a list that both linkProgram and the vertex array
// use.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>

namespace planet::gl {

enum class InputKind { Integer, Float, Normalised };  // Normalised: integers read as [0, 1]

// An input's location is its index in the list.
struct VertexInput {
    const char* name = "";  // in GLSL
    GLint components = 1;
    GLenum type = GL_FLOAT;
    InputKind kind = InputKind::Float;
    std::size_t offset = 0;  // bytes, in a vertex or an instance
};

// Makes the bound vertex array read inputs [first, first + count) of a program from the bound
// GL_ARRAY_BUFFER. stride: bytes from one element to the next. divisor: 0 for one element per vertex, 1 for
// one per instance.
void describeInputs(std::span<const VertexInput> inputs, GLuint first, GLsizei stride, GLuint divisor);

}  // namespace planet::gl
