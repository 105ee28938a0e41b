#include "app/editor/chunk_controller.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/session/overloaded.h"
#include "planet/measure/pick.h"

namespace worldy {

namespace {

// Returns a camera right above a chunk, at a distance where the chunk fills about half of the picture.
Camera cameraAbove(const planet::ChunkId& id, const planet::ChunkTree& tree) {
    const planet::FaceSquare square = planet::faceSquareOf(id);
    const double half = square.side / 2;
    const glm::dvec3 middle =
        planet::sphereFromCube(planet::cubePoint(id.face, square.u + half, square.v + half));
    const glm::dvec3 corner = planet::sphereFromCube(planet::cubePoint(id.face, square.u, square.v));
    const double radiusM = tree.shape.radiusM;
    const double sizeM = 2 * radiusM * glm::length(corner - middle);
    const planet::Geographic place = planet::geographicFromDirection(middle);
    const double groundM = planet::residentHeightM(tree, middle);
    return cameraFromPose({.latitudeDeg = glm::degrees(place.latitudeRad),
                           .longitudeDeg = glm::degrees(place.longitudeRad),
                           .altitudeM = groundM + 1.3 * sizeM,
                           .headingDeg = 0,
                           .pitchDeg = -88},
                          radiusM);
}

}  // namespace

void execute(ChunkController& chunks, const ui::ChunkCommand& command, const Scene* scene,
             CameraController& camera, const CameraContext& context) {
    std::visit(Overloaded{
                   [&](const ui::HoverChunk& hover) { chunks.focus.hovered = hover.id; },
                   [&](const ui::SelectChunk& select) { chunks.focus.selected = select.id; },
                   [&](const ui::LookAtChunk& look) {
                       if (scene) glideCamera(camera, cameraAbove(look.id, scene->planet->tree()), context);
                   },
               },
               command);
}

void pick(const PlanetPicture& picture, const Scene& scene, const PickSettings& settings,
          ChunkController& chunks, ui::Commands& commands) {
    if (!picture.shown() || !picture.pointer.over) return;
    const std::optional<planet::SurfaceHit> hit =
        planet::pickSurface(scene.planet->tree(), scene.planet->selection(settings.selection).draw,
                            picture.view.eyeM, rayThrough(picture.view, picture.pointer.positionPx));
    if (hit) {
        chunks.pointedM = hit->positionM;
        commands.push_back(ui::HoverChunk{hit->id});
    }
    if (!picture.pointer.clicked) return;
    if (settings.placesRulerEnds) {
        if (hit) commands.push_back(ui::PlaceRulerEnd{hit->positionM});
        return;
    }
    commands.push_back(ui::SelectChunk{hit ? std::optional(hit->id) : std::nullopt});
}

}  // namespace worldy
