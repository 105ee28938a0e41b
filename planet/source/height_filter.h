// The filter of the height sources: the Catmull-Rom cubic (Catmull and Rom 1974; the Keys kernel with a =
// -1/2), stretched by s >= 1 source samples if the grid is coarser than the source, and normalised. At s = 1
// it passes through the samples; stretched, it averages over the grid's spacing. Internal to the library.
//
// Sums run in four lanes, lane k over taps k, k + 4, ..., in ascending order, so that a value depends only on
// its own taps and weights. Pure functions, any thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>

namespace planet {

using Float4 = float __attribute__((vector_size(16)));

inline Float4 loadFloat4(const float* from) {
    Float4 v;
    std::memcpy(&v, from, sizeof(v));
    return v;
}

inline void storeFloat4(float* to, Float4 v) {
    std::memcpy(to, &v, sizeof(v));
}

inline float sumOfLanes(Float4 v) {
    return (v[0] + v[2]) + (v[1] + v[3]);
}

// Returns the four weights at a fraction t, [0, 1], between the second and the third tap.
inline Float4 catmullRomWeights(float t) {
    constexpr Float4 cubic{-0.5f, 1.5f, -1.5f, 0.5f};
    constexpr Float4 square{1.0f, -2.5f, 2.0f, -0.5f};
    constexpr Float4 linear{-0.5f, 0.0f, 0.5f, 0.0f};
    constexpr Float4 constant{0.0f, 1.0f, 0.0f, 0.0f};
    return ((cubic * t + square) * t + linear) * t + constant;
}

inline float catmullRom(float distance) {
    const float d = std::abs(distance);
    if (d >= 2) return 0;
    return d < 1 ? (1.5f * d - 2.5f) * d * d + 1 : ((-0.5f * d + 2.5f) * d - 4) * d + 2;
}

// Returns the number of taps of a kernel stretched by s, in whole groups of four. Taps beyond its support
// have weight 0.
inline int tapCount(float stretch) {
    return 4 * static_cast<int>(std::ceil(stretch));
}

// Computes the weights of taps 0, 1, ... for a sample that lies `position` taps after tap 0. Their sum is 1.
inline void stretchedWeights(float position, float stretch, std::span<float> weights) {
    const float perTap = 1 / stretch;
    float sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        weights[k] = catmullRom((static_cast<float>(k) - position) * perTap);
        sum += weights[k];
    }
    for (float& weight : weights) weight /= sum;
}

inline void kernelWeights(float position, float stretch, std::span<float> weights) {
    if (stretch == 1) {
        storeFloat4(weights.data(), catmullRomWeights(position - 1));
    } else {
        stretchedWeights(position, stretch, weights);
    }
}

}  // namespace planet
