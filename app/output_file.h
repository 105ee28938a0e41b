// Writing files so that a killed program leaves the old one whole: under a temporary name, synced, then
// renamed. What it leaves beside it is written over, and gone, with the next.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "planet/result.h"

namespace worldy {

// For libraries that write files by their names: calls write with a name beside the target that has the same
// extension, and takes over what is there then. One writer a target at a time: a second one gets an Error.
planet::Result<void> writeAtomically(
    const std::filesystem::path& target,
    const std::function<planet::Result<void>(const std::filesystem::path& temporary)>& write);

planet::Result<void> writeTextFile(const std::filesystem::path& target, std::string_view text);

}  // namespace worldy
