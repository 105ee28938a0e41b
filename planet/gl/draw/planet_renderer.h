// Draws a Planet. Keeps the pools of heights, colours and normals, the colour clipmap and the shadow casters
// in step with the planet's paging, and draws with a ChunkRenderer. Embedding programs include this header.
//
//     auto renderer = PlanetRenderer::create(*planet).value();
//     for (;;) {
//         const ViewInput input{view, lodSettings, 1, {.enabled = true}, {.enabled = true}};
//         planet->step(std::span(&input, 1), renderer.upload());
//         renderer.draw(*planet, view, renderSettings);
//     }
//
// All calls require the same current OpenGL context, on the thread that steps the planet. A renderer serves
// one planet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/draw/chunk_renderer.h"
#include "planet/planet.h"

namespace planet::gl {

struct PlanetRendererConfig {
    std::filesystem::path shaderFolder{};       // as in RendererConfig
    std::shared_ptr<ChunkPrograms> programs{};  // as in RendererConfig
};

// The options of a draw besides its view and settings.
struct PlanetDrawing {
    std::size_t selection = 0;  // index of a view in the last step, whose chunks are drawn
    // Replaces that selection; the slots must hold these chunks.
    std::optional<std::span<const DrawItem>> items{};
    std::span<const ChunkTint> tints{};  // one per chunk, or none
    ShaderWait wait = ShaderWait::UntilReady;
};

class PlanetRenderer {
public:
    // Creates a renderer in the current context. The Error says what the context lacks, or quotes the shader
    // compiler.
    static Result<PlanetRenderer> create(const Planet& planet, const PlanetRendererConfig& config = {});
    PlanetRenderer(PlanetRenderer&&) noexcept = default;
    PlanetRenderer& operator=(PlanetRenderer&&) noexcept = default;

    // Returns the upload function for Planet::step and settle. This object must not move while it is in use.
    UploadChunk upload();

    // Resizes the pool of heights to the planet's capacity and uploads every chunk again. Call it when
    // Planet::setPaging has returned true. On an Error the old pool stays: restore the planet's old settings
    // and call this again.
    Result<void> fitHeights(const Planet& planet);
    // Adopts the planet's exaggeration; draw() does so too.
    void fitShape(const Planet& planet);

    // Turns off the tiles of a view for which the GPU is out of memory, so that they are not loaded.
    void limit(ViewInput& view) const;

    // Applies the planet's changes since the last draw, and draws a view of it into the bound framebuffer, as
    // ChunkRenderer::draw does. The settings decide whether colours and normals are drawn. The views of the
    // last step decide which of their tiles are loaded; the whole faces always are.
    void draw(Planet& planet, const View& view, const RenderSettings& settings,
              const PlanetDrawing& drawing = {});

    // Returns whether the last drawing could not make the pool for the planet's own colours.
    bool lacksColourPool() const { return colourPool_ && !drawsColours_; }

    // Returns whether there is a pool for colours or normals, so that they are drawn.
    bool drawsTiles(BlockKind kind) const {
        return kind == BlockKind::Colours ? drawsColours_ : drawsNormals_;
    }
    // Returns, once each, the reasons why parts were not drawn as set since the last call.
    std::vector<std::string> takeProblems();
    // Returns why the last draw had no clipmap although RenderSettings::clipmapPx requested one; else empty.
    const std::string& clipmapProblem() const { return clipmapProblem_; }

    // Returns the renderer of chunks, for colour images, layers, counters and measurements.
    ChunkRenderer& chunks() { return chunks_; }
    const ChunkRenderer& chunks() const { return chunks_; }

private:
    PlanetRenderer(ChunkRenderer&& chunks, const Planet& planet);
    void followColours(Planet& planet);
    void followNormals(Planet& planet);
    void followClipmap(const Planet& planet, const RenderSettings& settings);
    std::vector<DrawItem> shadowCasters(const Planet& planet, const RenderSettings& settings,
                                        std::span<const DrawItem> items) const;

    ChunkRenderer chunks_;
    std::uint32_t heightSlots_ = 0;               // of the pool
    double exaggeration_ = 1;                     // of the shape that is drawn
    std::optional<ColourPoolConfig> colourPool_;  // last requested
    bool drawsColours_ = false;                   // the requested pool exists
    std::optional<NormalPoolConfig> normalPool_;  // last requested
    bool drawsNormals_ = false;                   // the requested pool exists
    std::optional<int> clipmapPx_;                // last requested
    std::string clipmapProblem_;
    std::vector<std::string> problems_;
};

}  // namespace planet::gl
