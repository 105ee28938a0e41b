// The settings of a bake (bake.h, colour_bake.h), as plain data.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "planet/base/file_calls.h"
#include "planet/format/colour_tile.h"
#include "planet/format/height_codec.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// The numbers of vertices along a chunk's side that a bake accepts.
inline constexpr std::array<int, 4> chunkSizes = {17, 33, 65, 129};

struct ColourBakeSettings {
    std::optional<int> faceSize{};  // texels a side, 256 * 2^n + 1; none: the source's natural size
    ColourFormat format = ColourFormat::Bc1;
    bool operator==(const ColourBakeSettings&) const = default;
};

struct BakeSettings {
    std::optional<int> faceSize{};  // samples a side, 2^n + 1; none: the source's natural size
    int chunkSize = 33;             // vertices a side: 17, 33, 65 or 129
    double radiusM = earthRadiusM;  // (0, 1e9]
    std::optional<double>
        quantumM{};   // none: the source's step, or for floats the finest that holds its range
    int threads = 0;  // 0: one per core
    int compressionLevel = defaultCompressionLevel;
    // The bake also writes each level of each face to this folder, as a 16-bit PNG; empty: it does not.
    std::filesystem::path debugLevelsFolder{};
    // The number of levels above the finest that one task bakes, [0, 10]. None: enough for squares of 128
    // cells, at least one. Neighbouring squares then sample little twice, and a square fits a core's cache.
    // The chunks do not depend on it; the order of their blocks may.
    std::optional<int> tileLevels{};
    ColourBakeSettings colour{};              // used with a colour source
    FileCalls fileCalls = systemFileCalls();  // they write the output
};

}  // namespace planet
