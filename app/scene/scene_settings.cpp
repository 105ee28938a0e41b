#include "app/scene/scene_settings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/settings/sun_overhead.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

// Returns the direction of a sun in the east: low enough for relief to show, high enough to light most of the
// view.
glm::dvec3 morningSun(const glm::dvec3& eyeM) {
    const planet::Geographic place = planet::geographicFromDirection(eyeM);
    const glm::dvec3 up = glm::normalize(eyeM);
    const glm::dvec3 east(-std::sin(place.longitudeRad), std::cos(place.longitudeRad), 0);
    return 0.65 * up + 0.65 * east + 0.4 * glm::cross(up, east);
}

// Returns the height of the top of the colour ramp, which follows the planet's own range of heights. The
// shape of the tree includes the exaggeration.
double rampTopM(const planet::ChunkTree& tree) {
    const double highestM = planet::heightM(tree.shape, tree.maxStep);
    const double lowestM = planet::heightM(tree.shape, tree.minStep);
    return std::max({0.85 * highestM, 0.3 * (highestM - lowestM), 1.0});
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

}  // namespace

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
            .unpackedColours = software,
            .normals =
                settings.surface.lighting && planet::gl::isUsed(settings.surface.light.normals.use, software),
            .normalShare = settings.paging.normalShare,
            .prefetch = settings.paging.prefetch,
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
    // Users edit true heights; the renderer takes exaggerated ones.
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
    if (overlay.colourBy != ColourBy::None) render.light.fill = 0;  // the fill light would distort the tints
    render.layers = layerDrawingOf(surface.layers);
    return render;
}

}  // namespace worldy
