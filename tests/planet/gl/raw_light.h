// Light as the shaders reckon it, before it is made fit for a screen: for tests that ask how much of it there
// is.
#pragma once

#include <fstream>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "planet/gl/device/shader_source.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/support/temporary_folder.h"

namespace planet::gl {

// A folder of the built-in shaders whose tone mapping lets light through as it is.
class RawLightShaders {
public:
    RawLightShaders() {
        const std::filesystem::path source = std::filesystem::path(WORLDY_SOURCE_DIR) / "shaders";
        for (const auto& file : std::filesystem::directory_iterator(source))
            std::filesystem::copy_file(file.path(), folder_.path() / file.path().filename());
        std::string tone(embeddedShader("tone.glsl"));
        replaceBody(tone, "vec3 developed(vec3 light) {", "return light;");
        replaceBody(tone, "float ditherStep() {", "return 0.0;");
        std::ofstream(folder_.path() / "tone.glsl") << tone;
    }
    const std::filesystem::path& folder() const { return folder_.path(); }

private:
    static void replaceBody(std::string& text, const std::string& head, const std::string& body) {
        const std::size_t start = text.find(head);
        const std::size_t end = text.find("\n}", start);
        if (start == std::string::npos || end == std::string::npos)
            throw std::runtime_error("there is no " + head);
        text.replace(start + head.size(), end - start - head.size(), " " + body);
    }
    tests::TemporaryFolder folder_;
};

struct LightPicture {
    int width = 0;
    std::vector<glm::vec3> light;  // rows from the top

    const glm::vec3& at(int x, int y) const { return light[static_cast<std::size_t>(y * width + x)]; }
};

inline LightPicture drawLight(ChunkRenderer& renderer, const View& view, std::span<const DrawItem> items,
                              const RenderSettings& settings, std::span<const DrawItem> shadowCasters = {}) {
    const Texture colour = makeTexture();
    glBindTexture(GL_TEXTURE_2D, colour.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, view.widthPx, view.heightPx, 0, GL_RGBA, GL_FLOAT, nullptr);
    const Renderbuffer depth = makeRenderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, view.widthPx, view.heightPx);
    const Framebuffer target = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour.name(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    renderer.draw(view, items, settings, {}, shadowCasters);
    std::vector<glm::vec3> upwards(static_cast<std::size_t>(view.widthPx * view.heightPx));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, view.widthPx, view.heightPx, GL_RGB, GL_FLOAT, upwards.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    LightPicture picture{view.widthPx, {}};
    for (int row = view.heightPx - 1; row >= 0; --row) {
        const auto first = upwards.begin() + static_cast<std::ptrdiff_t>(row) * view.widthPx;
        picture.light.insert(picture.light.end(), first, first + view.widthPx);
    }
    return picture;
}

}  // namespace planet::gl
