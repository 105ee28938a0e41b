#include "planet/gl/device/object_counts.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

namespace {

// Drivers allocate names in one of two ways. Some return the lowest free name, which leaves no long gaps;
// others return the last name plus 1, so that a new name is above all others.
constexpr GLuint longestGap = 512;

template <class Make, class IsObject>
std::uint32_t countNames(Make make, IsObject isObject) {
    const GLuint fresh = make().name();  // deleted at once
    std::uint32_t count = 0;
    GLuint end = fresh + longestGap;
    for (GLuint name = 1; name < end; ++name) {
        if (isObject(name) == GL_FALSE) continue;
        ++count;
        end = std::max(end, name + longestGap);
    }
    return count;
}

Shader makeShader() {
    return Shader(glCreateShader(GL_VERTEX_SHADER));
}
Program makeProgram() {
    return Program(glCreateProgram());
}

}  // namespace

ObjectCounts countObjects() {
    ObjectCounts counts;
    counts.buffers = countNames(makeBuffer, [](GLuint name) { return glIsBuffer(name); });
    counts.textures = countNames(makeTexture, [](GLuint name) { return glIsTexture(name); });
    counts.vertexArrays = countNames(makeVertexArray, [](GLuint name) { return glIsVertexArray(name); });
    counts.framebuffers = countNames(makeFramebuffer, [](GLuint name) { return glIsFramebuffer(name); });
    counts.renderbuffers = countNames(makeRenderbuffer, [](GLuint name) { return glIsRenderbuffer(name); });
    counts.queries = countNames(makeQuery, [](GLuint name) { return glIsQuery(name); });
    counts.shaders = countNames(makeShader, [](GLuint name) { return glIsShader(name); });
    counts.programs = countNames(makeProgram, [](GLuint name) { return glIsProgram(name); });
    return counts;
}

}  // namespace planet::gl
