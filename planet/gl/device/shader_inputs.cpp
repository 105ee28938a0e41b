#include "planet/gl/device/shader_inputs.h"

namespace planet::gl {

void connectInputs(const Program& program) {
    for (GLuint binding = 0; binding < uniformBlockCount; ++binding) {
        const GLuint block = glGetUniformBlockIndex(program.name(), uniformBlockNames[binding]);
        if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.name(), block, binding);
    }
    glUseProgram(program.name());
    for (GLuint unit = 0; unit < samplerCount; ++unit)
        glUniform1i(glGetUniformLocation(program.name(), samplerNames[unit]), static_cast<GLint>(unit));
    glUseProgram(0);
}

void bindUniforms(UniformBlock block, const Buffer& buffer) {
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(block), buffer.name());
}

void bindTexture(Sampler sampler, GLenum target, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLuint>(sampler));
    glBindTexture(target, texture);
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace planet::gl
