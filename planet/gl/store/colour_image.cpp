#include "planet/gl/store/colour_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/shader_inputs.h"
#include "planet/gl/device/software_renderer.h"
#include "planet/sphere/cube_sphere.h"

namespace planet::gl {

namespace {

struct Pixels {
    std::vector<std::uint8_t> rgb;
    int width = 0;
    int height = 0;
};

std::size_t byteCount(int width, int height) {
    return std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// Averages 2 x 2 pixels; an odd last row or column is dropped.
Pixels halved(const Pixels& from) {
    Pixels to{{}, std::max(from.width / 2, 1), std::max(from.height / 2, 1)};
    to.rgb.reserve(byteCount(to.width, to.height));
    const auto at = [&](int x, int y, int channel) -> int {
        const auto column = static_cast<std::size_t>(std::min(x, from.width - 1));
        const auto row = static_cast<std::size_t>(std::min(y, from.height - 1));
        return from.rgb[(row * static_cast<std::size_t>(from.width) + column) * 3 +
                        static_cast<std::size_t>(channel)];
    };
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                const int sum = at(2 * x, 2 * y, channel) + at(2 * x + 1, 2 * y, channel) +
                                at(2 * x, 2 * y + 1, channel) + at(2 * x + 1, 2 * y + 1, channel);
                to.rgb.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
            }
        }
    }
    return to;
}

std::size_t bytesWithMipmaps(int size) {
    std::size_t bytes = 0;
    for (;; size /= 2) {
        bytes += std::size_t{4} * faceCount * static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
        if (size == 1) return bytes;
    }
}

void setSampling(GLenum target, GLint across, float anisotropy) {
    glTexParameteri(target, GL_TEXTURE_WRAP_S, across);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, mipmapFilter());
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (anisotropy > 1) glTexParameterf(target, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
}

Texture uploaded(std::span<const std::uint8_t> rgb, int width, int height) {
    Texture texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateMipmap(GL_TEXTURE_2D);
    setSampling(GL_TEXTURE_2D, GL_REPEAT, 1);
    return texture;
}

void setAxis(GLuint program, const char* name, const glm::vec3& axis) {
    glUniform3f(glGetUniformLocation(program, name), axis.x, axis.y, axis.z);
}

// Draws each face into its layer and restores the caller's framebuffer and viewport.
void drawFaces(GLuint program, GLuint faces, int size) {
    GLint framebufferBefore = 0;
    std::array<GLint, 4> viewportBefore{};
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebufferBefore);
    glGetIntegerv(GL_VIEWPORT, viewportBefore.data());
    const VertexArray noVertices = makeVertexArray();
    const Framebuffer framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
    glBindVertexArray(noVertices.name());
    glUseProgram(program);
    glUniform1f(glGetUniformLocation(program, "overhang"),
                static_cast<float>(size) / static_cast<float>(std::max(size - 1, 1)));
    glViewport(0, 0, size, size);
    for (const GLenum test : std::to_array<GLenum>({GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST}))
        glDisable(test);
    for (const Face face : allFaces) {
        glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, faces, 0,
                                  static_cast<GLint>(face));
        setAxis(program, "faceNormal", faceAxes(face).normal);
        setAxis(program, "faceU", faceAxes(face).u);
        setAxis(program, "faceV", faceAxes(face).v);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glUseProgram(0);
    glBindVertexArray(0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(framebufferBefore));
    glViewport(viewportBefore[0], viewportBefore[1], viewportBefore[2], viewportBefore[3]);
}

}  // namespace

Result<ColourImage> ColourImage::create(std::span<const std::uint8_t> rgb, int width, int height,
                                        GLuint faceProgram) {
    ColourImage image;
    const bool made = hasRoomFor([&] { image.fill(rgb, width, height, faceProgram); });
    if (made) return image;
    return badInput(
        fmt::format("GPU out of memory: colour image of {} x {} pixels; reduce its size", width, height));
}

void ColourImage::fill(std::span<const std::uint8_t> rgb, int width, int height, GLuint faceProgram) {
    assert(width > 0 && height > 0 && rgb.size() == byteCount(width, height));
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    Pixels smaller;
    while (std::max(width, height) > largest) {
        if (smaller.rgb.empty()) smaller = {{rgb.begin(), rgb.end()}, width, height};
        smaller = halved(smaller);
        rgb = smaller.rgb;
        width = smaller.width;
        height = smaller.height;
    }
    glActiveTexture(GL_TEXTURE0);
    const Texture sphereImage = uploaded(rgb, width, height);

    // A face spans a quarter of the width. A quarter of that is added because each texel is filtered again.
    faceSizePx_ = std::max(width * 5 / 16, 2);
    texture_ = makeTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA8, faceSizePx_, faceSizePx_, faceCount, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, nullptr);
    setSampling(GL_TEXTURE_2D_ARRAY, GL_CLAMP_TO_EDGE, anisotropyToUse());
    bindTexture(Sampler::sphereImage, GL_TEXTURE_2D, sphereImage.name());
    drawFaces(faceProgram, texture_.name(), faceSizePx_);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
    bytes_ = bytesWithMipmaps(faceSizePx_);
}

}  // namespace planet::gl
