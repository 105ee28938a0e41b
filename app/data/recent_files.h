// The files opened last, kept between sessions: one absolute path a line, newest first.
#pragma once

#include <filesystem>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

inline constexpr std::size_t maxRecentFiles = 10;

// recent.txt in the config folder.
std::filesystem::path recentFilesFile();

// What is no absolute path in the file is left out, and so is what is over its first 64 KiB; empty where
// there is no file.
std::vector<std::filesystem::path> loadRecentFiles(const std::filesystem::path& file);

// Puts a path first, made absolute and without "..", and nowhere else.
void addRecentFile(std::vector<std::filesystem::path>& recent, const std::filesystem::path& opened);

// Those that are there now; one on a disk that is away comes back with it. For cube faces named by their
// common stem, one of the faces counts.
std::vector<std::filesystem::path> shownRecentFiles(const std::vector<std::filesystem::path>& recent);

// Paths with a line break in them are left out. Makes the file's folder.
planet::Result<void> saveRecentFiles(const std::vector<std::filesystem::path>& recent,
                                     const std::filesystem::path& file);

}  // namespace worldy
