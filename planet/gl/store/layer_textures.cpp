#include "planet/gl/store/layer_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/software_renderer.h"

namespace planet::gl {

namespace {

Texture makeArray(GLenum format, int size, int slices) {
    Texture texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(format), size, size, slices, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, mipmapFilter());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    const float anisotropy = anisotropyToUse();
    if (anisotropy > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
    return texture;
}

void upload(GLuint texture, int slice, int size, std::span<const std::uint8_t> texels) {
    assert(texels.size() == std::size_t{4} * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, slice, size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                    texels.data());
}

glm::vec3 meanLight(std::span<const std::uint8_t> albedo) {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const double value = static_cast<double>(i) / 255;
        linear[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    }
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i + 3 < albedo.size(); i += 4)
        sum += glm::dvec3(linear[albedo[i]], linear[albedo[i + 1]], linear[albedo[i + 2]]);
    const std::size_t texels = std::max<std::size_t>(albedo.size() / 4, 1);
    return sum / static_cast<double>(texels);
}

}  // namespace

LayerPicture checkerPicture(int size) {
    LayerPicture picture;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool loud = ((8 * x / size) + (8 * y / size)) % 2 == 0;
            const std::array<std::uint8_t, 4> magenta = {255, 0, 255, 128}, black = {0, 0, 0, 128};
            const auto& texel = loud ? magenta : black;
            picture.albedo.insert(picture.albedo.end(), texel.begin(), texel.end());
            picture.surface.insert(picture.surface.end(), {128, 128, 255, 255});
        }
    }
    return picture;
}

Result<LayerTextures> LayerTextures::create(std::span<const LayerPicture> pictures, int size) {
    LayerTextures textures;
    const bool made = hasRoomFor([&] { textures.fill(pictures, size); });
    if (made) return textures;
    return badInput(
        fmt::format("GPU out of memory: {} layer textures of {} x {} texels; reduce their size or number",
                    std::max<std::size_t>(2 * pictures.size(), 1), size, size));
}

void LayerTextures::fill(std::span<const LayerPicture> pictures, int size) {
    const int slices = static_cast<int>(pictures.size()) + 1;
    glActiveTexture(GL_TEXTURE0);
    albedo_ = makeArray(GL_SRGB8_ALPHA8, size, slices);
    surface_ = makeArray(GL_RGBA8, size, slices);
    const LayerPicture checker = checkerPicture(size);
    for (int slice = 0; slice < slices; ++slice) {
        const LayerPicture& picture = slice == 0 ? checker : pictures[static_cast<std::size_t>(slice) - 1];
        upload(albedo_.name(), slice, size, picture.albedo);
        upload(surface_.name(), slice, size, picture.surface);
        means_.push_back(meanLight(picture.albedo));
    }
    for (const GLuint texture : {albedo_.name(), surface_.name()}) {
        glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
        // The checkerboard alone is not drawn, and a software renderer compiles code for its mipmaps.
        if (pictures.empty())
            glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
        else
            glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
    }
    const std::size_t texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    const std::size_t withMipmaps = pictures.empty() ? texels : (4 * texels - 1) / 3;
    bytes_ = 2 * 4 * static_cast<std::size_t>(slices) * withMipmaps;
}

}  // namespace planet::gl
