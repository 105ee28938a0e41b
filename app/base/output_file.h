// Reads and writes text files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "planet/base/result.h"

namespace worldy {

// Replaces the file atomically (planet/base/atomic_file.h), so a killed program leaves the old file intact.
planet::Result<void> writeTextFile(const std::filesystem::path& target, std::string_view text);

// Returns at most the first `bytes` bytes of a regular file, or an empty string if it cannot be read. A pipe
// is not opened, because that would wait for its writer.
std::string startOfFile(const std::filesystem::path& file, std::size_t bytes);

}  // namespace worldy
