// How the shader mixes layers by their relief: the same formula as in shaders/layers.glsl.
#pragma once

#include <cmath>

#include "planet/surface/layer_set.h"

namespace planet {

// Redistributes the weights by the layers' relief, [0, 1] each, and keeps their sum. Returns the weights
// unchanged if the set blends by weight.
inline LayerValues weightsByRelief(const LayerSet& set, const LayerValues& weights,
                                   const LayerValues& relief) {
    if (set.blend == LayerBlend::Weight) return weights;
    LayerValues shares{};
    double total = 0;
    double shared = 0;
    for (std::size_t i = 0; i < maxLayers; ++i) {
        shares[i] = weights[i] * std::exp(blendSharpness(set) * (relief[i] + weights[i] - 1));
        total += weights[i];
        shared += shares[i];
    }
    if (shared <= 0) return weights;
    for (double& share : shares) share *= total / shared;
    return shares;
}

}  // namespace planet
