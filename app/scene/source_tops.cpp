#include "app/scene/source_tops.h"

#include "planet/sphere/cube_sphere.h"

namespace worldy {

planet::Geographic placeInMiddleOf(const planet::ChunkId& chunk) {
    const planet::FaceSquare square = planet::faceSquareOf(chunk);
    const double half = square.side / 2;
    return planet::geographicFromDirection(
        planet::sphereFromCube(planet::cubePoint(chunk.face, square.u + half, square.v + half)));
}

planet::Result<void> addTops(const planet::SourceLayers& source, std::span<const planet::DrawItem> drawn,
                             SourceTops& tops) {
    for (const planet::DrawItem& item : drawn) {
        if (tops.contains(item.id)) continue;
        const planet::Result<std::vector<planet::SourceReading>> readings =
            source.at(placeInMiddleOf(item.id));
        if (!readings) return tl::unexpected(readings.error());
        const planet::SourceReading* const top = planet::topmost(*readings);
        tops[item.id] = top ? std::optional(top->layer) : std::nullopt;
    }
    return {};
}

}  // namespace worldy
