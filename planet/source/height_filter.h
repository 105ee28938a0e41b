// The filter of the height sources: the Catmull-Rom cubic (Catmull and Rom 1974; the Keys kernel with a =
// -1/2), stretched by s >= 1 source samples if the grid is coarser than the source, and normalised. At s = 1
// it passes through the samples; stretched, it averages over the grid's spacing. Internal to the library.
//
// Sums run in four lanes, lane k over taps k, k + 4, ..., in ascending order, so that a value depends only on
// its own taps and weights. Pure functions, any thread.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>

#include "planet/base/cpu_clones.h"

namespace planet {

using Float4 = float __attribute__((vector_size(16)));

PLANET_ALWAYS_INLINE Float4 loadFloat4(const float* from) {
    Float4 v;
    std::memcpy(&v, from, sizeof(v));
    return v;
}

PLANET_ALWAYS_INLINE void storeFloat4(float* to, Float4 v) {
    std::memcpy(to, &v, sizeof(v));
}

PLANET_ALWAYS_INLINE float sumOfLanes(Float4 v) {
    return (v[0] + v[2]) + (v[1] + v[3]);
}

// The weights of four taps at a fraction t, [0, 1], between the second and the third one:
// ((cubic t + square) t + linear) t + constant.
struct CatmullRomWeights {
    static constexpr Float4 cubic{-0.5f, 1.5f, -1.5f, 0.5f};
    static constexpr Float4 square{1.0f, -2.5f, 2.0f, -0.5f};
    static constexpr Float4 linear{-0.5f, 0.0f, 0.5f, 0.0f};
    static constexpr Float4 constant{0.0f, 1.0f, 0.0f, 0.0f};
};
PLANET_ALWAYS_INLINE Float4 catmullRomWeights(float t) {
    using W = CatmullRomWeights;
    return ((W::cubic * t + W::square) * t + W::linear) * t + W::constant;
}

// Returns the weights at four distances from the sample.
PLANET_ALWAYS_INLINE Float4 catmullRom(Float4 distance) {
    const Float4 d = distance < 0 ? -distance : distance;
    const Float4 near = (1.5f * d - 2.5f) * d * d + 1;
    const Float4 far = ((-0.5f * d + 2.5f) * d - 4) * d + 2;
    return d >= 2 ? Float4{} : d < 1 ? near : far;
}

// Returns the number of taps of a kernel stretched by s, in whole groups of four. Taps beyond its support
// have weight 0.
PLANET_ALWAYS_INLINE int tapCount(float stretch) {
    return 4 * static_cast<int>(std::ceil(stretch));
}

// Computes the weights of taps 0, 1, ... for a sample that lies `position` taps after tap 0. Their sum is 1. The taps
// come in groups of four.
PLANET_ALWAYS_INLINE void stretchedWeights(float position, float stretch, std::span<float> weights) {
    assert(weights.size() % 4 == 0);
    const float perTap = 1 / stretch;
    for (std::size_t k = 0; k < weights.size(); k += 4) {
        const Float4 taps = static_cast<float>(k) + Float4{0, 1, 2, 3};
        storeFloat4(&weights[k], catmullRom((taps - position) * perTap));
    }
    float sum = 0;
    for (const float weight : weights) sum += weight;
    for (std::size_t k = 0; k < weights.size(); k += 4)
        storeFloat4(&weights[k], loadFloat4(&weights[k]) / sum);
}

PLANET_ALWAYS_INLINE void kernelWeights(float position, float stretch, std::span<float> weights) {
    if (stretch == 1) {
        storeFloat4(weights.data(), catmullRomWeights(position - 1));
    } else {
        stretchedWeights(position, stretch, weights);
    }
}

}  // namespace planet
