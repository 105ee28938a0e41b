#include "app/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/stopwatch.h"
#include "planet/cube_sphere.h"

namespace worldy {

namespace {

planet::PagingSettings pagingSettingsOf(const ui::ViewSettings& settings) {
    return {.budgetBytes = static_cast<std::size_t>(settings.budgetMB) << 20,
            .loaderThreads = settings.loaderThreads,
            .uploadLimitMs = settings.uploadLimitMs};
}

planet::UploadChunk uploadInto(planet::gl::ChunkRenderer& renderer) {
    return [&renderer](std::uint32_t slot, std::span<const std::int16_t> heights) {
        renderer.upload(slot, heights);
    };
}

// Low enough in the east for relief to show, high enough for most of what is in view to be lit.
glm::dvec3 morningSun(const glm::dvec3& eyeM) {
    const planet::Geographic place = planet::geographicFromDirection(eyeM);
    const glm::dvec3 up = glm::normalize(eyeM);
    const glm::dvec3 east(-std::sin(place.longitudeRad), std::cos(place.longitudeRad), 0);
    return 0.65 * up + 0.65 * east + 0.4 * glm::cross(up, east);
}

// The ramp's colours spread over the planet's own heights, whatever they are.
double rampTopM(const planet::ChunkTree& tree) {
    const double highestM = planet::heightM(tree.shape, tree.maxStep);
    const double lowestM = planet::heightM(tree.shape, tree.minStep);
    return std::max({0.85 * highestM, 0.3 * (highestM - lowestM), 1.0});
}

}  // namespace

planet::Result<Scene> openScene(const SceneConfig& config, const ui::ViewSettings& settings) {
    auto planet = planet::Planet::open(config.chunkFile, pagingSettingsOf(settings));
    if (!planet) return tl::unexpected(planet.error());
    auto renderer = planet::gl::ChunkRenderer::create(
        {(*planet)->shape(), (*planet)->slotCapacity(), config.shaderFolder});
    if (!renderer) return tl::unexpected(renderer.error());
    Scene scene{std::move(*planet), std::move(*renderer)};
    scene.openBudgetMB = settings.budgetMB;
    if (config.colour) {
        scene.renderer.setColourImage(config.colour->rgb, config.colour->width, config.colour->height);
        scene.hasColourImage = true;
    }
    return scene;
}

planet::LodSettings lodSettingsOf(const ui::ViewSettings& settings) {
    planet::LodSettings lod;
    lod.tauPx = settings.tauPx;
    lod.skirtFactor = settings.skirtFactor;
    // Bounds are those of the sphere; on the cube they would cut away what is in view.
    lod.frustumCulling = settings.frustumCulling && !settings.cube;
    lod.horizonCulling = settings.horizonCulling && !settings.cube;
    return lod;
}

planet::gl::RenderSettings renderSettingsOf(const ui::ViewSettings& settings, const planet::View& view,
                                            const planet::ChunkTree& tree) {
    planet::gl::RenderSettings render;
    render.surface = settings.surface;
    render.colourBy = settings.colourBy;
    render.tauPx = settings.tauPx;
    render.wireframe = settings.wireframe;
    render.skirts = settings.skirts;
    render.cube = settings.cube;
    render.atmosphere = settings.atmosphere && !settings.cube;
    render.lighting = settings.lighting;
    render.detail = settings.detail;
    render.rampTopM = rampTopM(tree);
    render.sunDirection = settings.sunFollows
                              ? morningSun(view.eyeM)
                              : planet::directionFromGeographic({glm::radians(settings.sunLatitudeDeg),
                                                                 glm::radians(settings.sunLongitudeDeg)});
    return render;
}

void stepScene(Scene& scene, const planet::View& lodView, const ui::ViewSettings& settings) {
    scene.planet->step(lodView, lodSettingsOf(settings), uploadInto(scene.renderer));
}

void drawScene(Scene& scene, const planet::View& renderView, const ui::ViewSettings& settings) {
    const Stopwatch watch;
    scene.renderer.draw(renderView, scene.planet->selection().draw,
                        renderSettingsOf(settings, renderView, scene.planet->tree()));
    scene.drawCpuMs = watch.elapsedMs();
}

bool settleScene(Scene& scene, const planet::View& lodView, const ui::ViewSettings& settings,
                 double timeoutS) {
    return scene.planet->settle(lodView, lodSettingsOf(settings), uploadInto(scene.renderer), timeoutS);
}

ui::FrameStats statsOf(const Scene& scene) {
    ui::FrameStats stats;
    stats.selection = scene.planet->selection().counters;
    stats.paging = scene.planet->paging();
    stats.stages = scene.planet->times();
    stats.render = scene.renderer.counters();
    stats.gpuBytes = scene.renderer.gpuBytes();
    stats.drawCpuMs = scene.drawCpuMs;
    return stats;
}

Ground groundBelow(const Scene& scene, const glm::dvec3& eyeM) {
    return {scene.planet->shape().radiusM,
            planet::residentHeightM(scene.planet->tree(), glm::normalize(eyeM))};
}

}  // namespace worldy
