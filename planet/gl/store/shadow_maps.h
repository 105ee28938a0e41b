// The depth maps of the sun's cascades. Requires a current context; one thread.
#pragma once

#include <cstddef>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/select/shadow_cascades.h"

namespace planet::gl {

class ShadowMaps {
public:
    // Clamps the size to the context's largest. The Error says what the context cannot do.
    static Result<ShadowMaps> create(int sizePx);

    int sizePx() const { return sizePx_; }
    GLuint texture() const { return depth_.name(); }  // an array with depth comparison: 1 is lit by the sun
    std::size_t bytes() const;

    // Binds and clears a cascade's map and sets the state to draw into it. Depths nearer to the sun than the
    // map's range are clamped. end() restores the state of a new context; the framebuffer and the viewport
    // stay changed.
    void begin(std::size_t cascade);
    static void end();

private:
    ShadowMaps() = default;

    int sizePx_ = 0;
    Texture depth_;
    Framebuffer framebuffer_;
};

}  // namespace planet::gl
