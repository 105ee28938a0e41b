// Other formats for a square of heights, which the chunk file is compared with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

struct HeightSquare {
    int side = 0;                     // samples
    std::vector<std::int16_t> steps;  // side * side, row-major
};

enum class SquareFormat : std::uint8_t { Zstd, ShuffledDeltas, Png, Jpeg2000, JpegXl };
// Returns the name of a format in reports.
std::string nameOf(SquareFormat format);

struct StoredSquare {
    std::size_t bytes = 0;               // 0: another program could not store it
    std::vector<double> decodingCpuS{};  // of each round; of another program, its start included
    std::string problem{};               // why there are no bytes: "cjxl is not installed", or what it said
};

// Stores a square without loss, decodes it once to compare it, and then again in a number of rounds. PNG is written by
// OpenImageIO, JPEG 2000 by opj_compress or gdal_translate, JPEG XL by cjxl (-d 0 -e 7). folder: for temporary files. The
// Error says what cannot be written or decoded, or that the decoded samples are not those of the square.
planet::Result<StoredSquare> storeSquare(SquareFormat format, const HeightSquare& square,
                                         const std::filesystem::path& folder, int decodingRounds);

// Returns the time in seconds that this thread has run, or the processes that this program started and waited for.
double threadCpuS();
double childrenCpuS();

}  // namespace worldy
