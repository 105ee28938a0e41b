// Draws a baked planet in a window of one's own: all that a program needs to embed planet and planet_gl.
// Usage: embed FILE.chk [FRAMES]
#include <GLFW/glfw3.h>
#include <planet/gl/draw/chunk_renderer.h>
#include <planet/planet.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc < 2) return std::fprintf(stderr, "usage: embed FILE.chk [FRAMES]\n"), 2;
    const long frames = argc > 2 ? std::atol(argv[2]) : 1'000'000;

    auto planet = planet::Planet::open(argv[1], planet::PagingSettings{});
    if (!planet) return std::fprintf(stderr, "%s\n", planet.error().message.c_str()), 2;

    glfwInit();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(960, 600, "embed", nullptr, nullptr);
    if (window == nullptr) return std::fprintf(stderr, "no OpenGL 3.3\n"), 2;
    glfwMakeContextCurrent(window);

    const planet::PlanetShape shape = (*planet)->tree().shape;
    {
        auto renderer = planet::gl::ChunkRenderer::create(
            {shape, (*planet)->paging()[planet::BlockKind::Heights].capacity, {}});
        if (!renderer) return std::fprintf(stderr, "%s\n", renderer.error().message.c_str()), 2;
        const auto upload = [&](std::uint32_t slot, auto heights) { renderer->upload(slot, heights); };
        planet::CameraPose camera{.latitudeDeg = 28, .longitudeDeg = 60, .altitudeM = 8e6};
        for (long frame = 0; frame < frames && !glfwWindowShouldClose(window); ++frame) {
            int width = 0;
            int height = 0;
            glfwGetFramebufferSize(window, &width, &height);
            camera.longitudeDeg += 0.1;
            const planet::View view = planet::viewFromPose(camera, shape.radiusM, 1.0, width, height);
            (*planet)->step(view, planet::LodSettings{}, upload);
            renderer->draw(view, (*planet)->selection().draw, planet::gl::RenderSettings{});
            glfwSwapBuffers(window);
            glfwPollEvents();
        }
        std::printf("%u chunks, %llu triangles, %zu resident\n", renderer->counters().chunks,
                    static_cast<unsigned long long>(renderer->counters().triangles()),
                    (*planet)->paging()[planet::BlockKind::Heights].resident);
    }
    glfwTerminate();
}
