// Restores the bound framebuffers and the viewport at the end of a scope. Requires a current context; one
// thread.
#pragma once

#include <epoxy/gl.h>

namespace planet::gl {

class KeepFramebuffers {
public:
    KeepFramebuffers() {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
        glGetIntegerv(GL_VIEWPORT, viewport_);
    }
    ~KeepFramebuffers() {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
        glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    }
    KeepFramebuffers(const KeepFramebuffers&) = delete;
    KeepFramebuffers& operator=(const KeepFramebuffers&) = delete;

private:
    GLint draw_ = 0;
    GLint read_ = 0;
    GLint viewport_[4] = {};
};

}  // namespace planet::gl
