// Writing texts so that a killed program leaves the old file whole (planet/base/atomic_file.h).
#pragma once

#include <filesystem>
#include <string_view>

#include "planet/base/result.h"

namespace worldy {

planet::Result<void> writeTextFile(const std::filesystem::path& target, std::string_view text);

}  // namespace worldy
