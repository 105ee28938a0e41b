#include "app/scene/atlas_drape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "planet/base/percentile.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_sampling.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

namespace {

// Fills in the values of the squares, where worse(a, b) is the value of a square with both. Returns the finite values of
// the cells.
template <class Worse>
std::vector<double> fillDrape(std::span<const planet::AtlasCell> cells, int altitude, const Worse& worse,
                              AtlasDrape& drape) {
    std::vector<double> values;
    for (const planet::AtlasCell& cell : cells) {
        const double value = planet::figureOf(cell.values, drape.measure);
        if (cell.altitude != altitude || std::isnan(value)) continue;
        if (std::isfinite(value)) values.push_back(value);
        drape.hasUnbounded |= std::isinf(value) && value > 0;
        drape.hasGained |= std::isinf(value) && value < 0;
        for (int level = cell.cell.level; level >= 0; --level) {
            double& worst = drape.values.try_emplace(ancestorOf(cell.cell, level), value).first->second;
            worst = worse(worst, value);
        }
    }
    drape.cellsOnScale = values.size();
    return values;
}

}  // namespace

AtlasDrape drapeOf(std::span<const planet::AtlasCell> cells, planet::AtlasMeasure measure, int altitude) {
    AtlasDrape drape{.measure = measure};
    std::vector<double> values = fillDrape(
        cells, altitude, [](double a, double b) { return std::max(a, b); }, drape);
    if (values.empty()) return drape;
    const auto [least, largest] = std::ranges::minmax(values);
    drape.least = least;
    drape.most = planet::percentileOf(values, 0.99);
    if (drape.most <= drape.least) drape.most = largest;
    drape.isClamped = largest > drape.most;
    return drape;
}

AtlasDrape changeDrapeOf(std::span<const planet::AtlasCell> cells, planet::AtlasMeasure measure,
                         int altitude) {
    AtlasDrape drape{.measure = measure, .isChange = true};
    std::vector<double> sizes = fillDrape(cells, altitude, planet::worseChange, drape);
    for (double& size : sizes) size = std::abs(size);
    std::erase(sizes, 0.0);
    if (sizes.empty()) return drape;
    drape.most = planet::percentileOf(sizes, 0.99);
    drape.least = -drape.most;
    drape.isClamped = std::ranges::max(sizes) > drape.most;
    return drape;
}

std::optional<double> valueAt(const AtlasDrape& drape, const planet::ChunkId& square) {
    planet::ChunkId at = square;
    while (true) {
        if (const auto found = drape.values.find(at); found != drape.values.end()) return found->second;
        if (at.level == 0) return std::nullopt;
        at = parentOf(at);
    }
}

bool isCoarserThanCells(const AtlasDrape& drape, const planet::ChunkId& square) {
    if (square.level >= planet::finestAtlasLevel || !drape.values.contains(square)) return false;
    for (int quadrant = 0; quadrant < planet::quadrantCount; ++quadrant) {
        if (drape.values.contains(childOf(square, quadrant))) return true;
    }
    return false;
}

double shareOf(const AtlasDrape& drape, double value) {
    if (!(drape.most > drape.least)) return drape.isChange ? 0.5 : 0;
    return std::clamp((value - drape.least) / (drape.most - drape.least), 0.0, 1.0);
}

double valueOf(const AtlasDrape& drape, double share) {
    return drape.least + share * (drape.most - drape.least);
}

}  // namespace worldy
