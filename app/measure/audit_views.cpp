#include "app/measure/audit_views.h"

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/scene/camera_control.h"

namespace worldy {

namespace {

using planet::ChunkData;
using planet::Result;

int heightRange(const ChunkData& chunk) {
    return chunk.maxStep - chunk.minStep;
}

template <std::size_t count>
ChunkData takeMostRugged(std::array<ChunkData, count>&& chunks) {
    return std::move(*std::max_element(
        chunks.begin(), chunks.end(),
        [](const ChunkData& a, const ChunkData& b) { return heightRange(a) < heightRange(b); }));
}

struct LowView {
    double radii;  // height above the highest ground, in planet radii
    double headingDeg;
    double pitchDeg;
};
constexpr std::array<LowView, 7> lowViews = {{{0.3, 0, -90},
                                              {0.05, 45, -50},
                                              {0.01, 0, -90},
                                              {0.01, 200, -20},
                                              {0.002, 90, -15},
                                              {0.002, 270, -5},
                                              {0.0005, 150, 0}}};

// Descends from the roots, always to the chunk whose finest heights differ most, and returns the leaf.
Result<ChunkData> mostRuggedLeaf(const planet::ChunkFile& file) {
    std::array<ChunkData, planet::faceCount> roots;
    for (const planet::Face face : planet::allFaces) {
        Result<ChunkData> root = file.readRoot(face);
        if (!root) return root;
        roots[static_cast<std::size_t>(face)] = std::move(*root);
    }
    ChunkData chunk = takeMostRugged(std::move(roots));
    while (chunk.children.exists()) {
        auto children = file.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!children) return tl::unexpected(std::move(children.error()));
        chunk = takeMostRugged(std::move(*children));
    }
    return chunk;
}

}  // namespace

Result<std::vector<planet::CameraPose>> auditPoses(const planet::ChunkFile& file) {
    const Result<ChunkData> leaf = mostRuggedLeaf(file);
    if (!leaf) return tl::unexpected(leaf.error());
    const planet::PlanetShape& shape = file.info().shape;
    const planet::FaceSquare square = planet::faceSquareOf(leaf->id);
    const planet::Geographic place = planet::geographicFromDirection(planet::sphereFromCube(
        planet::cubePoint(leaf->id.face, square.u + square.side / 2, square.v + square.side / 2)));
    const double highestM = planet::heightM(shape, leaf->maxStep);

    planet::CameraPose pose = wholePlanetPose(shape.radiusM);
    pose.latitudeDeg = glm::degrees(place.latitudeRad);
    pose.longitudeDeg = glm::degrees(place.longitudeRad);
    std::vector<planet::CameraPose> poses = {pose};
    pose.latitudeDeg = -pose.latitudeDeg;
    pose.longitudeDeg += pose.longitudeDeg > 0 ? -180 : 180;
    poses.push_back(pose);
    for (const LowView& low : lowViews) {
        poses.push_back({.latitudeDeg = glm::degrees(place.latitudeRad),
                         .longitudeDeg = glm::degrees(place.longitudeRad),
                         .altitudeM = highestM + low.radii * shape.radiusM,
                         .headingDeg = low.headingDeg,
                         .pitchDeg = low.pitchDeg});
    }
    return poses;
}

}  // namespace worldy
