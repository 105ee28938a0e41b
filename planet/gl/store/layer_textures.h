// The pictures of texture layers on the GPU: two texture arrays with one slice per picture, mipmaps and
// anisotropic filtering. Slice 0 is a checker pattern that marks missing pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/store/layer_picture.h"

namespace planet::gl {

// Returns magenta and black squares, eight per side, flat and rough.
LayerPicture checkerPicture(int size);

class LayerTextures {
public:
    // Creates the textures. size: a power of two, [8, 4096]. The Error says what the context is out of memory
    // for.
    static Result<LayerTextures> create(std::span<const LayerPicture> pictures, int size);

    GLuint albedo() const { return albedo_.name(); }
    GLuint surface() const { return surface_.name(); }
    // Returns the mean linear colour of each slice, the checker's first.
    std::span<const glm::vec3> means() const { return means_; }
    std::size_t bytes() const { return bytes_; }  // including mipmaps

private:
    LayerTextures() = default;
    void fill(std::span<const LayerPicture> pictures, int size);

    Texture albedo_;
    Texture surface_;
    std::vector<glm::vec3> means_;
    std::size_t bytes_ = 0;
};

}  // namespace planet::gl
