// What is done otherwise where the CPU draws, for speed.
#pragma once

#include <epoxy/gl.h>

#include <string_view>

namespace planet::gl {

// Mesa's llvmpipe. Wants a current context.
inline bool isSoftwareRenderer() {
    const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return renderer.find("llvmpipe") != std::string_view::npos;
}

// Mixing two mipmaps costs nothing on a GPU, and as much as a second lookup on a CPU.
inline GLint mipmapFilter() {
    return isSoftwareRenderer() ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
}

}  // namespace planet::gl
