// The window with its OpenGL context, and Dear ImGui in it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "planet/base/result.h"
#include "planet/gl/device/gl_worker.h"
#include "planet/gl/device/gpu_timer.h"
#include "ui/model/layout.h"

struct GLFWwindow;

namespace worldy {

struct WindowConfig {
    int widthPx = 1600;
    int heightPx = 1000;
    std::filesystem::path imguiFile;  // where ImGui keeps its layout
    Theme theme = Theme::Dark;
    double scale = 1;  // of the monitor's own, [0.5, 3]
};

// A key that went down, by GLFW's codes, with GLFW's modifiers.
struct KeyPress {
    int key = 0;
    int modifiers = 0;
};

enum class WindowProblem { NoDisplay, NoOpenGl };
struct WindowFailure {
    WindowProblem problem = WindowProblem::NoDisplay;
    std::string message;
};

// One at a time; main thread only.
class Window {
public:
    static tl::expected<Window, WindowFailure> open(const WindowConfig& config);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept = delete;
    ~Window();

    void setTitle(const std::string& title) const;
    bool closing() const;
    void close() const;

    // Reads input, waiting for it for a while where there is no hurry, and starts ImGui's frame.
    void beginFrame(double waitS) const;
    // Draws ImGui's windows and shows the picture; calls drawn with the picture done but not yet shown.
    void endFrame(const std::function<void()>& drawn);

    // The keys that went down or repeat in this frame, the same that ImGui sees: input is handed out frame by
    // frame (app/editor/input_queue.h), so a key that is released before a slow frame begins is seen too.
    const std::vector<KeyPress>& pressedKeys() const;
    // Events of keys and buttons that wait for the next frames.
    std::size_t queuedInput() const;
    // What was dropped onto the window since the frame before.
    const std::vector<std::filesystem::path>& droppedFiles() const;

    // Between two frames: fonts and colours, where they or the monitor's scale have changed.
    void setTheme(Theme theme, double scale);
    void setClipboard(const std::string& text) const;

    // A thread that compiles shaders for this window's context; null where the driver has no second context
    // for it. It must end before the window.
    std::shared_ptr<planet::gl::GlWorker> makeShaderWorker() const;

    // What the default framebuffer shows, before endFrame's swap of the next frame: rows from the top, sRGB.
    Picture readPicture() const;
    // Of drawing ImGui's windows, and of handing the picture to the monitor.
    double panelsGpuMs();
    double presentMs() const;

    // In ImGui's units; pixelRatio() framebuffer pixels each.
    float width() const;
    float height() const;
    float pixelRatio() const;
    std::string openGlText() const;  // "OpenGL 4.5, llvmpipe"

private:
    Window() = default;
    void startImGui(const WindowConfig& config);
    float contentScale() const;

    struct Glfw;
    std::unique_ptr<Glfw> glfw_;
    std::string imguiFile_;
    bool imguiStarted_ = false;
    Theme theme_ = Theme::Dark;
    float appliedScale_ = 0;  // contentScale times the user's
    std::optional<planet::gl::GpuTimer> panelsTimer_;
    double presentMs_ = 0;
};

}  // namespace worldy
