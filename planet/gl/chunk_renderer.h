// Draws chunks: one static grid, one instanced draw, heights fetched in the vertex shader from one pool.
// OpenGL 3.3 core is enough. Everything here wants a current context, and the same one throughout; one
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planet/gl/colour_clipmap_state.h"
#include "planet/gl/colour_pool_config.h"
#include "planet/gl/layer_drawing.h"
#include "planet/gl/layer_picture.h"
#include "planet/gl/light_drawing.h"
#include "planet/gl/normal_pool_config.h"
#include "planet/gl/projection.h"
#include "planet/lod_select.h"
#include "planet/planet.h"
#include "planet/planet_shape.h"
#include "planet/result.h"
#include "planet/view.h"

namespace planet::gl {

class ChunkPrograms;

// Whether a draw waits for programs that are not ready, or draws with others until they are.
enum class ShaderWait : std::uint8_t { UntilReady, Never };

// A colour laid over a chunk's finished picture, unlit and in front of the air: sRGB and opacity, [0, 255].
// At 255 the pixels are exactly this colour; at 0 they stay as they are.
struct ChunkTint {
    std::array<std::uint8_t, 4> rgba{};
};

// A colour of the height ramp. Between stops colours mix; beyond the first and last they stay.
struct RampStop {
    double heightM = 0;         // above the sea level
    glm::vec3 colour{0, 0, 0};  // sRGB, [0, 1]

    bool operator==(const RampStop&) const = default;
};

enum class SkirtPaint : std::uint8_t { AsGround, Loud, LoudAlone };  // loud: one glaring colour

enum class SurfaceColour : std::uint8_t { Image, HeightRamp };

inline constexpr std::size_t maxRampStops = 32;

struct RenderSettings {
    SurfaceColour surface = SurfaceColour::Image;  // Image falls back to HeightRamp where none is loaded
    double imageOpacity = 1;                       // of the image over the ramp, [0, 1]
    bool streamed =
        true;  // the planet's own colours, where setColours was given a pool, instead of the image
    double texelsPerPixel =
        1;                   // of streamed colours, as TileSettings has it; larger: sharper, and may shimmer
    double rampTopM = 6000;  // the height ramp's highest band, > 0; the sea is darkest as far below 0
    // Drawn instead of the built-in ramp where there are any, lowest first; at most maxRampStops. The
    // built-in sea keeps its colours unless a stop lies below the sea level.
    std::vector<RampStop> ramp;
    bool sea = true;       // what lies below the sea level is sea; off: dry land, as on the Moon
    double seaLevelM = 0;  // metres above the planet's radius
    double exaggeration =
        1;  // of the heights drawn, > 0: waves, and layers' heights and slopes, mean true ones
    bool wireframe = false;  // the mesh's lines over a dimmed surface
    bool outlines = false;   // the chunks' borders
    SkirtPaint skirtPaint = SkirtPaint::AsGround;
    // Edge vertices move onto a coarser neighbour's (DrawItem::coarserBy), so that no skirt is needed. Off:
    // coarserBy is not looked at, and beside a coarser neighbour an edge morphs as the chunk's inside does.
    bool stitched = false;
    bool cube = false;  // draws the cube before it is blown up to the sphere, without atmosphere
    bool atmosphere = true;
    bool lighting = true;  // off: flat colour, no air before it
    // Roughens near ground between the samples of the heights and the image. What it adds is invented and
    // purely for the eye: light and colour only, no vertex moves. Never seen with tints or without
    // lighting, nor where the samples are finer than two pixels.
    bool detail = true;
    glm::dvec3 sunDirection{0.75, 0.45, 0.48};  // world, any length but 0
    LightDrawing light;
    // Materials painted on near ground that is not sea; their heights count from seaLevelM.
    LayerDrawing layers;
};

struct RenderCounters {
    std::uint32_t chunks = 0;
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    // GPU times of the last frame whose timer queries have come back.
    double chunksMs = 0;  // clearing included
    double skyMs = 0;
    double shadowsMs = 0;
    std::uint32_t uploads = 0;  // chunks uploaded since the draw before
    // Other programs than the settings want were drawn with, or none, since those wanted are still being
    // compiled (ShaderWait::Never): the picture does not show what it is set to show.
    bool standIn = false;

    std::uint64_t triangles() const { return groundTriangles + skirtTriangles; }
};

// What the context offers, and what was chosen.
struct RenderCapabilities {
    // GL_ARB_clip_control. Without it, or with a depth buffer that is not float, the near plane follows the
    // height above the highest ground drawn.
    bool reversedZ = false;
    int samples = 1;        // the most that a RenderTarget can have
    bool software = false;  // the CPU draws
};

// What the renderer holds on the GPU, bytes.
struct GpuMemory {
    std::size_t heightPool = 0;
    std::size_t meshes = 0;  // grid and instances
    std::size_t textures = 0;
    // Of those, what shows streamed colours.
    std::size_t colourTiles = 0;    // the pool of tiles and its page table
    std::size_t colourClipmap = 0;  // 0: there is none
    std::size_t shadowMaps = 0;

    std::size_t total() const { return heightPool + meshes + textures + shadowMaps; }

    GpuMemory& operator+=(const GpuMemory& other) {
        heightPool += other.heightPool;
        meshes += other.meshes;
        textures += other.textures;
        colourTiles += other.colourTiles;
        colourClipmap += other.colourClipmap;
        shadowMaps += other.shadowMaps;
        return *this;
    }
};

struct RendererConfig {
    PlanetShape shape;
    std::uint32_t slotCapacity = 0;      // Planet::slotCapacity()
    std::filesystem::path shaderFolder;  // read instead of the shaders built in; empty: built in
    // Shared with other renderers, so that none waits for what another one has compiled; the folder is theirs
    // then. None: the renderer's own.
    std::shared_ptr<ChunkPrograms> programs{};
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
    // bound for drawing and the viewport; leaves depth test, culling, blending and scissor off. On an Error
    // what there was stays.
    Result<void> setColourImage(std::span<const std::uint8_t> rgb, int width, int height);

    // A pool for the planet's own colours, which then take the image's place; none: the image again. Follow
    // with all of Planet::takeColourChanges() since beginColoursAnew() or the planet's opening. On an Error
    // what there was stays.
    Result<void> setColours(const std::optional<ColourPoolConfig>& config);
    void followColours(std::span<const TileChange> changes);

    // The same colours from a clipmap instead, filled from the pool: windows of so many texels a side that
    // follow a viewer (planet/colour_clipmap.h). None: from the tiles again, and its memory is free. There
    // have to be colours; setColours ends it. On an Error there is none.
    Result<void> setColourClipmap(std::optional<int> sizePx);
    // Puts it around a viewer and fills what that and the changes since bring in: to be called between
    // followColours and draw. Levels finer than the finest that the view wants are not kept. Keeps what is
    // bound for drawing and the viewport; leaves depth test, culling, blending and scissor off. On an Error
    // there is none any more.
    Result<void> moveColourClipmap(const glm::dvec3& eyeM, int finestLevel);
    const ColourClipmapState* colourClipmap() const;  // null where there is none
    // The same for tiles of normals, which are drawn as LightDrawing::normals says: follow with all of
    // Planet::takeNormalChanges().
    Result<void> setNormals(const std::optional<NormalPoolConfig>& config);
    void followNormals(std::span<const TileChange> changes);

    // The pictures that RenderSettings::layers speaks of, all of one size: a power of two, [8, 4096]. On an
    // Error those that there were stay.
    Result<void> setLayers(std::span<const LayerPicture> pictures, int size);

    // Tables of the physical atmosphere that follow a change of its settings: made in the background while
    // the last ones are drawn with, for windows; or, as from the start, waited for.
    void setAirInBackground(bool inBackground);

    // A pool of another size; what it held is gone. On an Error the old one stays.
    Result<void> setSlotCapacity(std::uint32_t slotCapacity);
    // The same planet with other heights: exaggeration has changed.
    void setShape(const PlanetShape& shape);

    // Compiles the shaders again, from the folder where one was given; on an Error the last good ones go on.
    Result<void> reloadShaders();

    // Clears the bound framebuffer and fills its lower left view.widthPx x view.heightPx pixels, sky
    // included. It needs a depth buffer; with reversedZ a float one pays. Leaves depth, culling and clip
    // control as a new context has them. Skirts are drawn where an item's skirt has a depth. Tints: one an
    // item, or none. shadowCasters: chunks that are not drawn but throw shadows (shadow_cascades.h); not
    // looked at where drawsShadows() says no. ShaderWait::Never, where the programs have a worker: the
    // programs that the settings want are compiled in the background. Until they are ready the most similar
    // ones draw, or nothing is drawn; RenderCounters::standIn tells.
    void draw(const View& view, std::span<const DrawItem> items, const RenderSettings& settings,
              std::span<const ChunkTint> tints = {}, std::span<const DrawItem> shadowCasters = {},
              ShaderWait wait = ShaderWait::UntilReady);
    // Whether the ground's shadows, or the sea's surface, would be drawn.
    bool drawsShadows(const RenderSettings& settings) const;
    bool drawsSeaSurface(const RenderSettings& settings) const;
    // What could not be drawn as the settings say since this was asked last, each once.
    std::vector<std::string> takeProblems();

    // How the last draw's depths come to be, for turning them into metres.
    const Projection& projection() const;

    // The positions that the vertex shader makes of the items' grids, morph and stitched edges included,
    // skirts and the sea's surface left out, read back: metres from the eye in world axes, chunkVertexCount
    // for each item. Waits for the GPU; for tests and measuring. Draws nothing, but OpenGL wants a complete
    // framebuffer bound.
    Result<std::vector<glm::vec3>> readVertexPositions(const View& view, std::span<const DrawItem> items,
                                                       const RenderSettings& settings);

    const RenderCounters& counters() const;
    const RenderCapabilities& capabilities() const;
    const AirFigures& airFigures() const;
    GpuMemory gpuMemory() const;

private:
    struct State;
    explicit ChunkRenderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace planet::gl
