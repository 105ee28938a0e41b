#include "ui/model/picked_point.h"

#include "planet/measure/pick.h"

namespace worldy::ui {

namespace {

glm::dvec3 middleOf(const planet::ChunkId& id, const planet::ChunkTree& tree) {
    const planet::FaceSquare square = planet::faceSquareOf(id);
    const double half = square.side / 2;
    const glm::dvec3 up =
        planet::sphereFromCube(planet::cubePoint(id.face, square.u + half, square.v + half));
    return (tree.shape.radiusM + planet::residentHeightM(tree, up)) * up;
}

}  // namespace

std::optional<glm::dvec3> pickedPoint(const EditorView& view) {
    if (!view.planet) return std::nullopt;
    if (view.pointedM) return view.pointedM;
    if (view.focus.selected) return middleOf(*view.focus.selected, view.planet->tree());
    const planet::View& camera = view.camera.renderView;
    const auto hit =
        planet::pickSurface(view.planet->tree(), view.planet->selection().draw, camera.eyeM, -camera.back);
    return hit ? std::optional(hit->positionM) : std::nullopt;
}

}  // namespace worldy::ui
