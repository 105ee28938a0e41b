// Draws chunks with one static grid and one instanced draw call; the vertex shader fetches heights from one
// pool. Requires OpenGL 3.3 core, and the same current context for all calls; one thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/draw/projection.h"
#include "planet/gl/draw/render_counters.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/gl/store/colour_clipmap_state.h"
#include "planet/gl/store/colour_pool_config.h"
#include "planet/gl/store/layer_picture.h"
#include "planet/gl/store/normal_pool_config.h"
#include "planet/paging/paging_types.h"
#include "planet/select/lod_types.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"
#include "planet/sphere/view.h"
#include "planet/surface/atmosphere.h"

namespace planet::gl {

class ChunkPrograms;
struct CapturedDraw;  // planet/gl/draw/captured_draw.h

// Selects whether a draw waits for programs that are not ready, or uses others until they are.
enum class ShaderWait : std::uint8_t { UntilReady, Never };

struct RendererConfig {
    PlanetShape shape;
    std::uint32_t slotCapacity = 0;      // PagingCounters: the capacity of heights
    std::filesystem::path shaderFolder;  // empty: the built-in shaders
    // Shared with other renderers, so that none waits for a program that another one has compiled; replaces
    // shaderFolder. Null: the renderer makes its own.
    std::shared_ptr<ChunkPrograms> programs{};
};

class ChunkRenderer {
public:
    // Creates a renderer in the current context. The Error says what the context lacks, or quotes the shader
    // compiler.
    static Result<ChunkRenderer> create(const RendererConfig& config);
    ChunkRenderer(ChunkRenderer&&) noexcept;
    ChunkRenderer& operator=(ChunkRenderer&&) noexcept;
    ~ChunkRenderer();

    // Uploads chunkVertexCount height steps, row by row from the south, into a slot below slotCapacity.
    void upload(std::uint32_t slot, StepsView heights);

    // Takes equirectangular sRGB, 3 bytes per pixel, row 0 at the north, column 0 at longitude -180. Keeps
    // the bound framebuffer and the viewport; leaves depth test, culling, blending and scissor off. On an
    // Error the last image stays.
    Result<void> setColourImage(std::span<const std::uint8_t> rgb, int width, int height);

    // Makes a pool for the planet's own colours, which then replace the image; unset restores the image.
    // Next, call followColours() with all of Planet::takeTileChanges() since reloadTiles() or the planet's
    // opening. On an Error the last pool stays.
    Result<void> setColours(const std::optional<ColourPoolConfig>& config);
    void followColours(std::span<const TileChange> changes);

    // Draws the pool's colours from a clipmap: windows of sizePx texels per side that follow the viewer
    // (planet/surface/colour_clipmap.h). Unset: draws from the tiles and frees the clipmap. Requires a pool;
    // setColours() removes the clipmap. After an Error there is no clipmap.
    Result<void> setColourClipmap(std::optional<int> sizePx);
    // Moves the clipmap to the viewer, fills new and changed texels, and drops levels finer than finestLevel.
    // Call it between followColours() and draw(). Keeps the bound framebuffer and the viewport; leaves depth
    // test, culling, blending and scissor off. On an Error the clipmap is removed.
    Result<void> moveColourClipmap(const glm::dvec3& eyeM, int finestLevel);
    const ColourClipmapState* colourClipmap() const;  // null: none
    // Makes a pool for tiles of normals, which LightDrawing::normals turns on. Next, call followNormals()
    // with all of Planet::takeTileChanges().
    Result<void> setNormals(const std::optional<NormalPoolConfig>& config);
    void followNormals(std::span<const TileChange> changes);

    // Sets the pictures that RenderSettings::layers refers to, all of one size: a power of two, [8, 4096]. On
    // an Error the last ones stay.
    Result<void> setLayers(std::span<const LayerPicture> pictures, int size);

    // Lets draws with ShaderWait::Never compute the tables of the physical atmosphere in the background.
    // Until they are ready, the last tables are used, or at first the analytic atmosphere. Off by default:
    // draws wait.
    void setAirInBackground(bool inBackground);

    // Makes an empty pool of another size. On an Error the old one stays.
    Result<void> setSlotCapacity(std::uint32_t slotCapacity);
    // Adopts the shape of the same planet after its exaggeration has changed.
    void setShape(const PlanetShape& shape);

    // Rereads and recompiles the shaders; on an Error the last valid ones stay.
    Result<void> reloadShaders();

    // Clears the bound framebuffer and fills its lower left view.widthPx x view.heightPx pixels, including
    // the sky. The framebuffer needs a depth buffer, with reversedZ preferably a float one. Leaves depth,
    // culling and clip control as in a new context. Draws the skirts of items whose skirt has a depth. tints:
    // one per item, or none. shadowCasters: chunks that cast shadows but are not drawn (shadow_cascades.h);
    // ignored unless drawsShadows(). ShaderWait::Never: if the programs have a worker, it compiles missing
    // programs in the background. Until they are ready, the most similar programs draw, or nothing is drawn;
    // RenderCounters::standIn reports it.
    void draw(const View& view, std::span<const DrawItem> items, const RenderSettings& settings,
              std::span<const ChunkTint> tints = {}, std::span<const DrawItem> shadowCasters = {},
              ShaderWait wait = ShaderWait::UntilReady);
    bool drawsShadows(const RenderSettings& settings) const;
    bool drawsSeaSurface(const RenderSettings& settings) const;
    // Returns, once each, the reasons why parts were not drawn as set since the last call.
    std::vector<std::string> takeProblems();

    // Returns the last draw's projection, to convert depths into metres.
    const Projection& projection() const;

    // Reads back the vertex positions of the items, with morph and stitched edges, without skirts and the
    // sea's surface: metres from the eye in world axes, chunkVertexCount per item. Waits for the GPU, so it
    // is for tests and measurements. Draws nothing, but OpenGL requires a complete framebuffer to be bound.
    Result<std::vector<glm::vec3>> readVertexPositions(const View& view, std::span<const DrawItem> items,
                                                       const RenderSettings& settings);

    // Captures the ground that the last draw() drew with the same arguments, skirts included. Waits for the GPU, so it is
    // for measurements. Draws nothing, but OpenGL requires a complete framebuffer to be bound.
    Result<CapturedDraw> capture(const View& view, std::span<const DrawItem> items,
                                 const RenderSettings& settings);
    // Draws the same picture as the last draw(), whose arguments the capture must have had, with the captured ground in
    // place of the chunks. The shadow maps stay those of the last draw().
    void draw(const View& view, const CapturedDraw& captured);

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
