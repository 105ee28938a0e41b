// Draws a baked planet with its colours, fine normals and shadows in its own window: a complete program that
// embeds planet and planet_gl.
// Usage: embed FILE.chk [FRAMES]
#include <GLFW/glfw3.h>
#include <planet/gl/draw/planet_renderer.h>
#include <planet/planet.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc < 2) return std::fprintf(stderr, "usage: embed FILE.chk [FRAMES]\n"), 2;
    const long frames = argc > 2 ? std::atol(argv[2]) : 1'000'000;

    auto planet = planet::Planet::open(argv[1], {.normals = true});
    if (!planet) return std::fprintf(stderr, "%s\n", planet.error().message.c_str()), 2;

    glfwInit();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(960, 600, "embed", nullptr, nullptr);
    if (window == nullptr) return std::fprintf(stderr, "no OpenGL 3.3\n"), 2;
    glfwMakeContextCurrent(window);
    {
        auto renderer = planet::gl::PlanetRenderer::create(**planet);
        if (!renderer) return std::fprintf(stderr, "%s\n", renderer.error().message.c_str()), 2;
        planet::gl::RenderSettings settings;
        settings.light.shadows.use = settings.light.normals.use = planet::gl::FeatureUse::On;
        planet::CameraPose camera{.latitudeDeg = 28, .longitudeDeg = 80, .altitudeM = 1e5, .pitchDeg = -30};
        for (long frame = 0; frame < frames && !glfwWindowShouldClose(window); ++frame) {
            int width = 0;
            int height = 0;
            glfwGetFramebufferSize(window, &width, &height);
            camera.longitudeDeg += 0.01;
            planet::ViewInput input;
            input.lodView = planet::viewFromPose(camera, (*planet)->tree().shape.radiusM, 1.0, width, height);
            input.colours.enabled = input.normals.enabled = true;
            (*planet)->step(std::span(&input, 1), renderer->upload());
            renderer->draw(**planet, input.lodView, settings);
            glfwSwapBuffers(window);
            glfwPollEvents();
        }
        const planet::gl::RenderCounters& drawn = renderer->chunks().counters();
        std::printf("%u chunks, %llu triangles", drawn.chunks,
                    static_cast<unsigned long long>(drawn.triangles()));
        for (const auto kind :
             {planet::BlockKind::Heights, planet::BlockKind::Colours, planet::BlockKind::Normals})
            std::printf(", %zu resident %s", (*planet)->paging()[kind].resident,
                        kind == planet::BlockKind::Heights   ? "chunks"
                        : kind == planet::BlockKind::Colours ? "colour tiles"
                                                             : "normal tiles");
        std::printf("\n");
    }
    glfwTerminate();
}
