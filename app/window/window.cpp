#include "app/window/window.h"

#include <epoxy/gl.h>
// Must follow epoxy, which provides the GL declarations.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/window/input_queue.h"
#include "planet/gl/device/gpu_clock.h"
#include "planet/spans/span_recorder.h"
#include "ui/kit/theme.h"
#include "ui/shell/text_scale.h"

namespace worldy {

namespace {

std::string glfwProblem() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "unknown";
}

struct WindowSize {
    int width, height;
};

// Clamps the size to the screen, since a stored size may come from another one.
WindowSize fittingSize(const WindowConfig& config) {
    WindowSize size{config.widthPx, config.heightPx};
    if (GLFWmonitor* const monitor = glfwGetPrimaryMonitor()) {
        WindowSize room{};
        glfwGetMonitorWorkarea(monitor, nullptr, nullptr, &room.width, &room.height);
        if (room.width > 0 && room.height > 0) {
            size = {std::min(size.width, room.width), std::min(size.height, room.height)};
        }
    }
    return size;
}

GLFWwindow* createWindow(const WindowConfig& config) {
    const WindowSize size = fittingSize(config);
    constexpr std::array<std::array<int, 2>, 2> versions = {{{4, 5}, {3, 3}}};
    for (const auto& [major, minor] : versions) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        GLFWwindow* window = glfwCreateWindow(size.width, size.height, "Worldy", nullptr, nullptr);
        if (window) return window;
    }
    return nullptr;
}

// Creates a hidden window. Its context has the window's version, because createWindow()'s hints still apply.
GLFWwindow* createHiddenWindow(GLFWwindow* sharing) {
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(1, 1, "Worldy's shaders", nullptr, sharing);
    glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
    return window;
}

// Reads the current context's default framebuffer: rows from the top, sRGB.
Picture readFramebuffer(GLFWwindow* window) {
    Picture picture;
    glfwGetFramebufferSize(window, &picture.width, &picture.height);
    const std::size_t rowBytes = 3 * static_cast<std::size_t>(picture.width);
    std::vector<std::uint8_t> upsideDown(rowBytes * static_cast<std::size_t>(picture.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE, upsideDown.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    picture.rgb.reserve(upsideDown.size());
    for (auto row = upsideDown.end(); row != upsideDown.begin();) {
        row -= static_cast<std::ptrdiff_t>(rowBytes);
        picture.rgb.insert(picture.rgb.end(), row, row + static_cast<std::ptrdiff_t>(rowBytes));
    }
    return picture;
}

// Clears the background behind docks and pictures at once; with software rendering, filling it per window takes much of a
// frame.
void clearForPanels(int widthPx, int heightPx) {
    glViewport(0, 0, widthPx, heightPx);
    const ImVec4& ground = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
    glClearColor(ground.x, ground.y, ground.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

// The part of a monitor that windows may cover, in screen coordinates.
struct WorkArea {
    int x, y, width, height;

    bool contains(int atX, int atY) const {
        return atX >= x && atY >= y && atX < x + width && atY < y + height;
    }
};

std::vector<WorkArea> workAreas() {
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    std::vector<WorkArea> areas;
    for (int i = 0; i < count; ++i) {
        WorkArea area{};
        glfwGetMonitorWorkarea(monitors[i], &area.x, &area.y, &area.width, &area.height);
        areas.push_back(area);
    }
    return areas;
}

// Returns the place if a monitor shows the top of the window there; otherwise one on a monitor without the main window, or
// beside the main window's top left if there is only one monitor.
SecondWindowPlace reachablePlace(SecondWindowPlace place, GLFWwindow* main) {
    constexpr int marginPx = 60;
    const std::vector<WorkArea> areas = workAreas();
    if (std::ranges::any_of(areas, [&](const WorkArea& area) {
            return area.contains(place.x + marginPx, place.y + marginPx);
        }))
        return place;
    int x = 0, y = 0, width = 0, height = 0;
    glfwGetWindowPos(main, &x, &y);
    glfwGetWindowSize(main, &width, &height);
    place.x = x + marginPx;
    place.y = y + marginPx;
    for (const WorkArea& area : areas) {
        if (area.contains(x + width / 2, y + height / 2)) continue;
        place.x = area.x + marginPx;
        place.y = area.y + marginPx;
        break;
    }
    return place;
}

}  // namespace

// GLFW and the window, destroyed together in the right order.
struct Window::Glfw {
    GLFWwindow* window = nullptr;
    GLFWwindow* besides = nullptr;  // never shown; its context shares the window's objects
    GLFWwindow* second = nullptr;   // for a second monitor; its context shares the objects too; null: closed
    bool pressedInSecond = false;   // the last button that went down
    InputQueue input;
    std::array<bool, GLFW_MOUSE_BUTTON_LAST + 1> buttonsDown{};  // in this frame
    std::array<double, GLFW_MOUSE_BUTTON_LAST + 1> pressedAtS = neverPressed();
    std::optional<std::size_t> pressedTwice;  // the button of a double click in this frame

    static constexpr std::array<double, GLFW_MOUSE_BUTTON_LAST + 1> neverPressed() {
        std::array<double, GLFW_MOUSE_BUTTON_LAST + 1> times{};
        times.fill(-1e9);
        return times;
    }
    // Notes a press. Two presses in short succession are a double click, however long the frames between them take.
    void notePress(std::size_t button, double atS);
    std::vector<KeyPress> pressedKeys;
    std::vector<std::filesystem::path> droppedFiles;
    bool hasInput = false;  // since the last frame began

    static Glfw& of(GLFWwindow* handle) { return *static_cast<Glfw*>(glfwGetWindowUserPointer(handle)); }

    ~Glfw() {
        if (second) glfwDestroyWindow(second);
        if (besides) glfwDestroyWindow(besides);
        if (window) glfwDestroyWindow(window);
        glfwTerminate();
    }

    void listenTo(GLFWwindow* handle);
    static void listenForChanges(GLFWwindow* handle);
    // Returns a window's own position as one on the canvas.
    glm::dvec2 onCanvas(const GLFWwindow* handle, glm::dvec2 position) const {
        return handle == second ? position + glm::dvec2(static_cast<double>(ui::secondWindowX), 0) : position;
    }
    // Returns the pointer's position on the canvas if it is in the second window, or if a button is held that went down
    // there.
    std::optional<glm::dvec2> pointerOfSecond() const;
    // Passes the events of the next frame to ImGui. Returns the pointer's position if a button changed.
    std::optional<glm::dvec2> giveInput();
};

namespace {

// With Ctrl, these keys move the focus and the tabs (ui/shell/actions.cpp). ImGui would list its windows, and
// scroll.
bool isCommandOnly(const InputEvent& event) {
    const bool moves =
        event.code == GLFW_KEY_TAB || event.code == GLFW_KEY_PAGE_UP || event.code == GLFW_KEY_PAGE_DOWN;
    return moves && (event.modifiers & GLFW_MOD_CONTROL) != 0;
}

int glfwAction(InputKind kind) {
    if (kind == InputKind::KeyRepeat) return GLFW_REPEAT;
    return kind == InputKind::KeyUp ? GLFW_RELEASE : GLFW_PRESS;
}

}  // namespace

void Window::Glfw::listenTo(GLFWwindow* source) {
    glfwSetWindowUserPointer(source, this);
    glfwSetKeyCallback(source, [](GLFWwindow* handle, int key, int scancode, int action, int modifiers) {
        const InputKind kind = action == GLFW_PRESS     ? InputKind::KeyDown
                               : action == GLFW_RELEASE ? InputKind::KeyUp
                                                        : InputKind::KeyRepeat;
        of(handle).hasInput = true;
        of(handle).input.add(
            {.kind = kind, .code = key, .scancode = scancode, .modifiers = modifiers, .atS = glfwGetTime()});
    });
    glfwSetMouseButtonCallback(source, [](GLFWwindow* handle, int button, int action, int modifiers) {
        glm::dvec2 pointer{0, 0};
        glfwGetCursorPos(handle, &pointer.x, &pointer.y);
        pointer = of(handle).onCanvas(handle, pointer);
        const InputKind kind = action == GLFW_PRESS ? InputKind::ButtonDown : InputKind::ButtonUp;
        of(handle).hasInput = true;
        of(handle).input.add({kind, button, 0, modifiers, pointer, glfwGetTime()});
    });
    glfwSetCharCallback(source, [](GLFWwindow* handle, unsigned int letter) {
        of(handle).hasInput = true;
        of(handle).input.add({InputKind::Text, static_cast<int>(letter)});
    });
    glfwSetDropCallback(source, [](GLFWwindow* handle, int count, const char** files) {
        of(handle).hasInput = true;
        of(handle).droppedFiles.assign(files, files + count);
    });
    glfwSetScrollCallback(source, [](GLFWwindow* handle, double right, double up) {
        of(handle).hasInput = true;
        ImGui_ImplGlfw_ScrollCallback(handle, right, up);
    });
    glfwSetCursorEnterCallback(source, [](GLFWwindow* handle, int entered) {
        of(handle).hasInput = true;
        ImGui_ImplGlfw_CursorEnterCallback(handle, entered);
    });
    glfwSetWindowFocusCallback(source, [](GLFWwindow* handle, int focused) {
        of(handle).hasInput = true;
        ImGui_ImplGlfw_WindowFocusCallback(handle, focused);
    });
    glfwSetMonitorCallback(ImGui_ImplGlfw_MonitorCallback);
    listenForChanges(source);
}

// ImGui's backend asks for the pointer and the size in each frame. These events only say that a frame is needed.
void Window::Glfw::listenForChanges(GLFWwindow* source) {
    glfwSetCursorPosCallback(source, [](GLFWwindow* handle, double, double) { of(handle).hasInput = true; });
    glfwSetFramebufferSizeCallback(source, [](GLFWwindow* handle, int, int) { of(handle).hasInput = true; });
    glfwSetWindowContentScaleCallback(source,
                                      [](GLFWwindow* handle, float, float) { of(handle).hasInput = true; });
    glfwSetWindowRefreshCallback(source, [](GLFWwindow* handle) { of(handle).hasInput = true; });
    glfwSetWindowIconifyCallback(source, [](GLFWwindow* handle, int) { of(handle).hasInput = true; });
    glfwSetWindowCloseCallback(source, [](GLFWwindow* handle) { of(handle).hasInput = true; });
}

std::optional<glm::dvec2> Window::Glfw::pointerOfSecond() const {
    if (!second) return std::nullopt;
    const bool isHeld = std::ranges::find(buttonsDown, true) != buttonsDown.end();
    if (isHeld ? !pressedInSecond : glfwGetWindowAttrib(second, GLFW_HOVERED) == 0) return std::nullopt;
    glm::dvec2 pointer{0, 0};
    glfwGetCursorPos(second, &pointer.x, &pointer.y);
    return onCanvas(second, pointer);
}

void Window::Glfw::notePress(std::size_t button, double atS) {
    const double since = atS - std::exchange(pressedAtS.at(button), atS);
    if (since > static_cast<double>(ImGui::GetIO().MouseDoubleClickTime)) return;
    pressedTwice = button;
    pressedAtS.at(button) = -1e9;  // a third press is no second double click
}

std::optional<glm::dvec2> Window::Glfw::giveInput() {
    pressedTwice.reset();
    std::optional<glm::dvec2> pointer;
    // The field may have lost focus in the last frame, which WantTextInput reports one frame late.
    const bool textFieldIsEdited = ImGui::GetIO().WantTextInput && ImGui::IsAnyItemActive();
    for (const InputEvent& event : input.takeFrame(textFieldIsEdited)) {
        switch (event.kind) {
            case InputKind::Text:
                ImGui_ImplGlfw_CharCallback(window, static_cast<unsigned int>(event.code));
                break;
            case InputKind::ButtonDown:
            case InputKind::ButtonUp:
                pointer = event.pointer;
                if (event.kind == InputKind::ButtonDown) {
                    notePress(static_cast<std::size_t>(event.code), event.atS);
                    pressedInSecond = event.pointer.x >= static_cast<double>(ui::secondWindowX);
                }
                buttonsDown.at(static_cast<std::size_t>(event.code)) = event.kind == InputKind::ButtonDown;
                break;
            case InputKind::KeyDown:
            case InputKind::KeyRepeat:
                pressedKeys.push_back({event.code, event.modifiers});
                if (isCommandOnly(event)) break;
                [[fallthrough]];
            case InputKind::KeyUp:
                ImGui_ImplGlfw_KeyCallback(window, event.code, event.scancode, glfwAction(event.kind),
                                           event.modifiers);
                break;
        }
    }
    return pointer;
}

tl::expected<Window, WindowFailure> Window::open(const WindowConfig& config) {
    if (!glfwInit()) return tl::unexpected(WindowFailure{WindowProblem::NoDisplay, glfwProblem()});
    Window window;
    window.glfw_ = std::make_unique<Glfw>();
    window.glfw_->window = createWindow(config);
    if (!window.glfw_->window) {
        return tl::unexpected(WindowFailure{
            WindowProblem::NoOpenGl,
            fmt::format("this display has no OpenGL 3.3 core profile ({}); a newer graphics driver is needed",
                        glfwProblem())});
    }
    window.glfw_->besides = createHiddenWindow(window.glfw_->window);
    glfwSetWindowSizeLimits(window.glfw_->window, 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window.glfw_->window);
    glfwSwapInterval(1);
    window.startImGui(config);
    return window;
}

Window::Window(Window&& other) noexcept
    : glfw_(std::move(other.glfw_)),
      imguiFile_(std::move(other.imguiFile_)),
      imguiStarted_(std::exchange(other.imguiStarted_, false)),
      theme_(other.theme_),
      appliedScale_(other.appliedScale_),
      panelsTimer_(std::move(other.panelsTimer_)) {
    if (imguiStarted_) ImGui::GetIO().IniFilename = imguiFile_.c_str();
}

Window::~Window() {
    if (!imguiStarted_) return;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

// Returns the scale of the font. If ImGui's units are already scaled to pixels, the font is not scaled again.
float Window::contentScale() const {
    float scale = 1;
    glfwGetWindowContentScale(glfw_->window, &scale, nullptr);
    return std::clamp(scale / pixelRatio(), 0.5f, 4.0f);
}

void Window::startImGui(const WindowConfig& config) {
    ImGui::CreateContext();
    imguiStarted_ = true;
    imguiFile_ = config.imguiFile.string();
    ImGui::GetIO().IniFilename = imguiFile_.c_str();
    // Dragging in a plot of a floating panel must not move the panel.
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    // Otherwise ImGui frees tables of hidden panels, which come back a frame too narrow.
    ImGui::GetIO().ConfigMemoryCompactTimer = -1;
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ImGui_ImplGlfw_InitForOpenGL(glfw_->window, false);
    glfw_->listenTo(glfw_->window);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    panelsTimer_.emplace("panels");
    setTheme(config.theme, config.scale);
}

void Window::setTheme(Theme theme, double scale) {
    const float monitor = contentScale();
    const double fitting = ui::fittingScale(scale, width(), height(), ui::baseFontPx * monitor);
    ui::setShownTextScale(fitting);
    // Fonts come in whole pixels. Other sizes in between would load it again all the time while a window is resized.
    const float wanted =
        fitting < scale ? std::floor(ui::baseFontPx * monitor * static_cast<float>(fitting)) / ui::baseFontPx
                        : monitor * static_cast<float>(scale);
    if (theme == theme_ && wanted == appliedScale_) return;
    const bool first = appliedScale_ == 0;  // the first frame creates the font's texture itself
    theme_ = theme;
    appliedScale_ = wanted;
    if (!first) ImGui_ImplOpenGL3_DestroyFontsTexture();
    ui::applyTheme(theme, wanted);
    if (!first) ImGui_ImplOpenGL3_CreateFontsTexture();
}

bool Window::showSecond(bool shown, const SecondWindowPlace& place) {
    GLFWwindow*& second = glfw_->second;
    if (shown == (second != nullptr)) return true;
    if (!shown) {
        glfwDestroyWindow(std::exchange(second, nullptr));
        glfw_->buttonsDown = {};  // the window that would tell of a release is gone
        return true;
    }
    second = glfwCreateWindow(place.width, place.height, "Worldy: second window", nullptr, glfw_->window);
    if (!second) return false;
    const SecondWindowPlace reachable = reachablePlace(place, glfw_->window);
    glfwSetWindowPos(second, reachable.x, reachable.y);
    glfwSetWindowSizeLimits(second, 320, 200, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfw_->listenTo(second);
    // The main window waits for its monitor; waiting for both would halve the frames.
    glfwMakeContextCurrent(second);
    glfwSwapInterval(0);
    glfwMakeContextCurrent(glfw_->window);
    return true;
}

ui::Rect Window::secondRect() const {
    if (!glfw_->second) return {};
    int width = 0, height = 0;
    glfwGetWindowSize(glfw_->second, &width, &height);
    return {ui::secondWindowX, 0, static_cast<float>(width), static_cast<float>(height)};
}

std::optional<SecondWindowPlace> Window::secondPlace() const {
    if (!glfw_->second) return std::nullopt;
    SecondWindowPlace place;
    glfwGetWindowPos(glfw_->second, &place.x, &place.y);
    glfwGetWindowSize(glfw_->second, &place.width, &place.height);
    return place;
}

glm::dvec2 Window::secondFromMain() const {
    const std::optional<SecondWindowPlace> place = secondPlace();
    if (!place) return {0, 0};
    int x = 0, y = 0;
    glfwGetWindowPos(glfw_->window, &x, &y);
    return {place->x - x, place->y - y};
}

bool Window::takeSecondClosed() const {
    if (!glfw_->second || glfwWindowShouldClose(glfw_->second) == 0) return false;
    glfwSetWindowShouldClose(glfw_->second, GLFW_FALSE);
    return true;
}

// Draws ImGui's windows again, from another place of the canvas. Textures and buffers are shared; the backend makes the
// vertex array, which is not, for each drawing. Leaves the second window's context current.
void Window::drawSecond() const {
    const ui::Rect rect = secondRect();
    int widthPx = 0, heightPx = 0;
    glfwGetFramebufferSize(glfw_->second, &widthPx, &heightPx);
    glfwMakeContextCurrent(glfw_->second);
    if (rect.width <= 0 || rect.height <= 0 || widthPx <= 0 || heightPx <= 0) return;
    ImDrawData part = *ImGui::GetDrawData();
    part.DisplayPos = {rect.x, rect.y};
    part.DisplaySize = {rect.width, rect.height};
    part.FramebufferScale = {static_cast<float>(widthPx) / rect.width,
                             static_cast<float>(heightPx) / rect.height};
    clearForPanels(widthPx, heightPx);
    ImGui_ImplOpenGL3_RenderDrawData(&part);
}

void Window::presentSecond() const {
    if (!glfw_->second) return;
    const planet::SpanScope span("second window");
    drawSecond();
    glfwSwapBuffers(glfw_->second);
    glfwMakeContextCurrent(glfw_->window);
}

void Window::waitForMonitor(bool waits) {
    if (waits == waitsForMonitor_) return;
    waitsForMonitor_ = waits;
    glfwSwapInterval(waits ? 1 : 0);
}

void Window::setClipboard(const std::string& text) const {
    glfwSetClipboardString(glfw_->window, text.c_str());
}

std::shared_ptr<planet::gl::GlWorker> Window::makeShaderWorker() const {
    GLFWwindow* const besides = glfw_->besides;
    if (!besides) return nullptr;
    return std::make_shared<planet::gl::GlWorker>(
        planet::gl::SharedContext{[besides] {
                                      glfwMakeContextCurrent(besides);
                                      return glfwGetCurrentContext() == besides;
                                  },
                                  [] { glfwMakeContextCurrent(nullptr); }});
}

void Window::setTitle(const std::string& title) const {
    glfwSetWindowTitle(glfw_->window, title.c_str());
}

bool Window::closing() const {
    return glfwWindowShouldClose(glfw_->window) != 0;
}

void Window::close() const {
    glfwSetWindowShouldClose(glfw_->window, GLFW_TRUE);
}

void Window::keepOpen() const {
    glfwSetWindowShouldClose(glfw_->window, GLFW_FALSE);
}

bool Window::isFocused() const {
    const auto hasFocus = [](GLFWwindow* window) {
        return window && glfwGetWindowAttrib(window, GLFW_FOCUSED) != 0;
    };
    return hasFocus(glfw_->window) || hasFocus(glfw_->second);
}

bool Window::waitForInput(double waitS) const {
    // Events that wait for their frame are input as well.
    if (waitS > 0 && !glfw_->hasInput && glfw_->input.empty())
        glfwWaitEventsTimeout(waitS);
    else
        glfwPollEvents();
    return glfw_->hasInput || !glfw_->input.empty();
}

void Window::beginFrame(double waitS) const {
    glfw_->pressedKeys.clear();
    waitForInput(waitS);
    glfw_->hasInput = false;
    const std::optional<glm::dvec2> pointer = glfw_->giveInput();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // ImGui's backend reads the current buttons and pointer, which may be later than the event.
    ImGuiIO& io = ImGui::GetIO();
    std::copy_n(glfw_->buttonsDown.begin(), std::size(io.MouseDown), std::begin(io.MouseDown));
    if (const auto at = pointer ? pointer : glfw_->pointerOfSecond())
        io.MousePos = {static_cast<float>(at->x), static_cast<float>(at->y)};
    // ImGui measures the time between two presses in frames, of which a slow one would part them.
    if (const auto twice = glfw_->pressedTwice; twice && *twice < std::size(io.MouseClickedTime))
        io.MouseClickedTime[*twice] = ImGui::GetTime() + static_cast<double>(io.DeltaTime);
    ImGui::NewFrame();
}

void Window::endFrame(const std::function<void()>& drawn) {
    ImGui::Render();
    int widthPx = 0, heightPx = 0;
    glfwGetFramebufferSize(glfw_->window, &widthPx, &heightPx);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    clearForPanels(widthPx, heightPx);
    planet::gl::followGpuClock();
    {
        const planet::SpanScope span("draw panels");
        panelsTimer_->begin();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        panelsTimer_->end();
    }
    drawn();
    const planet::SpanScope span("present");
    const Stopwatch present;
    glfwSwapBuffers(glfw_->window);
    presentMs_ = present.elapsedMs();
    presentSecond();
    glfw_->droppedFiles.clear();
}

const std::vector<KeyPress>& Window::pressedKeys() const {
    return glfw_->pressedKeys;
}

void Window::pressMouse(glm::dvec2 at, int button) const {
    for (const InputKind kind : {InputKind::ButtonDown, InputKind::ButtonUp})
        glfw_->input.add({.kind = kind, .code = button, .pointer = at});
}

std::size_t Window::queuedInput() const {
    return glfw_->input.size();
}

const std::vector<std::filesystem::path>& Window::droppedFiles() const {
    return glfw_->droppedFiles;
}

Picture Window::readPicture() const {
    return readFramebuffer(glfw_->window);
}

Picture Window::readSecondPicture() const {
    drawSecond();
    Picture picture = readFramebuffer(glfw_->second);
    glfwMakeContextCurrent(glfw_->window);
    return picture;
}

double Window::panelsGpuMs() {
    return panelsTimer_->lastMs();
}

double Window::presentMs() const {
    return presentMs_;
}

float Window::width() const {
    int width = 0;
    glfwGetWindowSize(glfw_->window, &width, nullptr);
    return static_cast<float>(width);
}

float Window::height() const {
    int height = 0;
    glfwGetWindowSize(glfw_->window, nullptr, &height);
    return static_cast<float>(height);
}

float Window::pixelRatio() const {
    int widthPx = 0;
    glfwGetFramebufferSize(glfw_->window, &widthPx, nullptr);
    return std::max(static_cast<float>(widthPx), 1.0f) / std::max(width(), 1.0f);
}

std::string Window::openGlText() const {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const int version = epoxy_gl_version();
    return fmt::format("OpenGL {}.{}, {}", version / 10, version % 10, renderer ? renderer : "unknown");
}

}  // namespace worldy
