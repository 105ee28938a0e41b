// Draws chunks: one static grid, one instanced draw, heights fetched in the vertex shader from one pool.
// OpenGL 3.3 core is enough. Everything here wants a current context, and the same one throughout; one
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "planet/lod_select.h"
#include "planet/planet_shape.h"
#include "planet/result.h"
#include "planet/view.h"

namespace planet::gl {

enum class ColourBy : std::uint8_t {
    None,
    Level,
    Error
};  // Error: eps / tau, green 0, yellow 1, red 2 and over
enum class SurfaceColour : std::uint8_t { Image, HeightRamp };

struct RenderSettings {
    SurfaceColour surface = SurfaceColour::Image;  // Image falls back to HeightRamp where none is loaded
    ColourBy colourBy = ColourBy::None;
    double tauPx = 2;  // scale of ColourBy::Error, pixels
    bool wireframe = false;
    bool skirts = true;
    bool cube = false;  // draws the cube before it is blown up to the sphere
    bool atmosphere = true;
    bool lighting = true;                       // off: flat colour
    glm::dvec3 sunDirection{0.75, 0.45, 0.48};  // world, any length but 0
};

struct RenderCounters {
    std::uint32_t chunks = 0;
    std::uint64_t triangles = 0;  // skirts included
    double drawMs = 0;            // GPU time of the last frame whose timer query has come back
};

// What the context offers, and what was chosen.
struct RenderCapabilities {
    bool reversedZ = false;  // GL_ARB_clip_control; without it the near plane follows the height above ground
    int samples = 1;
};

struct RendererConfig {
    PlanetShape shape;
    std::uint32_t slotCapacity = 0;      // Planet::slotCapacity()
    std::filesystem::path shaderFolder;  // read instead of the shaders built in; empty: built in
};

class ChunkRenderer {
public:
    // The Error says what the context lacks, or what the shader compiler said.
    static Result<ChunkRenderer> create(const RendererConfig& config);
    ChunkRenderer(ChunkRenderer&&) noexcept;
    ChunkRenderer& operator=(ChunkRenderer&&) noexcept;
    ~ChunkRenderer();

    void upload(std::uint32_t slot, std::span<const std::int16_t> heights);

    // Equirectangular sRGB, 3 bytes a pixel, row 0 at the north, column 0 at longitude -180.
    void setColourImage(std::span<const std::uint8_t> rgb, int width, int height);

    // Compiles the shaders of the folder again; on an Error the last good ones go on.
    Result<void> reloadShaders();

    // Clears and fills the bound framebuffer's viewport of view.widthPx x view.heightPx. The framebuffer
    // needs a depth buffer; with reversedZ a float one pays.
    void draw(const View& view, std::span<const DrawItem> items, const RenderSettings& settings);

    const RenderCounters& counters() const;
    const RenderCapabilities& capabilities() const;
    std::size_t gpuBytes() const;  // pool, grid, instances and textures

private:
    struct State;
    explicit ChunkRenderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace planet::gl
