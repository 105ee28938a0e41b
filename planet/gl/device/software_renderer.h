// Cheaper alternatives for software rendering.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <string_view>

namespace planet::gl {

// Returns whether Mesa's llvmpipe is the renderer. Requires a current context.
inline bool isSoftwareRenderer() {
    const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return renderer.find("llvmpipe") != std::string_view::npos;
}

// Returns the filter between mipmaps: trilinear filtering is free on a GPU, but doubles the cost on a CPU.
inline GLint mipmapFilter() {
    return isSoftwareRenderer() ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
}

// The borders of tiles are wide enough for this anisotropy.
inline constexpr float wantedAnisotropy = 8;

// Returns 1 on Mesa's software renderer, which supports anisotropy but samples some footprints at the wrong
// place.
inline float anisotropyToUse() {
    if (isSoftwareRenderer() || !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) return 1;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    return std::min(most, wantedAnisotropy);
}

}  // namespace planet::gl
