// Finds files that are built and installed with a program.
#pragma once

#include <filesystem>

namespace planet {

// Returns the path of a file that is installed with the running program, in lib/worldy/, or else the path that it has
// beside the program, where it is built. The file need not exist.
std::filesystem::path installedFile(const char* name);

}  // namespace planet
