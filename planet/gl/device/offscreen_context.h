// An OpenGL context without a window or a display, through EGL: for headless runs and tests.
#pragma once

#include <string>
#include <utility>

#include "planet/base/result.h"

namespace planet::gl {

struct ContextVersion {
    int major = 0;
    int minor = 0;

    auto operator<=>(const ContextVersion&) const = default;
};

struct OffscreenSettings {
    ContextVersion highest{4, 6};  // not asked for more than this; at least 3.3
    bool debug = false;            // the driver reports errors through GL_KHR_debug
};

// Current on the thread that made it until it is destroyed or another is made current there.
class OffscreenContext {
public:
    // Core profile, the highest version from settings.highest down to 3.3 that there is. Tries Mesa without a
    // surface first, then EGL's devices. The Error says what each lacks.
    static Result<OffscreenContext> create(const OffscreenSettings& settings = {});
    // A second one, whose programs, textures and buffers are those of this one too; it is current nowhere.
    Result<OffscreenContext> sharing() const;
    OffscreenContext(OffscreenContext&& other) noexcept;
    OffscreenContext& operator=(OffscreenContext&& other) noexcept;
    ~OffscreenContext();

    bool makeCurrent() const;
    // Leaves the calling thread without a current context.
    void release() const;

    ContextVersion version() const { return version_; }
    const std::string& renderer() const { return renderer_; }  // the driver's name for itself

private:
    OffscreenContext() = default;

    void* display_ = nullptr;  // EGLDisplay, shared by all contexts of this process on it
    void* context_ = nullptr;  // EGLContext
    void* config_ = nullptr;   // EGLConfig
    bool debug_ = false;
    ContextVersion version_;
    std::string renderer_;
};

}  // namespace planet::gl
