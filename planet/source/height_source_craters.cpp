// Makes craters over rolling ground.
//
// The craters that reach a piece of a tile are collected first, always in the same order: by size, then in
// the order of the size's lattice. A crater that does not reach a sample adds nothing to it, so the height
// does not depend on the piece.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "planet/source/terrain_sources.h"

namespace planet {

namespace {

constexpr int craterPieceSide = 65;  // samples per side of a piece that collects its craters
constexpr double rimShare = 0.2;     // of the depth
constexpr double ejectaReach = 2.4;  // radii
constexpr double depthsDeep = 2.5;   // heights are limited to this many depths of the largest crater
constexpr double stepsACrater = 4;   // grid steps across the smallest crater that a grid can represent

struct CraterField {
    CraterTerrain settings;
    std::vector<Octave> octaves;
    double groundScaleM = 0;
    double minM = 0;
    double maxM = 0;

    double diameterRad(int size) const { return radFromDeg(settings.largestDeg) / (1 << size); }
};

struct Crater {
    glm::dvec3 middle;
    double radius = 0;  // chord length, on the unit sphere
    double depthM = 0;
    double flatness = 0;  // 0: a bowl, 1: a flat floor with a peak
};

// Returns the height at a distance from the middle, in radii; 0 from ejectaReach on.
double profileM(const Crater& crater, double x) {
    const double rimM = rimShare * crater.depthM;
    if (x >= 1) {
        const double left = (ejectaReach - x) / (ejectaReach - 1);
        return rimM / (x * x * x) * left * left;
    }
    const double bowlM = -crater.depthM + (crater.depthM + rimM) * x * x;
    const double wall = smoothly(0.55, 1, x);
    const double peakM = 0.28 * crater.depthM * std::exp(-x * x / 0.02);
    const double flatM = -0.8 * crater.depthM + (0.8 * crater.depthM + rimM) * wall + peakM;
    return bowlM + crater.flatness * (flatM - bowlM);
}

// Finds the crater of a cell of a size's lattice: a random point of the cell near the sphere is moved onto
// the sphere. A shell as thick as a cell gives each area of a cell one cell's share of craters.
bool craterOf(const CraterField& field, int size, const glm::ivec3& cell, Crater& crater) {
    const double diameter = field.diameterRad(size);
    const std::uint64_t key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.x)) << 32) ^
                              static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.y));
    const std::uint64_t seed =
        scrambled64((std::uint64_t{field.settings.seed} << 8) + static_cast<std::uint64_t>(size));
    const std::uint64_t hash =
        scrambled64(scrambled64(seed ^ key) + static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.z)));
    if (unitOf(hash) >= field.settings.density) return false;
    const auto random = [&](std::uint64_t which) { return unitOf(scrambled64(hash + which)); };
    const glm::dvec3 point = (glm::dvec3(cell) + glm::dvec3(random(1), random(2), random(3))) * diameter;
    const double distance = glm::length(point);
    if (std::abs(distance - 1) > diameter / 2 || distance == 0) return false;
    crater.middle = point / distance;
    const double share = 0.5 + 0.5 * random(4);  // ratio of the diameter to the size's
    crater.radius = diameter / 2 * share;
    const double ofLargest = share / (1 << size);
    const double fresh = 0.35 + 0.65 * random(5);  // the rest has been filled in
    crater.depthM = field.settings.depthM * std::pow(ofLargest, field.settings.depthPower) * fresh;
    crater.flatness = smoothly(1.0 / 32, 1.0 / 8, ofLargest);
    return true;
}

// Collects the craters of a size that may reach a ball around a point of the sphere.
void gather(const CraterField& field, int size, const glm::dvec3& middle, double radius,
            std::vector<Crater>& found) {
    const double diameter = field.diameterRad(size);
    const double reach = radius + ejectaReach * diameter / 2;
    const double box = (reach + diameter / 2) / diameter;  // cells, before a point is moved onto the sphere
    const glm::dvec3 at = middle / diameter;
    const glm::ivec3 low(glm::floor(at - box)), high(glm::floor(at + box));
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                // A cell outside the shell has no crater.
                const double off = glm::length((glm::dvec3(x, y, z) + 0.5) * diameter) - 1;
                if (std::abs(off) > 1.4 * diameter) continue;
                Crater crater;
                if (!craterOf(field, size, {x, y, z}, crater)) continue;
                if (glm::distance(crater.middle, middle) <= radius + ejectaReach * crater.radius)
                    found.push_back(crater);
            }
        }
    }
}

std::vector<Crater> cratersNear(const CraterField& field, const glm::dvec3& middle, double radius,
                                double stepRad) {
    std::vector<Crater> found;
    for (int size = 0; size < field.settings.sizes; ++size) {
        if (field.diameterRad(size) < stepsACrater * stepRad * (1 - 1e-9)) break;
        gather(field, size, middle, radius, found);
    }
    return found;
}

double heightAt(const CraterField& field, const std::vector<Crater>& craters, const glm::dvec3& direction,
                double stepRad) {
    double height =
        field.settings.offsetM + field.groundScaleM * fractalNoise(field.octaves, direction, stepRad);
    for (const Crater& crater : craters) {
        const glm::dvec3 away = direction - crater.middle;
        const double distance = glm::dot(away, away);
        const double reach = ejectaReach * crater.radius;
        if (distance < reach * reach) height += profileM(crater, std::sqrt(distance) / crater.radius);
    }
    return std::clamp(height, field.minM, field.maxM);
}

Result<void> samplePiece(const CraterField& field, const SampleTile& piece, float* out, std::size_t stride) {
    std::vector<glm::dvec3> directions;
    for (int row = piece.firstRow; row < piece.firstRow + piece.rows; ++row) {
        for (int column = piece.firstColumn; column < piece.firstColumn + piece.columns; ++column) {
            directions.push_back(directionOf(piece.face, piece.faceCells, column, row));
        }
    }
    if (directions.empty()) return {};
    const glm::dvec3 middle =
        directions[directions.size() / 2 +
                   (piece.rows % 2 == 0 ? static_cast<std::size_t>(piece.columns) / 2 : 0)];
    double radius = 0;
    for (const glm::dvec3& direction : directions)
        radius = std::max(radius, glm::distance(direction, middle));
    const double stepRad = gridStepRad(filterCellsOf(piece));
    const std::vector<Crater> craters = cratersNear(field, middle, radius + 1e-9, stepRad);
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        out[i / columns * stride + i % columns] =
            static_cast<float>(heightAt(field, craters, directions[i], stepRad));
    }
    return {};
}

}  // namespace

HeightSource craterSource(const CraterTerrain& terrain) {
    CraterField field;
    field.settings = terrain;
    field.octaves = octavesOf(terrain.seed, terrain.octaves, radFromDeg(terrain.featureDeg), 2, terrain.gain);
    field.groundScaleM = terrain.amplitudeM / (noiseReach * fractalRms(field.octaves));
    field.minM = terrain.offsetM - terrain.amplitudeM - depthsDeep * terrain.depthM;
    field.maxM = terrain.offsetM + terrain.amplitudeM + depthsDeep * rimShare * terrain.depthM;
    const double smallestRad = field.diameterRad(terrain.sizes - 1) / stepsACrater;
    const int cells = naturalCells(std::min(smallestRad, field.octaves.back().cellRad / 2));
    const TerrainExtent extent{cells, field.minM, field.maxM};
    return pieceSource(terrain, extent, craterPieceSide, std::move(field), samplePiece);
}

}  // namespace planet
