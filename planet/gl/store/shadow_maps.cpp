#include "planet/gl/store/shadow_maps.h"

#include <fmt/format.h>

#include <algorithm>

#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/keep_framebuffers.h"

namespace planet::gl {

Result<ShadowMaps> ShadowMaps::create(int sizePx) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    ShadowMaps maps;
    maps.sizePx_ = std::min(sizePx, static_cast<int>(largest));
    maps.depth_ = makeTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, maps.depth_.name());
    const bool made = hasRoomFor([&] {
        glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, maps.sizePx_, maps.sizePx_,
                     static_cast<GLsizei>(shadowCascadeCount), 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    });
    if (!made) {
        return badInput(fmt::format("GPU out of memory: {} shadow maps of {} x {} px; reduce their size",
                                    shadowCascadeCount, maps.sizePx_, maps.sizePx_));
    }
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    maps.framebuffer_ = makeFramebuffer();
    const KeepFramebuffers keep;
    maps.begin(0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    maps.end();
    if (status != GL_FRAMEBUFFER_COMPLETE) return badInput("this context cannot draw into a depth map");
    return maps;
}

std::size_t ShadowMaps::bytes() const {
    const auto side = static_cast<std::size_t>(sizePx_);
    return side * side * shadowCascadeCount * sizeof(float);
}

void ShadowMaps::begin(std::size_t cascade) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.name(), 0,
                              static_cast<GLint>(cascade));
    glViewport(0, 0, sizePx_, sizePx_);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glClearDepth(1);
    // The offset moves depths away from the sun, in proportion to their slope, so that ground does not shade
    // itself.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 2.0f);
    glClear(GL_DEPTH_BUFFER_BIT);
}

void ShadowMaps::end() {
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
}

}  // namespace planet::gl
