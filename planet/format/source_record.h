// What a chunk file was baked from, so that a later bake can tell which chunks would come out the same
// (bake_reuse.h). The record is the last part of a file; README.md in this folder has its bytes. Pure
// functions, any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/base/result.h"

namespace planet {

// A part of a source of heights, and where it has influence: a cap of the unit sphere.
struct SourcePart {
    std::uint64_t signature = 0;  // a hash of everything that its heights depend on
    glm::dvec3 centre{1, 0, 0};   // unit
    double radiusRad = 0;         // [0, pi]; pi: the whole planet

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
inline constexpr std::size_t mostSourceRecordBytes = 36 + 40 * mostSourceParts;

std::vector<std::byte> sourceRecordBytes(const SourceRecord& record);

// Returns the number of bytes before the tail. The Error does not name the file.
Result<std::size_t> sourceRecordLength(std::span<const std::byte, sourceRecordTailBytes> tail);

// Decodes a record with its tail. The Error does not name the file.
Result<SourceRecord> sourceRecordFrom(std::span<const std::byte> bytes);

}  // namespace planet
