// Writing files so that a killed program leaves the old one whole: under a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "planet/result.h"

namespace worldy {

// Calls write with a name beside the target that has the same extension; removes it on any Error.
planet::Result<void> writeAtomically(
    const std::filesystem::path& target,
    const std::function<planet::Result<void>(const std::filesystem::path& temporary)>& write);

planet::Result<void> writeTextFile(const std::filesystem::path& target, std::string_view text);

}  // namespace worldy
