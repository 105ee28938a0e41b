// The noise of RenderSettings::detail, which fills in between the samples of the data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

inline constexpr int detailNoiseSize = 64;  // texels per side
inline constexpr std::size_t detailNoiseBytes =
    std::size_t{4} * (detailNoiseSize * detailNoiseSize * detailNoiseSize * 8 - 1) / 7;  // including mipmaps

// Returns ridged gradient noise (Perlin, "Improving noise", 2002) on a torus, x fastest. Three channels hold
// the noise's slope, in units of half the noise's range per whole side, and the fourth its height. 128 stands
// for 0, the mean of each channel. Computed at the first call and cached. Thread-safe.
const std::vector<std::uint8_t>& detailNoise();

// Returns the noise as a 3-D texture. Its mipmaps end at 0, so detail finer than a pixel disappears.
Texture detailNoiseTexture();

}  // namespace planet::gl
