#include "app/scene/atlas_drape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "planet/base/percentile.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

AtlasDrape drapeOf(std::span<const planet::AtlasCell> cells, planet::AtlasMeasure measure, int altitude) {
    AtlasDrape drape{.measure = measure};
    std::vector<double> values;
    for (const planet::AtlasCell& cell : cells) {
        const double value = planet::figureOf(cell.values, measure);
        if (cell.altitude != altitude || std::isnan(value)) continue;
        values.push_back(value);
        for (int level = cell.cell.level; level >= 0; --level) {
            double& most = drape.values.try_emplace(ancestorOf(cell.cell, level), value).first->second;
            most = std::max(most, value);
        }
    }
    if (values.empty()) return drape;
    drape.least = *std::min_element(values.begin(), values.end());
    const double largest = *std::max_element(values.begin(), values.end());
    drape.most = planet::percentileOf(values, 0.99);
    if (drape.most <= drape.least) drape.most = largest;
    drape.isClamped = largest > drape.most;
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
    if (!(drape.most > drape.least)) return 0;
    return std::clamp((value - drape.least) / (drape.most - drape.least), 0.0, 1.0);
}

double valueOf(const AtlasDrape& drape, double share) {
    return drape.least + share * (drape.most - drape.least);
}

}  // namespace worldy
