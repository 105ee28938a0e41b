// The noise that RenderSettings::detail draws between the samples there are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

inline constexpr int detailNoiseSize = 64;  // texels a side
inline constexpr std::size_t detailNoiseBytes =
    std::size_t{4} * (detailNoiseSize * detailNoiseSize * detailNoiseSize * 8 - 1) / 7;  // with mipmaps

// Ridged gradient noise (Perlin, "Improving noise", 2002) on a torus, x fastest: three channels of its slope,
// noise units of half the range in one whole side, and one of its height; 128 is 0 and each channel's mean.
// Made at the first call, and kept. Any thread.
const std::vector<std::uint8_t>& detailNoise();

// The same as a 3-D texture with mipmaps, which end at 0: what is finer than a pixel is gone.
Texture detailNoiseTexture();

}  // namespace planet::gl
