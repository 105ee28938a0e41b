// An OpenGL context without a window or a display, created with EGL, for headless runs and tests.
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
    ContextVersion highest{4, 6};  // the highest version requested, >= 3.3
    bool debug = false;            // the driver reports errors through GL_KHR_debug
};

// The context is current on the thread that created it until it is destroyed or another one becomes current.
class OffscreenContext {
public:
    // Creates a core-profile context of the highest available version from settings.highest down to 3.3.
    // Tries Mesa without a surface first, then EGL's devices. The Error says what each of them lacks.
    static Result<OffscreenContext> create(const OffscreenSettings& settings = {});
    // Creates a context that shares programs, textures and buffers with this one. It is not made current.
    Result<OffscreenContext> sharing() const;
    OffscreenContext(OffscreenContext&& other) noexcept;
    OffscreenContext& operator=(OffscreenContext&& other) noexcept;
    ~OffscreenContext();

    bool makeCurrent() const;
    // Leaves the calling thread without a current context.
    void release() const;

    ContextVersion version() const { return version_; }
    const std::string& renderer() const { return renderer_; }  // as the driver reports it

private:
    OffscreenContext() = default;

    void* display_ = nullptr;  // EGLDisplay, shared by all contexts of the process
    void* context_ = nullptr;  // EGLContext
    void* config_ = nullptr;   // EGLConfig
    bool debug_ = false;
    ContextVersion version_;
    std::string renderer_;
};

}  // namespace planet::gl
