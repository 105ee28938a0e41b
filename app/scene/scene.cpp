#include "app/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/scene/overlay_lines.h"
#include "app/settings/layer_file.h"
#include "app/settings/sun_overhead.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

// Low enough in the east for relief to show, high enough for most of what is in view to be lit.
glm::dvec3 morningSun(const glm::dvec3& eyeM) {
    const planet::Geographic place = planet::geographicFromDirection(eyeM);
    const glm::dvec3 up = glm::normalize(eyeM);
    const glm::dvec3 east(-std::sin(place.longitudeRad), std::cos(place.longitudeRad), 0);
    return 0.65 * up + 0.65 * east + 0.4 * glm::cross(up, east);
}

// The ramp's colours spread over the planet's own heights, whatever they are. Exaggeration is in the shape.
double rampTopM(const planet::ChunkTree& tree) {
    const double highestM = planet::heightM(tree.shape, tree.maxStep);
    const double lowestM = planet::heightM(tree.shape, tree.minStep);
    return std::max({0.85 * highestM, 0.3 * (highestM - lowestM), 1.0});
}

// The renderer's pool follows the planet's slots. Where it cannot, the planet goes back to the slots it had.
planet::Result<void> fitPool(Scene& scene, const planet::PagingSettings& before) {
    planet::Result<void> fitted = scene.renderer.fitHeights(*scene.planet);
    if (!fitted) {
        static_cast<void>(scene.planet->setPaging(before));
        static_cast<void>(scene.renderer.fitHeights(*scene.planet));  // the pool has that size
    }
    return fitted;
}

bool drawsByCpu(const Scene& scene) {
    return scene.renderer.chunks().capabilities().software;
}

planet::Result<void> applyPaging(Scene& scene, const planet::PagingSettings& wanted) {
    const planet::PagingSettings before = scene.planet->pagingSettings();
    if (wanted == before) {
        scene.refusedPaging.reset();
        return {};
    }
    if (scene.refusedPaging == wanted) return {};
    const planet::Result<bool> moved = scene.planet->setPaging(wanted);
    planet::Result<void> applied;
    if (!moved)
        applied = tl::unexpected(moved.error());
    else if (*moved)
        applied = fitPool(scene, before);
    scene.refusedPaging = applied ? std::nullopt : std::optional(wanted);
    return applied;
}

planet::gl::LayerDrawing layerDrawingOf(const LayerSettings& layers) {
    return {.use = layers.use,
            .set = layers.set,
            .pictures = {},
            .beginM = layers.beginM,
            .endM = layers.endM,
            .opacity = layers.opacity,
            .colourBelow = layers.colourBelow,
            .preview = layers.preview,
            .previewed = layers.previewed - 1};
}

// Only where layers are drawn: most of the time it is nothing to do.
void fitLayers(Scene& scene, const LayerSettings& layers, planet::gl::LayerDrawing& drawing) {
    const bool software = scene.renderer.chunks().capabilities().software;
    if (!planet::gl::isUsed(layers.use, software)) return;
    fitLayerPictures(layers.set, layerFolderOf(layers.file), scene.renderer.chunks(), scene.layers);
    drawing.pictures = picturesOf(layers.set, scene.layers);
}

ViewSettings afforded(const Scene& scene, ViewSettings settings) {
    turnDown(scene.turnedDown, settings.surface);
    return settings;
}

planet::ViewInput viewInputOf(const Scene& scene, const planet::View& view, const ViewSettings& settings,
                              double priorityFactor = 1) {
    planet::ViewInput input{view, lodSettingsOf(settings), priorityFactor, colourSettingsOf(settings),
                            normalSettingsOf(settings)};
    scene.renderer.limit(input);
    return input;
}

void beginFrame(Scene& scene, const planet::View& lodView, const ViewSettings& settings) {
    const planet::gl::RenderSettings render = renderSettingsOf(settings, lodView, scene.planet->tree());
    scene.seaSurfaceM =
        scene.renderer.chunks().drawsSeaSurface(render) ? std::optional(render.seaLevelM) : std::nullopt;
    scene.clipmap.filledTexels = 0;
    scene.drawCpuMs = 0;
    scene.drawn = {};
}

}  // namespace

planet::Result<Scene> openScene(const SceneConfig& config, const ViewSettings& settings) {
    auto planet = planet::Planet::open(config.chunkFile, pagingSettingsOf(settings));
    if (!planet) return tl::unexpected(planet.error());
    (*planet)->setExaggeration(settings.surface.exaggeration);
    auto renderer = planet::gl::PlanetRenderer::create(**planet, {config.shaderFolder, config.programs});
    if (!renderer) return tl::unexpected(renderer.error());
    Scene scene{std::move(*planet), std::move(*renderer)};
    scene.identity = std::make_shared<const int>(0);
    scene.exaggeration = settings.surface.exaggeration;
    if (config.colour) {
        const planet::Result<void> made = scene.renderer.chunks().setColourImage(
            config.colour->rgb, config.colour->width, config.colour->height);
        if (!made)
            scene.problems.push_back(fmt::format(
                "The colour image cannot be drawn, using the height ramp instead: {}", made.error().message));
        scene.hasColourImage = made.has_value();
    }
    // Only now it is known who draws; what is refused is told of when settings are next applied.
    if (auto applied = applyPaging(scene, pagingSettingsOf(settings, false, std::nullopt, drawsByCpu(scene)));
        !applied)
        scene.refusedPaging.reset();
    return scene;
}

planet::LodSettings lodSettingsOf(const ViewSettings& settings) {
    planet::LodSettings lod = settings.lod;
    // Bounds are those of the sphere, so culling would remove visible parts of the cube.
    if (settings.overlay.cube) lod.frustumCulling = lod.horizonCulling = false;
    return lod;
}

planet::TileSettings colourSettingsOf(const ViewSettings& settings) {
    const SurfaceSettings& surface = settings.surface;
    const bool seen = surface.streamed && surface.surface == planet::gl::SurfaceColour::Image &&
                      surface.imageOpacity > 0 && !settings.overlay.cube;
    return {.enabled = seen, .texelsPerPixel = surface.texelsPerPixel};
}

// Without light nothing shows them but the layers, whose slopes are near enough by the mesh.
planet::TileSettings normalSettingsOf(const ViewSettings& settings) {
    const planet::gl::NormalDrawing& normals = settings.surface.light.normals;
    return {.enabled = settings.surface.lighting && normals.use != planet::gl::FeatureUse::Off,
            .texelsPerPixel = normals.texelsPerPixel};
}

planet::PagingSettings pagingSettingsOf(const ViewSettings& settings, bool paused,
                                        std::optional<planet::PagingTime> time, bool software) {
    const planet::PagingTime asSet =
        settings.paging.simulated ? planet::PagingTime::Simulated : planet::PagingTime::Clock;
    return {.budgetBytes = static_cast<std::size_t>(settings.paging.budgetMB) << 20,
            .loaderThreads = settings.paging.loaderThreads,
            .uploadLimitMs = settings.paging.uploadLimitMs,
            .paused = paused,
            .badDisk = settings.paging.badDisk,
            .retry = {settings.paging.retries, settings.paging.retryDelayS},
            .colourShare = settings.paging.colourShare,
            .normals =
                settings.surface.lighting && planet::gl::isUsed(settings.surface.light.normals.use, software),
            .normalShare = settings.paging.normalShare,
            .time = time.value_or(asSet)};
}

planet::gl::RenderSettings renderSettingsOf(const ViewSettings& settings, const planet::View& view,
                                            const planet::ChunkTree& tree) {
    const SurfaceSettings& surface = settings.surface;
    const OverlaySettings& overlay = settings.overlay;
    planet::gl::RenderSettings render;
    render.surface = surface.surface;
    render.imageOpacity = surface.imageOpacity;
    render.streamed = surface.streamed;
    render.texelsPerPixel = surface.texelsPerPixel;
    if (surface.colourMode == ColourMode::Clipmap) render.clipmapPx = surface.clipmapSizePx;
    render.rampTopM = rampTopM(tree);
    // Users name true heights; the renderer's are as drawn.
    render.ramp = surface.ramp;
    for (planet::gl::RampStop& stop : render.ramp) stop.heightM *= tree.exaggeration;
    render.sea = surface.sea;
    render.seaLevelM = surface.seaLevelM * tree.exaggeration;
    render.exaggeration = tree.exaggeration;
    render.wireframe = overlay.wireframe;
    render.outlines = overlay.outlines;
    render.skirtPaint = overlay.skirtPaint;
    render.stitched = settings.lod.seams == planet::SeamMode::Stitched;
    render.cube = overlay.cube;
    render.atmosphere = surface.atmosphere && !overlay.cube;
    render.lighting = surface.lighting;
    render.detail = surface.detail;
    render.sunDirection =
        surface.sunFollows ? morningSun(view.eyeM) : planet::directionFromGeographic(sunOverheadOf(surface));
    render.light = surface.light;
    if (overlay.colourBy != ColourBy::None) render.light.fill = 0;  // a tinted picture measures
    render.layers = layerDrawingOf(surface.layers);
    return render;
}

planet::Result<void> applyLiveSettings(Scene& scene, const ViewSettings& asked, bool pagingPaused,
                                       std::optional<planet::PagingTime> time) {
    const ViewSettings settings = afforded(scene, asked);
    if (scene.exaggeration != settings.surface.exaggeration) {
        scene.exaggeration = settings.surface.exaggeration;
        scene.planet->setExaggeration(settings.surface.exaggeration);
        scene.renderer.fitShape(*scene.planet);
    }
    return applyPaging(scene, pagingSettingsOf(settings, pagingPaused, time, drawsByCpu(scene)));
}

namespace {

void step(Scene& scene, const ViewSettings& settings, std::span<const planet::ViewInput> views,
          std::optional<double> elapsedS) {
    beginFrame(scene, views.front().lodView, settings);
    scene.planet->step(views, scene.renderer.upload(), elapsedS);
}

}  // namespace

void stepScene(Scene& scene, const planet::View& lodView, const ViewSettings& asked,
               std::optional<double> elapsedS) {
    const ViewSettings settings = afforded(scene, asked);
    const planet::ViewInput only = viewInputOf(scene, lodView, settings);
    step(scene, settings, std::span(&only, 1), elapsedS);
}

void stepScene(Scene& scene, const planet::View& lodView, const planet::View& observerView,
               const ViewSettings& asked, std::optional<double> elapsedS) {
    const ViewSettings settings = afforded(scene, asked);
    const std::array<planet::ViewInput, 2> views = {
        viewInputOf(scene, lodView, settings),
        viewInputOf(scene, observerView, settings, observerPriorityFactor)};
    step(scene, settings, views, elapsedS);
}

void drawScene(Scene& scene, const planet::View& renderView, const ViewSettings& settings,
               std::size_t selection, std::span<const planet::gl::ChunkTint> tints,
               planet::gl::ShaderWait wait) {
    drawItems(scene, renderView, settings, scene.planet->selection(selection).draw,
              settings.lod.seams == planet::SeamMode::Stitched, tints, wait);
}

void drawItems(Scene& scene, const planet::View& renderView, const ViewSettings& asked,
               std::span<const planet::DrawItem> items, bool stitched,
               std::span<const planet::gl::ChunkTint> tints, planet::gl::ShaderWait wait) {
    const ViewSettings settings = afforded(scene, asked);
    const Stopwatch watch;
    planet::gl::RenderSettings render = renderSettingsOf(settings, renderView, scene.planet->tree());
    render.stitched = stitched;
    fitLayers(scene, settings.surface.layers, render.layers);
    scene.renderer.draw(*scene.planet, renderView, render, {.items = items, .tints = tints, .wait = wait});
    traceClipmap(scene.renderer.chunks(), scene.planet->lastStep().nowS, scene.clipmap);
    scene.drawCpuMs += watch.elapsedMs();
    const planet::gl::RenderCounters& counters = scene.renderer.chunks().counters();
    scene.drawn.chunks += counters.chunks;
    scene.drawn.groundTriangles += counters.groundTriangles;
    scene.drawn.skirtTriangles += counters.skirtTriangles;
    scene.drawn.uploads += counters.uploads;
    scene.drawn.standIn |= counters.standIn;
    scene.drawn.chunksMs += counters.chunksMs;
    scene.drawn.skyMs += counters.skyMs;
    scene.drawn.shadowsMs += counters.shadowsMs;
}

std::vector<std::string> takeProblems(Scene& scene) {
    std::vector<std::string> problems = std::exchange(scene.problems, {});
    for (std::vector<std::string>& more :
         std::array{std::exchange(scene.layers.untold, {}), scene.renderer.takeProblems(),
                    scene.planet->takeProblems()})
        problems.insert(problems.end(), more.begin(), more.end());
    return problems;
}

bool settleScene(Scene& scene, const planet::View& lodView, const ViewSettings& asked, double timeoutS) {
    const ViewSettings settings = afforded(scene, asked);
    beginFrame(scene, lodView, settings);
    const planet::ViewInput only = viewInputOf(scene, lodView, settings);
    return scene.planet->settle(std::span(&only, 1), scene.renderer.upload(), timeoutS);
}

FrameStats statsOf(const Scene& scene) {
    FrameStats stats;
    stats.selection = scene.planet->selection().counters;
    stats.paging = scene.planet->paging();
    stats.stages = scene.planet->lastStep().times;
    stats.render = scene.drawn;
    stats.gpuMemory = scene.renderer.chunks().gpuMemory();
    stats.drawCpuMs = scene.drawCpuMs;
    stats.clipmap = clipmapStatsOf(scene.renderer, scene.clipmap);
    return stats;
}

planet::Lines linesOver(const Scene& scene, const planet::Selection& selection,
                        const planet::View& renderView, const ViewSettings& settings) {
    const planet::ChunkTree& tree = scene.planet->tree();
    planet::Lines lines = overlayLines(tree, selection, renderView, settings);
    if (settings.overlay.clipmap)
        appendClipmapLines(scene.renderer.chunks(), scene.clipmap, tree, renderView,
                           scene.planet->lastStep().nowS, lines);
    return lines;
}

Ground groundBelow(const Scene& scene, const glm::dvec3& eyeM) {
    const double groundM = planet::residentHeightM(scene.planet->tree(), glm::normalize(eyeM));
    return {scene.planet->tree().shape.radiusM, std::max(groundM, scene.seaSurfaceM.value_or(groundM))};
}

}  // namespace worldy
