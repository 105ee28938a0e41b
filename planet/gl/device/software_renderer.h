// What is done otherwise where the CPU draws, for speed.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
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

// Borders of tiles are wide enough for the samples of this.
inline constexpr float wantedAnisotropy = 8;

// Mesa's software renderer has anisotropy, but some footprints make it sample at the wrong place.
inline float anisotropyToUse() {
    if (isSoftwareRenderer() || !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) return 1;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    return std::min(most, wantedAnisotropy);
}

}  // namespace planet::gl
