#include "planet/format/source_record.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"

namespace planet {

namespace {

constexpr std::size_t recordHeadBytes = 36;  // three hashes or numbers of 8 bytes, the colours and the count
constexpr std::size_t partBytes = 56;

bool isCap(const SourcePart& part) {
    return std::abs(glm::length(part.centre) - 1) < 1e-6 && part.radiusRad >= 0 &&
           part.radiusRad <= std::numbers::pi;  // false for NaN
}

}  // namespace

std::vector<std::byte> sourceRecordBytes(const SourceRecord& record) {
    assert(record.parts.size() <= mostSourceParts);
    std::vector<std::byte> bytes;
    ByteWriter out(bytes);
    out.put(record.settings);
    out.put(record.minM);
    out.put(record.maxM);
    out.put(record.colours);
    out.put(static_cast<std::uint32_t>(record.parts.size()));
    for (const SourcePart& part : record.parts) {
        out.put(part.signature);
        for (int axis = 0; axis < 3; ++axis) out.put(part.centre[axis]);
        out.put(part.radiusRad);
        out.put(part.densities.alongPerRad);
        out.put(part.densities.aroundPerRad);
    }
    out.put(static_cast<std::uint32_t>(bytes.size()));
    out.put(sourceRecordChecksum(bytes));
    return bytes;
}

Result<std::size_t> sourceRecordLength(std::span<const std::byte, sourceRecordTailBytes> tail) {
    const auto length = readLittleEndian<std::uint32_t>(tail.data());
    if (length >= recordHeadBytes && length <= mostSourceRecordBytes &&
        (length - recordHeadBytes) % partBytes == 0) {
        return length;
    }
    return badInput(
        fmt::format("its record of its source has {} bytes; expected {} and a multiple of {}, at most {}",
                    length, recordHeadBytes, partBytes, mostSourceRecordBytes));
}

Result<SourceRecord> sourceRecordFrom(std::span<const std::byte> bytes) {
    if (bytes.size() < sourceRecordTailBytes) return badInput("its record of its source is truncated");
    const auto tail = bytes.last<sourceRecordTailBytes>();
    TRY_ASSIGN(const auto length, sourceRecordLength(tail));
    const bool isWhole = length + sourceRecordTailBytes == bytes.size();
    if (!isWhole || readLittleEndian<std::uint64_t>(tail.data() + 4) !=
                        sourceRecordChecksum(bytes.first(bytes.size() - 8)))
        return badInput("its record of its source is damaged: its checksum does not match");
    ByteReader in(bytes);
    SourceRecord record;
    record.settings = in.get<std::uint64_t>();
    record.minM = in.get<double>();
    record.maxM = in.get<double>();
    record.colours = in.get<std::uint64_t>();
    const auto parts = in.get<std::uint32_t>();
    if (!(std::isfinite(record.minM) && std::isfinite(record.maxM)) ||
        parts != (length - recordHeadBytes) / partBytes) {
        return badInput("its record of its source is inconsistent");
    }
    record.parts.resize(parts);
    for (SourcePart& part : record.parts) {
        part.signature = in.get<std::uint64_t>();
        for (int axis = 0; axis < 3; ++axis) part.centre[axis] = in.get<double>();
        part.radiusRad = in.get<double>();
        part.densities.alongPerRad = in.get<double>();
        part.densities.aroundPerRad = in.get<double>();
        if (!isCap(part) || !(part.densities.alongPerRad >= 0 && part.densities.aroundPerRad >= 0))
            return badInput("its record of its source has a part that is not on the planet");
    }
    return record;
}

}  // namespace planet
