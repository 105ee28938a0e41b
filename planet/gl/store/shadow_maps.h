// What the sun sees of the ground: a depth map for each cascade. Wants a current context; one thread.
#pragma once

#include <cstddef>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/select/shadow_cascades.h"

namespace planet::gl {

class ShadowMaps {
public:
    // The largest side that the context can have is taken where it is less. The Error says what the context
    // cannot do.
    static Result<ShadowMaps> create(int sizePx);

    int sizePx() const { return sizePx_; }
    GLuint texture() const { return depth_.name(); }  // an array, compared: 1 where the sun is seen
    std::size_t bytes() const;

    // Binds a cascade's map to be drawn into, cleared, with the state that drawing it wants; what is nearer
    // to the sun than the map's range is clamped. end() leaves the state as a new context has it; the
    // framebuffer and the viewport stay.
    void begin(std::size_t cascade);
    static void end();

private:
    ShadowMaps() = default;

    int sizePx_ = 0;
    Texture depth_;
    Framebuffer framebuffer_;
};

}  // namespace planet::gl
