// Move-only owners of GL objects. Destroy them while the context that made them is current.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace planet::gl {

template <void (*destroy)(GLuint)>
class Object {
public:
    Object() = default;
    explicit Object(GLuint name) : name_(name) {}
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Object() {
        if (name_ != 0) destroy(name_);
    }

    GLuint name() const { return name_; }  // 0: none

private:
    GLuint name_ = 0;
};

inline void destroyBuffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
inline void destroyTexture(GLuint name) {
    glDeleteTextures(1, &name);
}
inline void destroyVertexArray(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
inline void destroyFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
inline void destroyRenderbuffer(GLuint name) {
    glDeleteRenderbuffers(1, &name);
}
inline void destroyQuery(GLuint name) {
    glDeleteQueries(1, &name);
}
inline void destroyShader(GLuint name) {
    glDeleteShader(name);
}
inline void destroyProgram(GLuint name) {
    glDeleteProgram(name);
}

using Buffer = Object<destroyBuffer>;
using Texture = Object<destroyTexture>;
using VertexArray = Object<destroyVertexArray>;
using Framebuffer = Object<destroyFramebuffer>;
using Renderbuffer = Object<destroyRenderbuffer>;
using Query = Object<destroyQuery>;
using Shader = Object<destroyShader>;
using Program = Object<destroyProgram>;

template <class T, class Generate>
T generated(Generate generate) {
    GLuint name = 0;
    generate(1, &name);
    return T(name);
}
inline Buffer makeBuffer() {
    return generated<Buffer>(glGenBuffers);
}
inline Texture makeTexture() {
    return generated<Texture>(glGenTextures);
}
inline VertexArray makeVertexArray() {
    return generated<VertexArray>(glGenVertexArrays);
}
inline Framebuffer makeFramebuffer() {
    return generated<Framebuffer>(glGenFramebuffers);
}
inline Renderbuffer makeRenderbuffer() {
    return generated<Renderbuffer>(glGenRenderbuffers);
}
inline Query makeQuery() {
    return generated<Query>(glGenQueries);
}

}  // namespace planet::gl
