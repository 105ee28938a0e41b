// Records what a chunk file was baked from, so that a later bake can tell which chunks would come out the same
// (bake_reuse.h). The record is the last part of a file; README.md in this folder has its bytes. Pure
// functions, any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "planet/base/result.h"

namespace planet {

// The samples of a source in a radian. Heights do not depend on the grid of the filter where it is finer than they are.
struct SampleDensities {
    double alongPerRad = std::numeric_limits<double>::infinity();  // in any direction; infinite: unknown
    // Along the equator, of samples whose columns follow the meridians and come closer towards the poles; else 0.
    double aroundPerRad = 0;

    bool operator==(const SampleDensities&) const = default;
};

// A part of a source of heights, and where it has influence: a cap of the unit sphere.
struct SourcePart {
    std::uint64_t signature =
        0;  // a hash of everything that its heights depend on, but the grid of the filter
    glm::dvec3 centre{1, 0, 0};  // unit
    double radiusRad = 0;        // [0, pi]; pi: the whole planet
    SampleDensities densities{};

    bool operator==(const SourcePart&) const = default;
};

struct SourceRecord {
    std::uint64_t settings =
        0;            // a hash of the program's way to bake, and of the settings that chunks depend on
    double minM = 0;  // HeightSource::minM and maxM, to which all heights are clamped
    double maxM = 0;
    std::vector<SourcePart> parts;  // in the order in which they are joined; at most mostSourceParts
    std::uint64_t colours = 0;      // a hash of what the colours depend on; 0 without colours

    bool operator==(const SourceRecord&) const = default;
};

inline constexpr std::size_t mostSourceParts = 1u << 16;

// The record ends in its length and a checksum.
inline constexpr std::size_t sourceRecordTailBytes = 12;
inline constexpr std::size_t mostSourceRecordBytes = 36 + 56 * mostSourceParts;

std::vector<std::byte> sourceRecordBytes(const SourceRecord& record);

// Returns the number of bytes before the tail. The Error does not name the file.
Result<std::size_t> sourceRecordLength(std::span<const std::byte, sourceRecordTailBytes> tail);

// Decodes a record with its tail. The Error does not name the file.
Result<SourceRecord> sourceRecordFrom(std::span<const std::byte> bytes);

}  // namespace planet
