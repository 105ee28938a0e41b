// The window with its OpenGL context, and Dear ImGui in it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planet/result.h"
#include "ui/layout.h"

struct GLFWwindow;

namespace worldy {

struct WindowConfig {
    int widthPx = 1600;
    int heightPx = 1000;
    std::filesystem::path imguiFile;  // where ImGui keeps its layout
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
    void endFrame() const;  // draws ImGui's windows and shows the picture

    // GLFW's codes of the keys that went down since the frame before, however short: between two slow frames
    // a key may be up again.
    const std::vector<int>& pressedKeys() const;

    // In ImGui's units; pixelRatio() framebuffer pixels each.
    float width() const;
    float height() const;
    float pixelRatio() const;
    std::string openGlText() const;  // "OpenGL 4.5, llvmpipe"

private:
    Window() = default;
    void startImGui(const std::filesystem::path& imguiFile);

    struct Glfw;
    std::unique_ptr<Glfw> glfw_;
    std::string imguiFile_;
    bool imguiStarted_ = false;
};

}  // namespace worldy
