#include "planet/gl/device/vertex_inputs.h"

namespace planet::gl {

void describeInputs(std::span<const VertexInput> inputs, GLuint first, GLsizei stride, GLuint divisor) {
    GLuint location = first;
    for (const VertexInput& input : inputs) {
        const auto* const offset = reinterpret_cast<const void*>(input.offset);
        if (input.kind == InputKind::Integer)
            glVertexAttribIPointer(location, input.components, input.type, stride, offset);
        else
            glVertexAttribPointer(location, input.components, input.type,
                                  input.kind == InputKind::Normalised ? GL_TRUE : GL_FALSE, stride, offset);
        glEnableVertexAttribArray(location);
        glVertexAttribDivisor(location, divisor);
        ++location;
    }
}

}  // namespace planet::gl
