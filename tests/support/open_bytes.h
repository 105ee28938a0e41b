// Opens a chunk file in memory, such as one that a test has damaged.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "planet/format/chunk_file.h"

namespace planet::test {

// The file is called "test.chk". The bytes must outlive it.
inline Result<ChunkFile> openBytes(std::span<const std::byte> bytes) {
    return ChunkFile::open(
        "test.chk", bytes.size(), [bytes](std::uint64_t offset, std::span<std::byte> out) -> Result<void> {
            if (offset + out.size() > bytes.size())
                return ioError("read beyond the end");  // the reader must never ask
            std::ranges::copy(bytes.subspan(static_cast<std::size_t>(offset), out.size()), out.begin());
            return {};
        });
}

}  // namespace planet::test
