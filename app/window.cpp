#include "app/window.h"

#include <epoxy/gl.h>
// After epoxy, which brings the GL declarations.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ui/theme.h"

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

// No larger than the screen has room for: kept sizes may come from another one.
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

}  // namespace

// GLFW itself and the one window, ended together and in order.
struct Window::Glfw {
    GLFWwindow* window = nullptr;
    std::vector<int> pressedKeys;

    ~Glfw() {
        if (window) glfwDestroyWindow(window);
        glfwTerminate();
    }
};

tl::expected<Window, WindowFailure> Window::open(const WindowConfig& config) {
    if (!glfwInit()) return tl::unexpected(WindowFailure{WindowProblem::NoDisplay, glfwProblem()});
    Window window;
    window.glfw_ = std::make_unique<Glfw>();
    window.glfw_->window = createWindow(config);
    if (!window.glfw_->window) {
        return tl::unexpected(WindowFailure{
            WindowProblem::NoOpenGl,
            fmt::format(
                "this display has no OpenGL 3.3 core profile ({}); a newer graphics driver would be right",
                glfwProblem())});
    }
    glfwSetWindowUserPointer(window.glfw_->window, window.glfw_.get());
    glfwSetKeyCallback(window.glfw_->window, [](GLFWwindow* handle, int key, int, int action, int) {
        if (action == GLFW_PRESS)
            static_cast<Glfw*>(glfwGetWindowUserPointer(handle))->pressedKeys.push_back(key);
    });
    glfwSetWindowSizeLimits(window.glfw_->window, 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window.glfw_->window);
    glfwSwapInterval(1);
    window.startImGui(config.imguiFile);
    return window;
}

Window::Window(Window&& other) noexcept
    : glfw_(std::move(other.glfw_)),
      imguiFile_(std::move(other.imguiFile_)),
      imguiStarted_(std::exchange(other.imguiStarted_, false)) {
    if (imguiStarted_) ImGui::GetIO().IniFilename = imguiFile_.c_str();
}

Window::~Window() {
    if (!imguiStarted_) return;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Window::startImGui(const std::filesystem::path& imguiFile) {
    ImGui::CreateContext();
    imguiStarted_ = true;
    imguiFile_ = imguiFile.string();
    ImGui::GetIO().IniFilename = imguiFile_.c_str();
    ImGui_ImplGlfw_InitForOpenGL(glfw_->window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    float scale = 1;
    glfwGetWindowContentScale(glfw_->window, &scale, nullptr);
    // Where ImGui's units are already scaled to pixels, the font must not be scaled a second time.
    ui::applyTheme(std::clamp(scale / pixelRatio(), 0.5f, 4.0f));
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

void Window::beginFrame(double waitS) const {
    glfw_->pressedKeys.clear();
    if (waitS > 0)
        glfwWaitEventsTimeout(waitS);
    else
        glfwPollEvents();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::endFrame() const {
    ImGui::Render();
    int widthPx = 0, heightPx = 0;
    glfwGetFramebufferSize(glfw_->window, &widthPx, &heightPx);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, widthPx, heightPx);
    glClearColor(0.1f, 0.1f, 0.1f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(glfw_->window);
}

const std::vector<int>& Window::pressedKeys() const {
    return glfw_->pressedKeys;
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
