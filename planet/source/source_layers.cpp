#include "planet/source/source_layers.h"

#include <algorithm>

namespace planet {

std::vector<double> sharesOf(const SourceLayers& layers, std::span<const SourceReading> readings) {
    std::vector<double> shares(readings.size());
    double heightM = layers.fillM;
    for (std::size_t i = readings.size(); i-- > 0;) {
        const SourceReading& reading = readings[i];
        if (!reading.heightM) continue;
        const LayerJoin join = layers.layers[reading.layer].join;
        if (join == LayerJoin::Max && *reading.heightM <= heightM) continue;
        shares[i] = reading.weight;
        if (join == LayerJoin::Add) {
            heightM += reading.weight * *reading.heightM;
            continue;
        }
        for (std::size_t below = i + 1; below < shares.size(); ++below) shares[below] *= 1 - reading.weight;
        heightM += reading.weight * (*reading.heightM - heightM);
    }
    return shares;
}

const SourceReading* topmost(std::span<const SourceReading> readings) {
    const auto found = std::ranges::find_if(
        readings, [](const SourceReading& reading) { return reading.heightM.has_value(); });
    return found == readings.end() ? nullptr : &*found;
}

}  // namespace planet
