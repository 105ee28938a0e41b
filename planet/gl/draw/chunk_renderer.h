// Draws chunks: one static grid, one instanced draw, heights fetched in the vertex shader from one pool.
// OpenGL 3.3 core is enough. Everything here wants a current context, and the same one throughout; one
// thread.
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
#include "planet/sphere/view.h"
#include "planet/surface/atmosphere.h"

namespace planet::gl {

class ChunkPrograms;

// Whether a draw waits for programs that are not ready, or draws with others until they are.
enum class ShaderWait : std::uint8_t { UntilReady, Never };

struct RendererConfig {
    PlanetShape shape;
    std::uint32_t slotCapacity = 0;      // PagingCounters: the capacity of heights
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
    // with all of Planet::takeTileChanges() since beginTilesAnew() or the planet's opening. On an Error
    // what there was stays.
    Result<void> setColours(const std::optional<ColourPoolConfig>& config);
    void followColours(std::span<const TileChange> changes);

    // The same colours from a clipmap instead, filled from the pool: windows of so many texels a side that
    // follow a viewer (planet/surface/colour_clipmap.h). None: from the tiles again, and its memory is free. There
    // have to be colours; setColours ends it. On an Error there is none.
    Result<void> setColourClipmap(std::optional<int> sizePx);
    // Puts it around a viewer and fills what that and the changes since bring in: to be called between
    // followColours and draw. Levels finer than the finest that the view wants are not kept. Keeps what is
    // bound for drawing and the viewport; leaves depth test, culling, blending and scissor off. On an Error
    // there is none any more.
    Result<void> moveColourClipmap(const glm::dvec3& eyeM, int finestLevel);
    const ColourClipmapState* colourClipmap() const;  // null where there is none
    // The same for tiles of normals, which are drawn as LightDrawing::normals says: follow with all of
    // Planet::takeTileChanges().
    Result<void> setNormals(const std::optional<NormalPoolConfig>& config);
    void followNormals(std::span<const TileChange> changes);

    // The pictures that RenderSettings::layers speaks of, all of one size: a power of two, [8, 4096]. On an
    // Error those that there were stay.
    Result<void> setLayers(std::span<const LayerPicture> pictures, int size);

    // Tables of the physical atmosphere where draw() is told ShaderWait::Never: made in the background, for
    // windows, while the last ones or at first the analytic atmosphere are drawn; or, as from the start,
    // waited for.
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
