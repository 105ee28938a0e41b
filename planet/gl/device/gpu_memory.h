// Checks that an allocation fits into GPU memory.
#pragma once

#include <epoxy/gl.h>

namespace planet::gl {

// Runs a function that allocates textures or buffers in the current context. Returns false if the context is
// out of memory. Discards earlier GL errors. Waits for the context, so do not call it every frame.
template <class Allocate>
bool hasRoomFor(const Allocate& allocate) {
    while (glGetError() != GL_NO_ERROR) continue;
    allocate();
    return glGetError() == GL_NO_ERROR;
}

}  // namespace planet::gl
