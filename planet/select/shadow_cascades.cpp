#include "planet/select/shadow_cascades.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "planet/select/lod_select.h"
#include "planet/sphere/culling.h"

namespace planet {

namespace {

struct SunAxes {
    glm::dvec3 x, y, towards;
};

SunAxes sunAxes(const glm::dvec3& sun) {
    const glm::dvec3 towards = glm::normalize(sun);
    const glm::dvec3 aside = std::abs(towards.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, towards));
    return {x, glm::cross(towards, x), towards};
}

// The smallest sphere around the part of a view between two distances along its direction. Its centre lies on
// the view's axis.
struct PieceSphere {
    double alongM = 0;
    double radiusM = 0;
};

PieceSphere sphereAround(const View& view, double startM, double endM) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    const double aside2 = tanX * tanX + tanY * tanY;
    const double alongM = std::min(0.5 * (startM + endM) * (1 + aside2), endM);
    return {alongM, std::sqrt((endM - alongM) * (endM - alongM) + endM * endM * aside2)};
}

// Snaps a coordinate relative to the eye to a whole number of texels from the planet's centre.
double wholeTexels(double eyeM, double relativeM, double texelM) {
    return std::round((eyeM + relativeM) / texelM) * texelM - eyeM;
}

ShadowCascade cascadeAround(const View& view, const SunAxes& axes, const PieceSphere& piece, double endM,
                            int mapSizePx) {
    ShadowCascade cascade;
    cascade.endM = endM;
    // One texel of margin on each side for the snapping.
    cascade.texelM = 2 * piece.radiusM / (mapSizePx - 2);
    const double halfM = cascade.texelM * mapSizePx / 2;
    const glm::dvec3 middle = -view.back * piece.alongM;
    const glm::dvec2 at(wholeTexels(glm::dot(axes.x, view.eyeM), glm::dot(axes.x, middle), cascade.texelM),
                        wholeTexels(glm::dot(axes.y, view.eyeM), glm::dot(axes.y, middle), cascade.texelM));
    const auto row = [](const glm::dvec3& axis, double offset, double scale) {
        return glm::dvec4(axis, -offset) * scale;
    };
    cascade.clipFromEye = glm::transpose(
        glm::dmat4(row(axes.x, at.x, 1 / halfM), row(axes.y, at.y, 1 / halfM),
                   row(axes.towards, glm::dot(axes.towards, middle), -1 / halfM), glm::dvec4(0, 0, 0, 1)));
    return cascade;
}

// Rounds down to a power of two. Distances are rounded so that the texel sizes, which depend on them, rarely
// change.
double powerOfTwoBelow(double value) {
    return std::exp2(std::floor(std::log2(value)));
}

}  // namespace

ShadowCascades shadowCascades(const View& view, const glm::dvec3& sun, double groundM, double reachM,
                              int mapSizePx) {
    assert(groundM > 0 && reachM > 0 && mapSizePx > 2 && glm::length(sun) > 0);
    const SunAxes axes = sunAxes(sun);
    const double firstM = powerOfTwoBelow(std::min(groundM, reachM / 2));
    ShadowCascades cascades;
    double startM = firstM;
    for (std::size_t i = 0; i < shadowCascadeCount; ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(shadowCascadeCount);
        // Equal ratios suit perspective; a share of equal steps keeps the first cascade from being tiny.
        const double evenM = firstM + (reachM - firstM) * share;
        const double endM = 0.85 * firstM * std::pow(reachM / firstM, share) + 0.15 * evenM;
        cascades[i] = cascadeAround(view, axes, sphereAround(view, startM, endM), endM, mapSizePx);
        startM = endM;
    }
    return cascades;
}

std::vector<DrawItem> shadowCasters(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                                    double reachM) {
    if (!settings.frustumCulling && !settings.horizonCulling) return {};
    LodSettings all = settings;
    all.frustumCulling = all.horizonCulling = false;
    all.seams = SeamMode::None;
    Selection selection;
    selectChunks(tree, lodView, all, selection);
    const Culling culling{frustumOf(lodView), horizonOf(lodView.eyeM, tree.occluderRadiusM)};
    std::erase_if(selection.draw, [&](const DrawItem& item) {
        const ChunkBounds& bounds = tree.nodes[item.node].bounds;
        OpenTests open = openTests(settings.frustumCulling, settings.horizonCulling);
        return static_cast<double>(item.distanceM) > reachM || cull(culling, bounds, open) == Culled::No;
    });
    return std::move(selection.draw);
}

}  // namespace planet
