// Draws a Planet: keeps the pools of heights, colours and normals, the colour clipmap and the shadow casters
// as the planet's paging has them, and draws with a ChunkRenderer. This is the header to embed.
//
//     auto renderer = PlanetRenderer::create(*planet).value();
//     for (;;) {
//         const ViewInput input{view, lodSettings, 1, {.enabled = true}, {.enabled = true}};
//         planet->step(std::span(&input, 1), renderer.upload());
//         renderer.draw(*planet, view, renderSettings);
//     }
//
// All calls need the same current OpenGL context, on the thread that steps the planet. A renderer is for one
// planet.
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
    std::filesystem::path shaderFolder{};       // as RendererConfig has them
    std::shared_ptr<ChunkPrograms> programs{};  // the same
};

// The options of a draw besides its view and its settings.
struct PlanetDrawing {
    std::size_t selection = 0;  // of the last step: the view whose chunks are drawn
    // Chunks to draw instead of that selection; their slots must hold them.
    std::optional<std::span<const DrawItem>> items{};
    std::span<const ChunkTint> tints{};  // one per chunk, or none
    ShaderWait wait = ShaderWait::UntilReady;
};

class PlanetRenderer {
public:
    // The Error says what the context lacks, or what the shader compiler said.
    static Result<PlanetRenderer> create(const Planet& planet, const PlanetRendererConfig& config = {});
    PlanetRenderer(PlanetRenderer&&) noexcept = default;
    PlanetRenderer& operator=(PlanetRenderer&&) noexcept = default;

    // Uploads chunks, for Planet::step and settle. Valid as long as this object stays where it is.
    UploadChunk upload();

    // Fits the pool of heights to the planet's capacity and uploads every chunk again: call it where
    // Planet::setPaging returned true. On an Error the old pool stays: give the planet its old settings back
    // and call this again.
    Result<void> fitHeights(const Planet& planet);
    // Takes over the planet's exaggeration; draw does so too.
    void fitShape(const Planet& planet);

    // Turns off the tiles of a view that the GPU has no memory to draw, so that they are not loaded.
    void limit(ViewInput& view) const;

    // Takes the planet's changes since the last draw, and draws a view of it into the bound framebuffer, as
    // ChunkRenderer::draw does. The settings decide whether colours and normals are drawn; the views of the
    // last step decide which tiles of them are loaded, the whole faces at least.
    void draw(Planet& planet, const View& view, const RenderSettings& settings,
              const PlanetDrawing& drawing = {});

    // Whether there is a pool for colours or normals, so that they are drawn.
    bool drawsTiles(BlockKind kind) const {
        return kind == BlockKind::Colours ? drawsColours_ : drawsNormals_;
    }
    // Returns the reasons why something was not drawn as asked since the last call, each once.
    std::vector<std::string> takeProblems();
    // The reason why the last draw had no clipmap though RenderSettings::clipmapPx asked for one; else empty.
    const std::string& clipmapProblem() const { return clipmapProblem_; }

    // The renderer of chunks, for colour images, layers, counters and measurements.
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
    std::optional<ColourPoolConfig> colourPool_;  // last asked for
    bool drawsColours_ = false;                   // that pool could be made
    std::optional<NormalPoolConfig> normalPool_;  // last asked for
    bool drawsNormals_ = false;                   // that pool could be made
    std::optional<int> clipmapPx_;                // last asked for
    std::string clipmapProblem_;
    std::vector<std::string> problems_;
};

}  // namespace planet::gl
