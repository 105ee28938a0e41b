#include "ui/panels/lod/chunk_heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/base/text.h"
#include "app/scene/overlay_colours.h"

namespace worldy::ui {

namespace {

// A subset of a chunk's heights, each as a share of the chunk's height range.
struct Relief {
    int side = 0;
    std::vector<float> shares;  // row 0 in the south

    float at(int column, int row) const {
        const auto cell = [&](int i) { return static_cast<std::size_t>(std::clamp(i, 0, side - 1)); };
        return shares[cell(row) * static_cast<std::size_t>(side) + cell(column)];
    }
};

Relief reliefOf(const planet::ChunkTree& tree, const planet::ChunkNode& node, int mostCells) {
    const int size = planet::chunkSize(tree.shape);
    const auto [low, high] = planet::lowestAndHighest(*node.heights);
    const float range = std::max(1.0f, static_cast<float>(high - low));
    Relief relief;
    relief.side = std::min(size, std::max(mostCells, 2));
    for (int row = 0; row < relief.side; ++row) {
        for (int column = 0; column < relief.side; ++column) {
            const int i = column * (size - 1) / (relief.side - 1);
            const int j = row * (size - 1) / (relief.side - 1);
            const std::int32_t step = (*node.heights)[static_cast<std::size_t>(j * size + i)];
            relief.shares.push_back(static_cast<float>(step - low) / range);
        }
    }
    return relief;
}

// Slopes are exaggerated: one that rises by the chunk's whole height range over its width looks steep.
float lightAt(const Relief& relief, int column, int row) {
    const float steepness = 0.25f * static_cast<float>(relief.side);
    const float east = (relief.at(column + 1, row) - relief.at(column - 1, row)) * steepness;
    const float north = (relief.at(column, row + 1) - relief.at(column, row - 1)) * steepness;
    const glm::vec3 normal = glm::normalize(glm::vec3(-east, -north, 1));
    return 0.25f + 0.95f * std::max(0.0f, glm::dot(normal, glm::normalize(glm::vec3(-0.6f, 0.6f, 1))));
}

glm::dvec3 directionAt(const planet::ChunkId& id, double along, double up) {
    const planet::FaceSquare square = faceSquareOf(id);
    return planet::sphereFromCube(
        planet::cubePoint(id.face, square.u + along * square.side, square.v + up * square.side));
}

}  // namespace

ChunkPicture chunkPicture(const planet::ChunkTree& tree, const planet::ChunkNode& node, int mostCells) {
    const Relief relief = reliefOf(tree, node, mostCells);
    ChunkPicture picture{relief.side, {}};
    for (int row = relief.side - 1; row >= 0; --row) {
        for (int column = 0; column < relief.side; ++column) {
            const float share = relief.at(column, row);
            const glm::vec3 grey(0.35f + 0.45f * share);
            const glm::vec3 colour = glm::mix(grey, rampColour(static_cast<double>(share)), 0.55f);
            picture.cells.push_back(packedColour(colour * lightAt(relief, column, row)));
        }
    }
    return picture;
}

std::vector<float> chunkProfile(const planet::ChunkTree& tree, const planet::ChunkNode& node,
                                ProfileWay way) {
    const auto size = static_cast<std::size_t>(planet::chunkSize(tree.shape));
    std::vector<float> heights;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t at = way == ProfileWay::WestEast ? size / 2 * size + i : i * size + size / 2;
        heights.push_back(static_cast<float>(planet::heightM(tree.shape, (*node.heights)[at])));
    }
    return heights;
}

double groundSizeM(const planet::PlanetShape& shape, const planet::ChunkId& id, ProfileWay way) {
    const bool across = way == ProfileWay::WestEast;
    // The side is summed in pieces: that of a root chunk spans a quarter of the planet and is no great
    // circle.
    constexpr int pieces = 16;
    double angle = 0;
    for (int i = 0; i < pieces; ++i) {
        const double from = static_cast<double>(i) / pieces;
        const double to = static_cast<double>(i + 1) / pieces;
        const glm::dvec3 a = across ? directionAt(id, from, 0.5) : directionAt(id, 0.5, from);
        const glm::dvec3 b = across ? directionAt(id, to, 0.5) : directionAt(id, 0.5, to);
        angle += 2 * std::asin(std::min(1.0, glm::length(a - b) / 2));
    }
    return angle * shape.radiusM;
}

std::string middlePlaceText(const planet::ChunkId& id) {
    const planet::Geographic place = planet::geographicFromDirection(directionAt(id, 0.5, 0.5));
    return placeText(glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad));
}

std::string chunkIdProblem(const std::string& text, int leafLevel) {
    const auto id = planet::chunkIdFromString(text);
    if (!id) {
        return fmt::format(
            "\"{}\" is not a chunk id; expected face/level/x/y, for example z_pos/3/5/2, with a face of "
            "x_pos, x_neg, y_pos, y_neg, z_pos, z_neg, a level in [0, {}], and x and y in [0, 2^level - 1].",
            text, leafLevel);
    }
    if (id->level > leafLevel)
        return fmt::format("This planet has levels 0 to {}; there is no level {}.", leafLevel, id->level);
    return {};
}

}  // namespace worldy::ui
