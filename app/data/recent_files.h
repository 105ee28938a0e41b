// The recently opened files, kept between sessions: one absolute path per line, newest first.
#pragma once

#include <filesystem>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

inline constexpr std::size_t maxRecentFiles = 10;

// Returns recent.txt in the config folder.
std::filesystem::path recentFilesFile();

// Loads the absolute paths in the first 64 KiB of a file; other lines are ignored. Empty if there is no file.
std::vector<std::filesystem::path> loadRecentFiles(const std::filesystem::path& file);

// Moves a path to the front, made absolute and without "..".
void addRecentFile(std::vector<std::filesystem::path>& recent, const std::filesystem::path& opened);

// Returns the files that exist now; one on a removed disk reappears with the disk. For cube faces named by
// their common stem, one existing face suffices.
std::vector<std::filesystem::path> shownRecentFiles(const std::vector<std::filesystem::path>& recent);

// Saves all paths without a line break in them. Creates the folder of the file.
planet::Result<void> saveRecentFiles(const std::vector<std::filesystem::path>& recent,
                                     const std::filesystem::path& file);

}  // namespace worldy
