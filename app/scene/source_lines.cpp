#include "app/scene/source_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "app/scene/overlay_colours.h"

namespace worldy {

namespace {

constexpr std::uint8_t outlineOpacity = 255;

// Returns whether the horizon hides a place at height 0.
bool isBehind(const glm::dvec3& direction, const glm::dvec3& eyeM, double radiusM) {
    return glm::dot(direction, eyeM) < radiusM * std::min(1.0, radiusM / glm::length(eyeM)) * 0.98;
}

}  // namespace

planet::Lines sourceLines(const planet::SourceLayers& source, const planet::ChunkTree& tree,
                          const planet::View& view) {
    planet::Lines lines;
    const double pixelRad = 1 / planet::screenScalePx(view);
    for (std::size_t i = 0; i < source.layers.size(); ++i) {
        const planet::LineColour colour = colourBytes(layerColour(i), outlineOpacity);
        for (const planet::Outline& outline : source.layers[i].outlines) {
            std::vector<glm::dvec3> points;
            std::vector<bool> behind;
            for (const planet::Geographic& place : outline) {
                const glm::dvec3 direction = planet::directionFromGeographic(place);
                behind.push_back(isBehind(direction, view.eyeM, tree.shape.radiusM));
                const double groundM = behind.back() ? 0 : planet::sampledHeightM(tree, direction);
                const glm::dvec3 ground = planet::positionM(tree.shape, direction, groundM);
                const double liftM = 2 * pixelRad * glm::length(ground - view.eyeM);
                points.push_back(planet::positionM(tree.shape, direction, groundM + liftM));
            }
            for (std::size_t k = 1; k < points.size(); ++k) {
                if (behind[k - 1] || behind[k]) continue;
                lines.push_back({points[k - 1], colour});
                lines.push_back({points[k], colour});
            }
        }
    }
    return lines;
}

double reachRad(const planet::SourceLayer& layer) {
    if (layer.coversPlanet || layer.outlines.empty()) return std::numbers::pi;
    const glm::dvec3 middle = planet::directionFromGeographic(layer.middle);
    double reach = 0;
    for (const planet::Outline& outline : layer.outlines) {
        for (const planet::Geographic& place : outline) {
            const double cosine = glm::dot(middle, planet::directionFromGeographic(place));
            reach = std::max(reach, std::acos(std::clamp(cosine, -1.0, 1.0)));
        }
    }
    return reach;
}

planet::CameraPose poseOver(const planet::SourceLayer& layer, const planet::ChunkTree& tree) {
    const double radiusM = tree.shape.radiusM;
    const double reach = std::min(reachRad(layer), std::numbers::pi / 2);
    const double groundM = planet::residentHeightM(tree, planet::directionFromGeographic(layer.middle));
    return {.latitudeDeg = glm::degrees(layer.middle.latitudeRad),
            .longitudeDeg = glm::degrees(layer.middle.longitudeRad),
            .altitudeM = groundM + std::max(100.0, 2.2 * radiusM * std::sin(reach)),
            .headingDeg = 0,
            .pitchDeg = -88};
}

}  // namespace worldy
