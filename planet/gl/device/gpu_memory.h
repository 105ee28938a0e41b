// Whether the context has the memory that something is to take.
#pragma once

#include <epoxy/gl.h>

namespace planet::gl {

// Runs what allocates textures or buffers in the current context; false where the context has no room for
// them. Errors from before are dropped. Waits for the context, so not for each frame.
template <class Allocate>
bool hasRoomFor(const Allocate& allocate) {
    while (glGetError() != GL_NO_ERROR) continue;
    allocate();
    return glGetError() == GL_NO_ERROR;
}

}  // namespace planet::gl
