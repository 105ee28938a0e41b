// The sizes of rasters that are read. Internal to the library.
#pragma once

#include <algorithm>
#include <cstdint>

namespace planet {

constexpr int mostRasterSide = 1 << 22;  // samples
// A survey reads every sample. More, in a header that lies, would keep it busy for hours.
constexpr std::int64_t mostRasterSamples = std::int64_t{1} << 38;
// No compression of real heights stores more samples in a byte. A file of so many samples is read for hours otherwise.
constexpr std::int64_t mostSamplesPerByte = 10'000;
constexpr std::int64_t alwaysRead = std::int64_t{1} << 32;  // samples

// Returns how many samples are read of a raster whose files have so many bytes.
constexpr std::int64_t mostSamplesIn(std::int64_t bytes) {
    return std::max(alwaysRead, bytes * mostSamplesPerByte);
}

}  // namespace planet
