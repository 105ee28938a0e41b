#include "planet/gl/draw/chunk_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/gpu_timer.h"
#include "planet/gl/device/keep_framebuffers.h"
#include "planet/gl/device/shader_inputs.h"
#include "planet/gl/device/software_renderer.h"
#include "planet/gl/device/vertex_inputs.h"
#include "planet/gl/draw/captured_draw.h"
#include "planet/gl/draw/chunk_grid.h"
#include "planet/gl/draw/chunk_instances.h"
#include "planet/gl/draw/chunk_programs.h"
#include "planet/gl/draw/drawing_state.h"
#include "planet/gl/draw/frame_uniforms.h"
#include "planet/gl/draw/layer_uniforms.h"
#include "planet/gl/draw/sea_uniforms.h"
#include "planet/gl/draw/shadow_uniforms.h"
#include "planet/gl/draw/sky.h"
#include "planet/gl/store/air_textures.h"
#include "planet/gl/store/colour_clipmap.h"
#include "planet/gl/store/colour_image.h"
#include "planet/gl/store/detail_noise.h"
#include "planet/gl/store/height_pool.h"
#include "planet/gl/store/layer_textures.h"
#include "planet/gl/store/shadow_maps.h"
#include "planet/gl/store/tile_pool.h"

namespace planet::gl {

namespace {

constexpr int checkerSize = 64;  // size of the texture layers until pictures are set

Result<void> checkContext() {
    const int version = epoxy_gl_version();
    if (version >= 33) return {};
    return badInput(
        fmt::format("OpenGL {}.{} is too old; expected at least 3.3", version / 10, version % 10));
}

RenderCapabilities findCapabilities() {
    RenderCapabilities capabilities;
    capabilities.reversedZ = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
    GLint samples = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &samples);
    capabilities.samples = std::max(samples, 1);
    capabilities.software = isSoftwareRenderer();
    capabilities.anisotropy = anisotropyToUse();
    return capabilities;
}

bool boundDepthIsFloat() {
    GLint framebuffer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    const GLenum attachment = framebuffer == 0 ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    GLint kind = GL_NONE;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                          GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &kind);
    if (kind == GL_NONE) return false;
    GLint type = GL_NONE;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                          GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
    return type == GL_FLOAT;
}

// Light and air are computed per vertex if cells are small compared with their distance, so that air is
// nearly linear across a cell, and with the planet, so that the sea's glint is.
constexpr double widestSeenForLightByVertex = 0.05;  // of the distance
constexpr double widestForLightByVertex = 0.025;     // of the radius

bool cellsAreSmall(const PlanetShape& shape, const View& view, std::span<const DrawItem> items,
                   double nearestGroundM) {
    for (const DrawItem& item : items) {
        const FaceSquare square = faceSquareOf(item.id);
        const glm::dvec3 cube =
            cubePoint(item.id.face, square.u + square.side / 2, square.v + square.side / 2);
        const double side = 0.75 * square.side;  // of the radius
        const double cell = side / chunkCells(shape);
        const double toMiddleM = glm::length(shape.radiusM * sphereFromCube(cube) - view.eyeM);
        const double distanceM = std::max(toMiddleM - 0.8 * side * shape.radiusM, nearestGroundM);
        if (cell > widestForLightByVertex || cell * shape.radiusM > widestSeenForLightByVertex * distanceM)
            return false;
    }
    return true;
}

// Returns the switches for when chunks start or stop morphing: a flight alternates between the two.
Switches otherSliding(Switches switches) {
    if ((switches & switchMorph) != 0) return switches & ~(switchSlide | switchMorph | switchGather);
    return switches | switchSlide | switchMorph |
           ((switches & switchSlide) != 0 ? switchGather : Switches{0});
}

}  // namespace

// The programs of one picture. A null part is not drawn.
struct DrawnWith {
    const Program* chunk = nullptr;
    const Program* depth = nullptr;
    const Program* sky = nullptr;
    const Program* stars = nullptr;
    bool standIn = false;
};

struct ChunkRenderer::State {
    RendererConfig config;
    RenderCapabilities capabilities;
    RenderCounters counters;
    Projection projection;
    HeightPool pool;
    std::vector<std::int32_t> highestSteps;  // by slot
    std::shared_ptr<ChunkPrograms> programs;
    Program capture;  // made on first use
    Switches captureSwitches = 0;
    int captureReloads = 0;  // ChunkPrograms::reloads() when it was made
    Texture noise;
    VertexArray chunkArray;
    Sky sky;
    Buffer gridVertices, gridIndices, instances, frame, layersFrame, clipmapFrame, seaFrame, shadowsFrame;
    std::size_t gridBytes = 0;
    std::size_t instanceBytes = 0;  // allocated
    ChunkInstances instanceData;
    GLsizei gridIndexCount = 0;
    GLsizei allIndexCount = 0;
    Switches drawnSwitches = 0;  // of the chunks in the last draw
    Switches drawnSkySwitches = 0;
    ColourImage image;
    std::optional<TilePool> colours;
    std::optional<ColourClipmap> clipmap;  // of the pool above
    std::optional<TilePool> normals;
    double normalQuantumM = 1;
    LayerTextures layers;
    AirTextures air;
    bool airInBackground = false;
    std::optional<ShadowMaps> shadows;  // while they are drawn
    int shadowsAskedPx = 0;             // last requested map size; 0: no shadows
    std::vector<std::string> problems;  // not yet reported
    FrameUniforms uniforms{};           // as last uploaded
    GpuTimer chunksTimer{"chunks"}, skyTimer{"sky"}, shadowsTimer{"shadows"};
    std::uint32_t uploads = 0;  // since the last draw

    State(const RendererConfig& from, HeightPool heightPool, LayerTextures checker);
    void makeGrid();
    double highestRadiusM(std::span<const DrawItem> items) const;
    Projection chooseProjection(const View& view, std::span<const DrawItem> items) const;
    Switches chooseSwitches(const View& view, std::span<const DrawItem> items, const RenderSettings& settings,
                            bool tinted, Switches more = 0) const;
    bool wantsPhysicalAir(const RenderSettings& settings) const;
    bool airIsPhysical(const RenderSettings& settings) const;  // also requires that its tables exist
    void fillInstances(std::span<const DrawItem> items, std::span<const ChunkTint> tints, bool stitched,
                       std::span<const DrawItem> shadowCasters = {});
    bool drawsShadows(const RenderSettings& settings) const;
    bool makeShadowMaps(const RenderSettings& settings, std::span<const DrawItem> items);
    void drawShadows(const View& view, std::span<const DrawItem> items, const RenderSettings& settings,
                     const Program& program);
    Switches skySwitches(const RenderSettings& settings) const;
    void addSkyPrograms(Switches skySwitches, DrawnWith& with) const;
    DrawnWith programsFor(Switches switches, Switches skySwitches) const;
    DrawnWith programsAtHand(Switches switches, Switches skySwitches) const;
    void fillFrame(const View& view, const RenderSettings& settings, ShaderWait wait);
    ColoursDrawn coloursDrawn(const RenderSettings& settings) const;
    bool drawsClipmap() const { return clipmap && clipmap->isFilled(); }
    bool drawsNormals(const RenderSettings& settings) const;
    void bindInputs() const;
    void drawChunks(std::span<const DrawItem> items, const RenderSettings& settings, const Program* program);
    void beginPicture(const View& view) const;  // sets the state and clears
    void endPicture() const;
};

ChunkRenderer::State::State(const RendererConfig& from, HeightPool heightPool, LayerTextures checker)
    : config(from),
      capabilities(findCapabilities()),
      pool(std::move(heightPool)),
      highestSteps(from.slotCapacity, std::numeric_limits<std::int32_t>::min()),
      programs(from.programs),
      noise(detailNoiseTexture()),
      chunkArray(makeVertexArray()),
      gridVertices(makeBuffer()),
      gridIndices(makeBuffer()),
      instances(makeBuffer()),
      frame(makeBuffer()),
      layersFrame(makeBuffer()),
      clipmapFrame(makeBuffer()),
      seaFrame(makeBuffer()),
      shadowsFrame(makeBuffer()),
      layers(std::move(checker)) {
    fillUniforms(frame, uniforms);
    makeGrid();
}

void ChunkRenderer::State::makeGrid() {
    const ChunkGrid grid = chunkGrid(chunkCells(config.shape));
    gridIndexCount = static_cast<GLsizei>(grid.gridIndexCount);
    allIndexCount = static_cast<GLsizei>(grid.indices.size());
    const std::size_t vertexBytes = grid.vertices.size() * sizeof(GridVertex);
    const std::size_t indexBytes = grid.indices.size() * sizeof(std::uint16_t);
    gridBytes = vertexBytes + indexBytes;

    glBindVertexArray(chunkArray.name());
    glBindBuffer(GL_ARRAY_BUFFER, gridVertices.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertexBytes), grid.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gridIndices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indexBytes), grid.indices.data(),
                 GL_STATIC_DRAW);
    describeChunkVertices(gridVertices, instances);
    glBindVertexArray(0);
}

// Returns the distance of the highest drawn ground from the planet's centre, metres.
double ChunkRenderer::State::highestRadiusM(std::span<const DrawItem> items) const {
    std::int32_t highest = std::numeric_limits<std::int32_t>::min();
    for (const DrawItem& item : items) highest = std::max(highest, highestSteps[item.slot]);
    return config.shape.radiusM + heightM(config.shape, highest);
}

Projection ChunkRenderer::State::chooseProjection(const View& view, std::span<const DrawItem> items) const {
    const double scale = std::min(config.shape.radiusM / 6.371e6, 1.0);
    if (capabilities.reversedZ && boundDepthIsFloat()) return reversedProjection(view, 0.1 * scale);
    return fallbackProjection(view, config.shape.radiusM, highestRadiusM(items));
}

Switches ChunkRenderer::State::chooseSwitches(const View& view, std::span<const DrawItem> items,
                                              const RenderSettings& settings, bool tinted,
                                              Switches more) const {
    const double aboveM = glm::length(view.eyeM) - highestRadiusM(items);
    const double nearestGroundM = std::max(aboveM, 1e-6 * config.shape.radiusM);
    const Switches switches = more | switchesFor(config.shape, view, settings, coloursDrawn(settings), tinted,
                                                 nearestGroundM, capabilities.software);
    const Switches layersSeen =
        settings.cube ? 0 : layerSwitches(settings.layers, capabilities.software, nearestGroundM);
    constexpr Switches seenByPixel = switchDetail | switchSeaSurface | switchShadows;
    const bool byVertex = (switches & switchLighting) != 0 && (switches & seenByPixel) == 0 &&
                          (layersSeen & switchLayers) == 0 && !drawsNormals(settings) &&
                          cellsAreSmall(config.shape, view, items, nearestGroundM);
    const bool physicalAir = (switches & switchAir) != 0 && airIsPhysical(settings);
    return switches | layersSeen | (physicalAir ? switchPhysicalAir : Switches{0}) |
           (byVertex ? switchLightByVertex : Switches{0}) |
           (boundSamples() > 1 ? switchMultisampled : Switches{0}) |
           (capabilities.anisotropy > 1 ? switchAnisotropy : Switches{0}) |
           (drawsNormals(settings) ? switchNormalTiles : Switches{0}) |
           slidingSwitches(items, settings.stitched);
}

bool ChunkRenderer::State::wantsPhysicalAir(const RenderSettings& settings) const {
    return settings.atmosphere && !settings.cube && isUsed(settings.light.air.use, capabilities.software);
}

bool ChunkRenderer::State::airIsPhysical(const RenderSettings& settings) const {
    return wantsPhysicalAir(settings) && air.exist();
}

void ChunkRenderer::State::fillInstances(std::span<const DrawItem> items, std::span<const ChunkTint> tints,
                                         bool stitched, std::span<const DrawItem> shadowCasters) {
    assert(std::all_of(items.begin(), items.end(),
                       [&](const DrawItem& item) { return item.slot < pool.slotCapacity(); }));
    instanceData.fill(pool.layout(), items, tints, stitched, shadowCasters);
    const std::span<const ChunkInstance> filled = instanceData.all();
    // A new store each frame, because the GPU may still read the last one.
    const std::size_t needed = filled.size_bytes();
    while (instanceBytes < needed) instanceBytes = std::max<std::size_t>(2 * instanceBytes, 4096);
    glBindBuffer(GL_ARRAY_BUFFER, instances.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instanceBytes), nullptr, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(needed), filled.data());
}

void ChunkRenderer::State::fillFrame(const View& view, const RenderSettings& settings, ShaderWait wait) {
    uniforms = frameUniforms(config.shape, view, projection, settings, coloursDrawn(settings));
    if (normals) {
        planet::gl::setNormals(config.shape,
                               {normals->leafLevel(), static_cast<double>(normals->anisotropy()),
                                settings.light.normals.texelsPerPixel, normalQuantumM},
                               uniforms);
    }
    fillUniforms(frame, uniforms);
    fillUniforms(layersFrame, layersUniforms(settings.layers, view, static_cast<double>(uniforms.reliefBoost),
                                             settings.exaggeration, layers.means()));
    fillUniforms(seaFrame, seaUniforms(settings.light.sea, view, settings.exaggeration));
    if (!wantsPhysicalAir(settings)) return;
    const bool inBackground = airInBackground && wait == ShaderWait::Never;
    if (const Result<void> followed = air.follow(settings.light.air.settings, inBackground); !followed)
        problems.push_back(fmt::format("Physical atmosphere unavailable, using the analytic model: {}",
                                       followed.error().message));
    if (!airIsPhysical(settings)) return;
    air.bind(settings.light.air, view.eyeM, config.shape.radiusM, glm::normalize(settings.sunDirection));
}

ColoursDrawn ChunkRenderer::State::coloursDrawn(const RenderSettings& settings) const {
    if (!colours || !settings.streamed) return {.faceSizePx = image.faceSizePx()};
    return {(tileCells << colours->leafLevel()) + 1,
            true,
            colours->leafLevel(),
            colours->anisotropy(),
            settings.texelsPerPixel,
            drawsClipmap(),
            colours->hasMipmapsInTiles()};
}

bool ChunkRenderer::State::drawsNormals(const RenderSettings& settings) const {
    const bool seen = settings.lighting || isUsed(settings.layers.use, capabilities.software);
    return normals && seen && isUsed(settings.light.normals.use, capabilities.software);
}

void ChunkRenderer::State::bindInputs() const {
    bindUniforms(UniformBlock::Frame, frame);
    bindUniforms(UniformBlock::Layers, layersFrame);
    bindUniforms(UniformBlock::Sea, seaFrame);
    bindTexture(Sampler::heightPool, GL_TEXTURE_2D_ARRAY, pool.texture());
    bindTexture(Sampler::detailNoise, GL_TEXTURE_3D, noise.name());
    bindTexture(Sampler::layerAlbedo, GL_TEXTURE_2D_ARRAY, layers.albedo());
    bindTexture(Sampler::layerSurface, GL_TEXTURE_2D_ARRAY, layers.surface());
    bindTexture(Sampler::colourImage, GL_TEXTURE_2D_ARRAY, image.texture());
    if (shadows) {
        bindUniforms(UniformBlock::Shadows, shadowsFrame);
        bindTexture(Sampler::shadowMaps, GL_TEXTURE_2D_ARRAY, shadows->texture());
    }
    if (colours) {
        bindTexture(Sampler::colourTiles, GL_TEXTURE_2D_ARRAY, colours->tiles());
        bindTexture(Sampler::colourPages, GL_TEXTURE_2D_ARRAY, colours->pages());
        bindTexture(Sampler::colourRoots, GL_TEXTURE_2D_ARRAY, colours->roots());
    }
    if (drawsClipmap()) {
        bindUniforms(UniformBlock::Clipmap, clipmapFrame);
        bindTexture(Sampler::clipmapStack, GL_TEXTURE_2D_ARRAY, clipmap->stack());
        bindTexture(Sampler::clipmapBase, GL_TEXTURE_2D_ARRAY, clipmap->base());
    }
    if (normals) {
        bindTexture(Sampler::normalTiles, GL_TEXTURE_2D_ARRAY, normals->tiles());
        bindTexture(Sampler::normalPages, GL_TEXTURE_2D_ARRAY, normals->pages());
        bindTexture(Sampler::normalRoots, GL_TEXTURE_2D_ARRAY, normals->roots());
    }
}

bool ChunkRenderer::State::drawsShadows(const RenderSettings& settings) const {
    return settings.lighting && !settings.cube && isUsed(settings.light.shadows.use, capabilities.software);
}

// Creates the shadow maps if shadows are on and ground is in range; frees them if shadows are off. Returns
// whether shadows can be drawn.
bool ChunkRenderer::State::makeShadowMaps(const RenderSettings& settings, std::span<const DrawItem> items) {
    const ShadowDrawing& wanted = settings.light.shadows;
    if (!drawsShadows(settings)) {
        shadows.reset();
        shadowsAskedPx = 0;
        return false;
    }
    const auto isNear = [&](const DrawItem& item) {
        return static_cast<double>(item.distanceM) < wanted.reachM;
    };
    if (!std::any_of(items.begin(), items.end(), isNear)) return false;
    // Failed maps are not retried each frame.
    if (shadowsAskedPx != wanted.mapSizePx) {
        shadows.reset();
        shadowsAskedPx = wanted.mapSizePx;
        if (Result<ShadowMaps> made = ShadowMaps::create(wanted.mapSizePx))
            shadows = std::move(*made);
        else
            problems.push_back(fmt::format("Shadows disabled: {}", made.error().message));
    }
    return shadows.has_value();
}

// Draws the ground as seen from the sun, once per cascade.
void ChunkRenderer::State::drawShadows(const View& view, std::span<const DrawItem> items,
                                       const RenderSettings& settings, const Program& program) {
    double nearestM = settings.light.shadows.reachM;
    for (const DrawItem& item : items) nearestM = std::min(nearestM, static_cast<double>(item.distanceM));
    const double least = 1e-6 * config.shape.radiusM;
    const ShadowCascades cascades =
        shadowCascades(view, settings.sunDirection, std::max(nearestM, least),
                       std::max(settings.light.shadows.reachM, 4 * least), shadows->sizePx());
    fillUniforms(shadowsFrame, shadowUniforms(cascades, settings.light.shadows.softness, shadows->sizePx()));
    const KeepFramebuffers keep;
    glUseProgram(program.name());
    glBindVertexArray(chunkArray.name());
    for (std::size_t i = 0; i < shadowCascadeCount; ++i) {
        FrameUniforms fromSun = uniforms;
        fromSun.clipFromWorld = cascades[i].clipFromEye;
        fillUniforms(frame, fromSun);
        shadows->begin(i);
        if (program.name() != 0)
            glDrawElementsInstanced(GL_TRIANGLES, gridIndexCount, GL_UNSIGNED_SHORT, nullptr,
                                    static_cast<GLsizei>(instanceData.all().size()));
    }
    ShadowMaps::end();
    fillUniforms(frame, uniforms);
}

void ChunkRenderer::State::drawChunks(std::span<const DrawItem> items, const RenderSettings& settings,
                                      const Program* program) {
    const bool skirts =
        std::any_of(items.begin(), items.end(), [](const DrawItem& item) { return item.skirtDepthM > 0; });
    const GLsizei first = settings.skirtPaint == SkirtPaint::LoudAlone ? gridIndexCount : 0;
    const GLsizei indexCount = (skirts ? allIndexCount : gridIndexCount) - first;
    const auto chunks = static_cast<GLsizei>(items.size());
    glEnable(GL_CULL_FACE);
    glUseProgram(program ? program->name() : 0);
    glBindVertexArray(chunkArray.name());
    if (chunks > 0 && indexCount > 0) {
        const auto offset = static_cast<std::size_t>(first) * sizeof(std::uint16_t);
        glDrawElementsInstanced(GL_TRIANGLES, indexCount, GL_UNSIGNED_SHORT,
                                reinterpret_cast<const void*>(offset), chunks);
    }
    glDisable(GL_CULL_FACE);
    counters.chunks = static_cast<std::uint32_t>(chunks);
    const auto ground = static_cast<std::uint64_t>((gridIndexCount - first) / 3);
    counters.groundTriangles = ground * items.size();
    counters.skirtTriangles = (static_cast<std::uint64_t>(indexCount / 3) - ground) * items.size();
}

void ChunkRenderer::State::beginPicture(const View& view) const {
    glViewport(0, 0, view.widthPx, view.heightPx);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);  // the shaders encode
    glClearColor(0, 0, 0, 1);
    beginDepthTest(projection.reversedZ);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void ChunkRenderer::State::endPicture() const {
    endDepthTest(projection.reversedZ);
    glBindVertexArray(0);
    glUseProgram(0);
}

Result<ChunkRenderer> ChunkRenderer::create(const RendererConfig& config) {
    if (const Result<void> usable = checkContext(); !usable) return tl::unexpected(usable.error());
    Result<HeightPool> pool = HeightPool::create(config.slotCapacity, config.shape);
    if (!pool) return tl::unexpected(pool.error());
    RendererConfig own = config;
    if (!own.programs) {
        Result<ChunkPrograms> programs = ChunkPrograms::build(config.shaderFolder);
        if (!programs) return tl::unexpected(programs.error());
        own.programs = std::make_shared<ChunkPrograms>(std::move(*programs));
    }
    Result<LayerTextures> checker = LayerTextures::create({}, checkerSize);
    if (!checker) return tl::unexpected(checker.error());
    std::unique_ptr<State> state;
    const bool made =
        hasRoomFor([&] { state = std::make_unique<State>(own, std::move(*pool), std::move(*checker)); });
    if (!made) return badInput("GPU out of memory: buffers for drawing chunks");
    return ChunkRenderer(std::move(state));
}

ChunkRenderer::ChunkRenderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
ChunkRenderer::ChunkRenderer(ChunkRenderer&&) noexcept = default;
ChunkRenderer& ChunkRenderer::operator=(ChunkRenderer&&) noexcept = default;
ChunkRenderer::~ChunkRenderer() = default;

void ChunkRenderer::upload(std::uint32_t slot, StepsView heights) {
    state_->pool.upload(slot, heights);
    state_->highestSteps[slot] = lowestAndHighest(heights).second;
    ++state_->uploads;
}

Result<void> ChunkRenderer::setSlotCapacity(std::uint32_t slotCapacity) {
    Result<HeightPool> pool = HeightPool::create(slotCapacity, state_->config.shape);
    if (!pool) return tl::unexpected(pool.error());
    state_->pool = std::move(*pool);
    state_->config.slotCapacity = slotCapacity;
    state_->highestSteps.assign(slotCapacity, std::numeric_limits<std::int32_t>::min());
    return {};
}

void ChunkRenderer::setShape(const PlanetShape& shape) {
    assert(shape.chunkCellsLog2 == state_->config.shape.chunkCellsLog2);
    state_->config.shape = shape;
}

Result<void> ChunkRenderer::setColourImage(std::span<const std::uint8_t> rgb, int width, int height) {
    return ColourImage::create(rgb, width, height, state_->programs->faceImage().name())
        .map([this](ColourImage image) { state_->image = std::move(image); });
}

Result<void> ChunkRenderer::setColours(const std::optional<ColourPoolConfig>& config) {
    if (!config) {
        state_->clipmap.reset();
        state_->colours.reset();
        return {};
    }
    return TilePool::create(*config).map([this](TilePool pool) {
        state_->clipmap.reset();
        state_->colours = std::move(pool);
    });
}

void ChunkRenderer::followColours(std::span<const TileChange> changes) {
    assert(state_->colours || changes.empty());
    if (state_->colours) state_->colours->follow(changes);
    if (state_->clipmap) state_->clipmap->follow(changes);
}

Result<void> ChunkRenderer::setColourClipmap(std::optional<int> sizePx) {
    assert(state_->colours || !sizePx);
    state_->clipmap.reset();
    if (!sizePx) return {};
    return ColourClipmap::create(*sizePx, *state_->colours).map([this](ColourClipmap clipmap) {
        state_->clipmap = std::move(clipmap);
    });
}

Result<void> ChunkRenderer::moveColourClipmap(const glm::dvec3& eyeM, int finestLevel) {
    State& state = *state_;
    assert(state.clipmap);
    Result<void> moved =
        state.clipmap->move(eyeM, finestLevel, *state.colours, state.programs->clipmapFill().name());
    if (!moved) {
        state.clipmap.reset();
        return moved;
    }
    fillUniforms(state.clipmapFrame, state.clipmap->uniforms());
    return {};
}

const ColourClipmapState* ChunkRenderer::colourClipmap() const {
    return state_->clipmap ? &state_->clipmap->state() : nullptr;
}

Result<void> ChunkRenderer::setNormals(const std::optional<NormalPoolConfig>& config) {
    if (!config) {
        state_->normals.reset();
        return {};
    }
    state_->normalQuantumM = config->quantumM;
    return TilePool::create(*config).map([this](TilePool pool) { state_->normals = std::move(pool); });
}

void ChunkRenderer::followNormals(std::span<const TileChange> changes) {
    assert(state_->normals || changes.empty());
    if (state_->normals) state_->normals->follow(changes);
}

Result<void> ChunkRenderer::setLayers(std::span<const LayerPicture> pictures, int size) {
    return LayerTextures::create(pictures, size).map([this](LayerTextures layers) {
        state_->layers = std::move(layers);
    });
}

void ChunkRenderer::setAirInBackground(bool inBackground) {
    state_->airInBackground = inBackground;
}

Result<void> ChunkRenderer::reloadShaders() {
    return state_->programs->reload();
}

// The sky has an atmosphere without lighting too.
Switches ChunkRenderer::State::skySwitches(const RenderSettings& settings) const {
    return (settings.atmosphere && !settings.cube ? switchAir : Switches{0}) |
           (airIsPhysical(settings) ? switchPhysicalAir : Switches{0});
}

void ChunkRenderer::State::addSkyPrograms(Switches skySwitches, DrawnWith& with) const {
    if ((skySwitches & switchAir) != 0) with.sky = &programs->program(skyKey(skySwitches));
    with.stars = &programs->program(starsKey(skySwitches));
}

DrawnWith ChunkRenderer::State::programsFor(Switches switches, Switches skySwitches) const {
    DrawnWith with;
    with.chunk = &programs->program({ProgramUse::Chunk, switches});
    if ((switches & switchShadows) != 0) with.depth = &programs->program(depthKey(switches));
    addSkyPrograms(skySwitches, with);
    return with;
}

// Returns the ready programs. For the others, returns the most similar ready ones and orders the missing
// ones.
DrawnWith ChunkRenderer::State::programsAtHand(Switches switches, Switches skySwitches) const {
    programs->takeOrdered();
    const bool shadowed = (switches & switchShadows) != 0;
    const bool airInSky = (skySwitches & switchAir) != 0;
    std::vector<ProgramKey> wanted = {{ProgramUse::Chunk, switches}, starsKey(skySwitches)};
    if (airInSky) wanted.push_back(skyKey(skySwitches));
    if (shadowed) wanted.push_back(depthKey(switches));
    std::vector<ProgramKey> next = {{ProgramUse::Chunk, otherSliding(switches)}};
    if (shadowed) next.push_back(depthKey(otherSliding(switches)));
    std::optional<DrawingState> state;
    const auto order = [&](const std::vector<ProgramKey>& keys, Urgency urgency) {
        for (const ProgramKey& key : keys) {
            if (programs->ready(key) || programs->isOrdered(key)) continue;
            if (!state) state = currentDrawingState(projection.reversedZ);
            programs->order(key, *state, urgency);
        }
    };
    order(wanted, Urgency::Now);
    DrawnWith with{programs->ready(wanted[0]), shadowed ? programs->ready(depthKey(switches)) : nullptr,
                   airInSky ? programs->ready(skyKey(skySwitches)) : nullptr,
                   programs->ready(starsKey(skySwitches)), false};
    if (with.chunk && with.stars && (with.sky || !airInSky) && (with.depth || !shadowed)) {
        order(next, Urgency::Later);
        return with;
    }
    with.standIn = true;
    const bool withoutShadows = shadowed && !with.depth;
    if (!with.chunk || withoutShadows)
        with.chunk = programs->nearest(withoutShadows ? switches & ~switchShadows : switches);
    const Switches analytic = skySwitches & ~switchPhysicalAir;
    if (!with.sky && airInSky) with.sky = programs->ready(skyKey(analytic));
    if (!with.stars) with.stars = programs->ready(starsKey(analytic));
    return with;
}

void ChunkRenderer::draw(const View& view, std::span<const DrawItem> items, const RenderSettings& settings,
                         std::span<const ChunkTint> tints, std::span<const DrawItem> shadowCasters,
                         ShaderWait wait) {
    State& state = *state_;
    state.projection = state.chooseProjection(view, items);
    const bool shadowed = state.makeShadowMaps(settings, items);
    if (!shadowed) shadowCasters = {};
    state.fillInstances(items, tints, settings.stitched, shadowCasters);
    state.fillFrame(view, settings, wait);
    state.bindInputs();
    const Switches switches =
        state.chooseSwitches(view, items, settings, !tints.empty(), shadowed ? switchShadows : Switches{0});
    const Switches skySwitches = state.skySwitches(settings);
    const std::uint32_t drawnBefore = state.programs->firstDraws();
    const bool mayStandIn = wait == ShaderWait::Never && state.programs->canOrder();
    const DrawnWith with =
        mayStandIn ? state.programsAtHand(switches, skySwitches) : state.programsFor(switches, skySwitches);
    state.drawnSwitches = switches;
    state.drawnSkySwitches = skySwitches;
    state.shadowsTimer.begin();
    if (with.depth) state.drawShadows(view, items, settings, *with.depth);
    state.shadowsTimer.end();

    state.chunksTimer.begin();
    state.beginPicture(view);
    state.drawChunks(with.chunk ? items : std::span<const DrawItem>(), settings, with.chunk);
    state.chunksTimer.end();
    state.skyTimer.begin();
    state.sky.draw(view, with.sky, with.stars);
    state.skyTimer.end();
    state.endPicture();

    state.counters.chunksMs = state.chunksTimer.lastMs();
    state.counters.skyMs = state.skyTimer.lastMs();
    state.counters.shadowsMs = shadowed ? state.shadowsTimer.lastMs() : 0;
    state.counters.newPrograms = state.programs->firstDraws() - drawnBefore;
    state.counters.uploads = std::exchange(state.uploads, 0);
    state.counters.standIn = with.standIn || (state.wantsPhysicalAir(settings) &&
                                              !state.airIsPhysical(settings) && state.air.figures().working);
}

Result<std::vector<glm::vec3>> ChunkRenderer::readVertexPositions(const View& view,
                                                                  std::span<const DrawItem> items,
                                                                  const RenderSettings& settings) {
    State& state = *state_;
    const Switches switches = state.chooseSwitches(view, items, settings, false) & ~switchSeaSurface;
    if (state.capture.name() == 0 || state.captureSwitches != switches ||
        state.captureReloads != state.programs->reloads()) {
        const std::array<const char*, 1> captured = {"surface"};
        Result<Program> program = state.programs->capturing(switches, captured);
        if (!program) return tl::unexpected(program.error());
        state.capture = std::move(*program);
        state.captureSwitches = switches;
        state.captureReloads = state.programs->reloads();
    }
    state.fillInstances(items, {}, settings.stitched);
    state.fillFrame(view, settings, ShaderWait::UntilReady);
    state.bindInputs();

    const int perChunk = chunkVertexCount(state.config.shape);
    std::vector<glm::vec3> surface(items.size() * static_cast<std::size_t>(perChunk));
    const auto bytes = static_cast<GLsizeiptr>(surface.size() * sizeof(glm::vec3));
    const Buffer out = makeBuffer();
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, out.name());
    if (!hasRoomFor([&] { glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STREAM_READ); })) {
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
        return badInput(fmt::format("GPU out of memory: vertices of {} chunks", items.size()));
    }
    glUseProgram(state.capture.name());
    glBindVertexArray(state.chunkArray.name());
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArraysInstanced(GL_POINTS, 0, perChunk, static_cast<GLsizei>(items.size()));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindVertexArray(0);
    glUseProgram(0);
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, surface.data());
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    return surface;
}

Result<CapturedDraw> ChunkRenderer::capture(const View& view, std::span<const DrawItem> items,
                                            const RenderSettings& settings) {
    State& state = *state_;
    std::vector<const char*> names;
    std::vector<VertexInput> inputs;
    std::size_t vertexBytes = 0;
    const std::vector<VertexOutput> outputs = state.programs->chunkOutputs();
    for (const VertexOutput& output : outputs) {
        names.push_back(output.name.c_str());
        inputs.push_back(
            {.name = output.name.c_str(), .components = output.components, .offset = vertexBytes});
        vertexBytes += static_cast<std::size_t>(output.components) * sizeof(float);
    }
    Result<Program> capturing = state.programs->capturing(state.drawnSwitches, names);
    if (!capturing) return tl::unexpected(capturing.error());
    Result<Program> program = state.programs->passingOn(state.drawnSwitches);
    if (!program) return tl::unexpected(program.error());

    const ChunkGrid grid = chunkGrid(chunkCells(state.config.shape));
    const auto perChunk = static_cast<GLsizei>(grid.vertices.size());
    const auto chunks = static_cast<GLsizei>(items.size());
    const bool skirts =
        std::any_of(items.begin(), items.end(), [](const DrawItem& item) { return item.skirtDepthM > 0; });
    std::vector<std::uint32_t> indices;
    for (GLsizei chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t count = skirts ? grid.indices.size() : grid.gridIndexCount;
        for (std::size_t i = 0; i < count; ++i)
            indices.push_back(static_cast<std::uint32_t>(chunk * perChunk) + grid.indices[i]);
    }
    CapturedDraw captured{std::move(*program), makeVertexArray(), makeBuffer(), makeBuffer(),
                          static_cast<GLsizei>(indices.size())};
    glBindVertexArray(captured.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, captured.vertices.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, captured.indices.name());
    const bool hasRoom = hasRoomFor([&] {
        glBufferData(GL_ARRAY_BUFFER,
                     static_cast<GLsizeiptr>(items.size() * grid.vertices.size() * vertexBytes), nullptr,
                     GL_STATIC_DRAW);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                     indices.data(), GL_STATIC_DRAW);
    });
    if (!hasRoom) {
        glBindVertexArray(0);
        return badInput(fmt::format("GPU out of memory: the captured vertices of {} chunks", items.size()));
    }
    describeInputs(inputs, 0, static_cast<GLsizei>(vertexBytes), 0);

    state.fillInstances(items, {}, settings.stitched);
    state.fillFrame(view, settings, ShaderWait::UntilReady);
    state.bindInputs();
    glUseProgram(capturing->name());
    glBindVertexArray(state.chunkArray.name());
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, captured.vertices.name());
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArraysInstanced(GL_POINTS, 0, perChunk, chunks);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    return captured;
}

void ChunkRenderer::draw(const View& view, const CapturedDraw& captured) {
    const State& state = *state_;
    state.bindInputs();
    state.beginPicture(view);
    glEnable(GL_CULL_FACE);
    glUseProgram(captured.program.name());
    glBindVertexArray(captured.array.name());
    glDrawElements(GL_TRIANGLES, captured.indexCount, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_CULL_FACE);
    DrawnWith with;
    state.addSkyPrograms(state.drawnSkySwitches, with);
    state.sky.draw(view, with.sky, with.stars);
    state.endPicture();
}

bool ChunkRenderer::drawsShadows(const RenderSettings& settings) const {
    return state_->drawsShadows(settings);
}

bool ChunkRenderer::drawsSeaSurface(const RenderSettings& settings) const {
    return isSeaSurfaceDrawn(settings, state_->capabilities.software);
}

std::vector<std::string> ChunkRenderer::takeProblems() {
    return std::exchange(state_->problems, {});
}

const Projection& ChunkRenderer::projection() const {
    return state_->projection;
}

const RenderCounters& ChunkRenderer::counters() const {
    return state_->counters;
}

const RenderCapabilities& ChunkRenderer::capabilities() const {
    return state_->capabilities;
}

const AirFigures& ChunkRenderer::airFigures() const {
    return state_->air.figures();
}

GpuMemory ChunkRenderer::gpuMemory() const {
    const std::size_t colourTiles = state_->colours ? state_->colours->bytes() : 0;
    const std::size_t colourClipmap = state_->clipmap ? state_->clipmap->state().bytes() : 0;
    return {state_->pool.layout().bytes(),
            state_->gridBytes + state_->instanceBytes + state_->sky.bytes() + sizeof(FrameUniforms) +
                sizeof(LayersUniforms) + sizeof(SeaUniforms) +
                (state_->clipmap ? sizeof(ClipmapUniforms) : 0),
            state_->image.bytes() + detailNoiseBytes + state_->layers.bytes() +
                (state_->normals ? state_->normals->bytes() : 0) + state_->air.figures().tableBytes +
                colourTiles + colourClipmap,
            colourTiles,
            colourClipmap,
            state_->shadows ? state_->shadows->bytes() : 0};
}

}  // namespace planet::gl
