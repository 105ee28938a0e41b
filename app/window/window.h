// The window with its OpenGL context and Dear ImGui.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
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
    std::filesystem::path imguiFile;  // ImGui's layout file
    Theme theme = Theme::Dark;
    double scale = 1;  // relative to the monitor's scale, [0.5, 3]
};

// A key press with GLFW's key code and modifiers.
struct KeyPress {
    int key = 0;
    int modifiers = 0;
};

enum class WindowProblem { NoDisplay, NoOpenGl };
struct WindowFailure {
    WindowProblem problem = WindowProblem::NoDisplay;
    std::string message;
};

// Only one may exist. Main thread only.
class Window {
public:
    static tl::expected<Window, WindowFailure> open(const WindowConfig& config);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept = delete;
    ~Window();

    void setTitle(const std::string& title) const;
    bool closing() const;
    void close() const;
    void keepOpen() const;   // after the user wanted to close it
    bool isFocused() const;  // keys go to this window or to the second one

    // Waits for input, but not longer than waitS seconds. Returns whether input has come since the last frame began: keys,
    // buttons, the pointer, dropped files, or a change of the window itself.
    bool waitForInput(double waitS) const;
    // Reads input, waiting up to waitS for it, and starts ImGui's frame.
    void beginFrame(double waitS) const;
    // Draws ImGui's windows and presents the frame. Calls drawn when the frame is drawn but not yet
    // presented.
    void endFrame(const std::function<void()>& drawn);

    // Returns the keys pressed or repeated in this frame, the same that ImGui sees. Input is handed out frame
    // by frame (app/window/input_queue.h), so a key released before a slow frame begins is not lost.
    const std::vector<KeyPress>& pressedKeys() const;
    // Presses and releases a mouse button of ImGui's at a place in the next two frames. The pointer stays where
    // it is otherwise.
    void pressMouse(glm::dvec2 at, int button) const;
    // Returns the number of key and button events that wait for the next frames.
    std::size_t queuedInput() const;
    // Returns the files dropped onto the window since the last frame.
    const std::vector<std::filesystem::path>& droppedFiles() const;

    // Opens or closes the second window. It shows ImGui's canvas from ui::secondWindowX on. Returns false if the system
    // cannot open it; nothing is shown then.
    bool showSecond(bool shown, const SecondWindowPlace& place);
    // Return where the second window is on the canvas, empty while it is closed, and on the screen.
    ui::Rect secondRect() const;
    std::optional<SecondWindowPlace> secondPlace() const;
    // Returns the top left of the second window on the screen, relative to this window's.
    glm::dvec2 secondFromMain() const;
    // Returns once that the user wants to close the second window.
    bool takeSecondClosed() const;

    // Limits the frames to those of the monitor, or not at all. Cheap if nothing has changed.
    void waitForMonitor(bool waits);
    // Updates fonts and colours if the theme or scale has changed. Call between two frames.
    void setTheme(Theme theme, double scale);
    void setClipboard(const std::string& text) const;

    // Returns a thread that compiles shaders for this window's context; null if the driver has no second
    // context for it. It must end before the window.
    std::shared_ptr<planet::gl::GlWorker> makeShaderWorker() const;

    // Reads the default framebuffer before the next endFrame() swaps it: rows from the top, sRGB.
    Picture readPicture() const;
    // Reads the second window likewise, from within endFrame(). It must be open.
    Picture readSecondPicture() const;
    // Return the GPU time of drawing ImGui's windows, and the time of presenting the frame.
    double panelsGpuMs();
    double presentMs() const;

    // The window's size in ImGui's units, each of which is pixelRatio() framebuffer pixels.
    float width() const;
    float height() const;
    float pixelRatio() const;
    std::string openGlText() const;  // "OpenGL 4.5, llvmpipe"

private:
    Window() = default;
    void startImGui(const WindowConfig& config);
    void drawSecond() const;
    void presentSecond() const;
    float contentScale() const;

    struct Glfw;
    std::unique_ptr<Glfw> glfw_;
    std::string imguiFile_;
    bool imguiStarted_ = false;
    Theme theme_ = Theme::Dark;
    float appliedScale_ = 0;  // contentScale() times the user's
    std::optional<planet::gl::GpuTimer> panelsTimer_;
    double presentMs_ = 0;
    bool waitsForMonitor_ = true;
};

}  // namespace worldy
