#include "planet/gl/device/offscreen_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace planet::gl {

namespace {

constexpr std::array<ContextVersion, 8> versions = {
    {{4, 6}, {4, 5}, {4, 4}, {4, 3}, {4, 2}, {4, 1}, {4, 0}, {3, 3}}};

bool hasWord(const char* list, std::string_view word) {
    if (list == nullptr) return false;
    const std::string padded = fmt::format(" {} ", list);
    return padded.find(fmt::format(" {} ", word)) != std::string::npos;
}

struct Candidate {
    std::string name;
    EGLDisplay display = EGL_NO_DISPLAY;
};

// Drivers that draw on the CPU have the extension EGL_MESA_device_software.
struct Devices {
    std::vector<Candidate> hardware;
    std::vector<Candidate> software;
};

Devices findDevices(bool canQuery) {
    Devices found;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return found;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        const bool isSoftware =
            canQuery && hasWord(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        (isSoftware ? found.software : found.hardware)
            .push_back({fmt::format("EGL device {}", i),
                        eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr)});
    }
    return found;
}

// GPUs come first: Mesa's display without a surface is a CPU where another vendor's driver has the GPU.
std::vector<Candidate> findDisplays() {
    const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!hasWord(extensions, "EGL_EXT_platform_base")) return {};
    Devices devices;
    const bool base = hasWord(extensions, "EGL_EXT_device_base");  // both of the extensions below
    if (hasWord(extensions, "EGL_EXT_platform_device") &&
        (base || hasWord(extensions, "EGL_EXT_device_enumeration")))
        devices = findDevices(base || hasWord(extensions, "EGL_EXT_device_query"));
    std::vector<Candidate> candidates = std::move(devices.hardware);
    if (hasWord(extensions, "EGL_MESA_platform_surfaceless")) {
        candidates.push_back(
            {"Mesa without a surface",
             eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
    }
    candidates.insert(candidates.end(), devices.software.begin(), devices.software.end());
    return candidates;
}

EGLContext createContext(EGLDisplay display, EGLConfig config, ContextVersion version, bool debug,
                         EGLContext shared = EGL_NO_CONTEXT) {
    const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                              version.major,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              version.minor,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_CONTEXT_OPENGL_DEBUG,
                                              debug ? EGL_TRUE : EGL_FALSE,
                                              EGL_NONE};
    return eglCreateContext(display, config, shared, attributes.data());
}

struct Opened {
    EGLContext context = EGL_NO_CONTEXT;
    EGLConfig config = nullptr;
    std::string problem;
};

Opened openOn(EGLDisplay display, const OffscreenSettings& settings) {
    EGLint major = 0;
    EGLint minor = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor))
        return {EGL_NO_CONTEXT, nullptr, "cannot be initialised"};
    if (major == 1 && minor < 5)
        return {EGL_NO_CONTEXT, nullptr, fmt::format("has EGL {}.{}, needs 1.5", major, minor)};
    if (!hasWord(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
        return {EGL_NO_CONTEXT, nullptr, "lacks EGL_KHR_surfaceless_context"};
    if (!eglBindAPI(EGL_OPENGL_API)) return {EGL_NO_CONTEXT, nullptr, "has OpenGL ES only"};
    // No EGL surface is used, so any config works; this requests none with surface support.
    const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted.data(), &config, 1, &count) || count == 0)
        return {EGL_NO_CONTEXT, nullptr, "has no config for OpenGL"};
    for (const ContextVersion& version : versions) {
        if (settings.highest < version) continue;
        const EGLContext context = createContext(display, config, version, settings.debug);
        if (context != EGL_NO_CONTEXT) return {context, config, {}};
    }
    return {EGL_NO_CONTEXT, nullptr, "has no OpenGL core profile of version 3.3 or higher"};
}

}  // namespace

Result<OffscreenContext> OffscreenContext::create(const OffscreenSettings& settings) {
    const std::vector<Candidate> candidates = findDisplays();
    if (candidates.empty()) {
        return badInput(
            "EGL offers no way to draw without a window: it lacks EGL_EXT_platform_base with "
            "EGL_MESA_platform_surfaceless or EGL_EXT_platform_device");
    }
    std::string problems;
    for (const Candidate& candidate : candidates) {
        const Opened opened = openOn(candidate.display, settings);
        if (opened.context == EGL_NO_CONTEXT) {
            problems += fmt::format("{}{} {}", problems.empty() ? "" : "; ", candidate.name, opened.problem);
            continue;
        }
        OffscreenContext context;
        context.display_ = candidate.display;
        context.context_ = opened.context;
        context.config_ = opened.config;
        context.debug_ = settings.debug;
        context.makeCurrent();
        glGetIntegerv(GL_MAJOR_VERSION, &context.version_.major);
        glGetIntegerv(GL_MINOR_VERSION, &context.version_.minor);
        context.renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        return context;
    }
    return badInput("no OpenGL context without a window: " + problems);
}

OffscreenContext::OffscreenContext(OffscreenContext&& other) noexcept
    : display_(other.display_),
      context_(std::exchange(other.context_, nullptr)),
      config_(other.config_),
      debug_(other.debug_),
      version_(other.version_),
      renderer_(std::move(other.renderer_)) {}

OffscreenContext& OffscreenContext::operator=(OffscreenContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    std::swap(config_, other.config_);
    std::swap(debug_, other.debug_);
    std::swap(version_, other.version_);
    std::swap(renderer_, other.renderer_);
    return *this;
}

OffscreenContext::~OffscreenContext() {
    if (context_ == nullptr) return;
    if (eglGetCurrentContext() == context_)
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    // The display stays initialised, because EGL gives the same one to the whole process.
    eglDestroyContext(display_, context_);
}

Result<OffscreenContext> OffscreenContext::sharing() const {
    eglBindAPI(EGL_OPENGL_API);
    OffscreenContext context;
    context.context_ = createContext(display_, config_, version_, debug_, context_);
    if (context.context_ == EGL_NO_CONTEXT)
        return badInput("this driver does not share objects between OpenGL contexts");
    context.display_ = display_;
    context.config_ = config_;
    context.debug_ = debug_;
    context.version_ = version_;
    context.renderer_ = renderer_;
    return context;
}

bool OffscreenContext::makeCurrent() const {
    return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

void OffscreenContext::release() const {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace planet::gl
