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

// The accepted numbers of vertices along a chunk's side.
inline constexpr std::array<int, 4> chunkSizes = {17, 33, 65, 129};

struct ColourBakeSettings {
    std::optional<int> faceSize{};  // texels per side, 256 * 2^n + 1; unset: the source's natural size
    ColourFormat format = ColourFormat::Bc1;
    bool operator==(const ColourBakeSettings&) const = default;
};

struct BakeSettings {
    std::optional<int> faceSize{};  // samples per side, 2^n + 1; unset: the source's natural size
    int chunkSize = 33;             // vertices per side: 17, 33, 65 or 129
    double radiusM = earthRadiusM;  // [leastRadiusM, mostRadiusM]
    std::optional<double>
        quantumM{};  // unset: the source's step, or for floats the finest that holds its range
    // The quantum, metres, that heights of finer parts of the source may have at the finest, as a power-of-two fraction of
    // the file's. Unset: as fine as they need, but the file's if quantumM is set.
    std::optional<double> finestQuantumM{};
    int threads = 0;  // 0: one per core
    int compressionLevel = defaultCompressionLevel;
    // Folder to write each level of each face to that has chunks everywhere, as 16-bit PNGs; empty: none.
    std::filesystem::path debugLevelsFolder{};
    // The number of levels above its leaves that one task bakes, [0, 10]. Unset: as needed for squares of 128
    // cells, at least one. Then neighbouring squares sample little twice, and a square fits a core's cache.
    // The chunks do not depend on it; the order of their blocks may.
    std::optional<int> tileLevels{};
    // An earlier bake, from which what the source has left unchanged is copied (bake_reuse.h); it may be the
    // output itself. Empty, without a record of its source or baked with other settings: all is baked.
    std::filesystem::path reuse{};
    ColourBakeSettings colour{};              // used with a colour source
    FileCalls fileCalls = systemFileCalls();  // for writing the output
};

}  // namespace planet
