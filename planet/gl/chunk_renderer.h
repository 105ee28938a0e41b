// Draws chunks: one static grid, one instanced draw, heights fetched in the vertex shader from one pool.
// OpenGL 3.3 core is enough. Everything here wants a current context, and the same one throughout; one
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "planet/gl/projection.h"
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
    double tauPx = 2;        // scale of ColourBy::Error, pixels, > 0
    double rampTopM = 6000;  // the height ramp's highest band, > 0; the sea is darkest as far below 0
    bool sea = true;         // what lies below height 0 is sea; off: dry land, as on the Moon
    bool wireframe = false;  // the mesh's lines over a dimmed surface
    bool skirts = true;
    bool cube = false;  // draws the cube before it is blown up to the sphere, without atmosphere
    bool atmosphere = true;
    bool lighting = true;  // off: flat colour, no air before it
    // Roughens near ground between the samples of the heights and the image. What it adds is invented and
    // purely for the eye: light and colour only, no vertex moves. Never seen with ColourBy or without
    // lighting, nor where the samples are finer than two pixels.
    bool detail = true;
    glm::dvec3 sunDirection{0.75, 0.45, 0.48};  // world, any length but 0
};

struct RenderCounters {
    std::uint32_t chunks = 0;
    std::uint64_t triangles = 0;  // skirts included
    double drawMs = 0;            // GPU time of the last frame whose timer query has come back
};

// What the context offers, and what was chosen.
struct RenderCapabilities {
    // GL_ARB_clip_control. Without it, or with a depth buffer that is not float, the near plane follows the
    // height above the highest ground drawn.
    bool reversedZ = false;
    int samples = 1;  // the most that a RenderTarget can have
};

// What ColourBy draws, sRGB in [0, 1]: for legends. Exactly this colour with lighting off.
glm::vec3 levelColour(int level);
glm::vec3 errorColour(double epsOverTau);

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

    // chunkVertexCount steps, row by row from the south, into a slot below slotCapacity.
    void upload(std::uint32_t slot, std::span<const std::int16_t> heights);

    // Equirectangular sRGB, 3 bytes a pixel, row 0 at the north, column 0 at longitude -180. Keeps what is
    // bound for drawing and the viewport; leaves depth test, culling, blending and scissor off.
    void setColourImage(std::span<const std::uint8_t> rgb, int width, int height);

    // Compiles the shaders again, from the folder where one was given; on an Error the last good ones go on.
    Result<void> reloadShaders();

    // Clears the bound framebuffer and fills its lower left view.widthPx x view.heightPx pixels, sky
    // included. It needs a depth buffer; with reversedZ a float one pays. Leaves depth, culling and clip
    // control as a new context has them.
    void draw(const View& view, std::span<const DrawItem> items, const RenderSettings& settings);

    // How the last draw's depths come to be, for turning them into metres.
    const Projection& projection() const;

    // The positions that the vertex shader makes of the items' grids, skirts left out, read back: metres from
    // the eye in world axes, chunkVertexCount for each item. Waits for the GPU; for tests and measuring.
    // Draws nothing, but OpenGL wants a complete framebuffer bound.
    Result<std::vector<glm::vec3>> readVertexPositions(const View& view, std::span<const DrawItem> items,
                                                       const RenderSettings& settings);

    const RenderCounters& counters() const;
    const RenderCapabilities& capabilities() const;
    std::size_t gpuBytes() const;  // pool, grid, instances and textures

private:
    struct State;
    explicit ChunkRenderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace planet::gl
