#include "app/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <stop_token>
#include <utility>

#include "app/base/picture_file.h"
#include "app/base/stopwatch.h"
#include "app/scene/overlay_lines.h"
#include "app/scene/scene_settings.h"
#include "app/settings/layer_file.h"
#include "planet/spans/span_recorder.h"

namespace worldy {

namespace {

// Fits the renderer's pool to the slots of the planet. If that fails, restores the planet's former slots.
planet::Result<void> fitPool(Scene& scene, const planet::PagingSettings& before) {
    planet::Result<void> fitted = scene.renderer.fitHeights(*scene.planet);
    if (!fitted) {
        static_cast<void>(scene.planet->setPaging(before));
        static_cast<void>(
            scene.renderer.fitHeights(*scene.planet));  // succeeds: the pool still has that size
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

// Loads the textures of the layers if layers are drawn.
void fitLayers(Scene& scene, const LayerSettings& layers, planet::gl::LayerDrawing& drawing) {
    if (!planet::gl::isUsed(layers.use, drawsByCpu(scene))) return;
    fitLayerPictures(layers.set, layerFolderOf(layers.file), scene.renderer.chunks(), scene.layers);
    drawing.pictures = picturesOf(layers.set, scene.layers);
}

// Takes a picture as the colour image.
planet::Result<void> giveColourImage(Scene& scene, const planet::Result<Picture>& image) {
    const std::filesystem::path file = std::exchange(scene.colourImage, {});
    if (!image) return tl::unexpected(image.error());
    const planet::Result<void> made =
        scene.renderer.chunks().setColourImage(image->rgb, image->width, image->height);
    scene.hasColourImage = made.has_value();
    return made.map_error([&](planet::Error error) {
        error.message = fmt::format("{}: cannot be drawn, using the height ramp instead: {}", file.string(),
                                    error.message);
        return error;
    });
}

// Returns the picture once another thread has read it.
std::optional<planet::Result<Picture>> pictureReadBeside(Scene& scene) {
    if (!scene.colourReading) {
        scene.colourReading = std::make_unique<PictureJob>(
            [file = scene.colourImage](const std::stop_token&) { return readPlanetPicture(file); });
    }
    std::optional<planet::Result<Picture>> image = scene.colourReading->takeResult();
    if (image) scene.colourReading.reset();
    return image;
}

// Reads the colour image when it is first drawn, because that takes as long as opening a planet.
void fitColourImage(Scene& scene, const SurfaceSettings& surface, planet::gl::ShaderWait wait) {
    // A picture that is being read is kept, even if it is not drawn any more.
    if (scene.colourImage.empty() || (!scene.colourReading && !drawsColourImage(scene, surface))) return;
    planet::Result<void> given;
    if (wait == planet::gl::ShaderWait::Never) {
        const std::optional<planet::Result<Picture>> image = pictureReadBeside(scene);
        if (!image) return;
        given = giveColourImage(scene, *image);
    } else {
        given = readColourImage(scene);
    }
    if (!given) scene.problems.push_back(given.error().message);
}

// Returns the settings without the features that are too slow here.
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

void step(Scene& scene, const ViewSettings& settings, std::span<const planet::ViewInput> views,
          std::optional<double> elapsedS) {
    beginFrame(scene, views.front().lodView, settings);
    scene.planet->step(views, scene.renderer.upload(), elapsedS);
}

void addCounters(const planet::gl::RenderCounters& counters, planet::gl::RenderCounters& sums) {
    sums.chunks += counters.chunks;
    sums.groundTriangles += counters.groundTriangles;
    sums.skirtTriangles += counters.skirtTriangles;
    sums.uploads += counters.uploads;
    sums.standIn |= counters.standIn;
    sums.newPrograms += counters.newPrograms;
    sums.chunksMs += counters.chunksMs;
    sums.skyMs += counters.skyMs;
    sums.shadowsMs += counters.shadowsMs;
}

}  // namespace

planet::Result<Scene> openScene(const SceneConfig& config, const ViewSettings& settings) {
    auto planet = planet::Planet::open(config.chunkFile, pagingSettingsOf(settings));
    if (!planet) return tl::unexpected(planet.error());
    (*planet)->setExaggeration(settings.surface.exaggeration);
    if (const auto set = (*planet)->setRegions(settings.regions.applied()); !set)
        return tl::unexpected(set.error());
    auto renderer = planet::gl::PlanetRenderer::create(**planet, {config.shaderFolder, config.programs});
    if (!renderer) return tl::unexpected(renderer.error());
    Scene scene{std::move(*planet), std::move(*renderer)};
    scene.identity = std::make_shared<const int>(0);
    scene.regions = settings.regions.on ? settings.regions.list : nullptr;
    scene.colourImage = config.colourImage;
    // Only the renderer knows whether the CPU draws. applyLiveSettings reports what is refused here.
    if (auto applied = applyPaging(scene, pagingSettingsOf(settings, false, std::nullopt, drawsByCpu(scene)));
        !applied)
        scene.refusedPaging.reset();
    return scene;
}

bool drawsColourImage(const Scene& scene, const SurfaceSettings& surface) {
    const bool drawsOwn = surface.streamed && scene.planet->colour() && !scene.renderer.lacksColourPool();
    return surface.surface == planet::gl::SurfaceColour::Image && !drawsOwn;
}

planet::Result<void> readColourImage(Scene& scene) {
    scene.colourReading.reset();
    return scene.colourImage.empty() ? planet::Result<void>{}
                                     : giveColourImage(scene, readPlanetPicture(scene.colourImage));
}

planet::Result<void> applyLiveSettings(Scene& scene, const ViewSettings& asked, bool pagingPaused,
                                       std::optional<planet::PagingTime> time) {
    const ViewSettings settings = afforded(scene, asked);
    const double before = scene.planet->tree().exaggeration;
    scene.planet->setExaggeration(settings.surface.exaggeration);
    if (scene.planet->tree().exaggeration != before) scene.renderer.fitShape(*scene.planet);
    const auto regions = settings.regions.on ? settings.regions.list : nullptr;
    if (regions != scene.regions) {
        scene.regions = regions;
        if (auto set = scene.planet->setRegions(settings.regions.applied()); !set) return set;
    }
    return applyPaging(scene, pagingSettingsOf(settings, pagingPaused, time, drawsByCpu(scene)));
}

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
    const planet::SpanScope span("draw");
    const Stopwatch watch;
    planet::gl::RenderSettings render = renderSettingsOf(settings, renderView, scene.planet->tree());
    render.stitched = stitched;
    fitLayers(scene, settings.surface.layers, render.layers);
    fitColourImage(scene, settings.surface, wait);
    scene.renderer.draw(*scene.planet, renderView, render, {.items = items, .tints = tints, .wait = wait});
    // The GPU may have had no room for the planet's own colours.
    fitColourImage(scene, settings.surface, wait);
    traceClipmap(scene.renderer.chunks(), scene.planet->lastStep().nowS, scene.clipmap);
    scene.drawCpuMs += watch.elapsedMs();
    addCounters(scene.renderer.chunks().counters(), scene.drawn);
    scene.drawn.standIn |= scene.colourReading != nullptr;
}

void forgetDraws(Scene& scene) {
    scene.drawCpuMs = 0;
    scene.drawn = {.uploads = scene.drawn.uploads};
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

tl::unexpected<planet::Error> loadingTimedOut() {
    return planet::ioError(
        fmt::format("loading: timed out after {:.0f} s with requested blocks missing; expected a faster disk "
                    "or a larger tolerance",
                    settleTimeoutS));
}

FrameStats statsOf(const Scene& scene) {
    FrameStats stats;
    if (!scene.planet->views().empty()) stats.tauPx = scene.planet->views()[0].input.lod.tauPx;
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
