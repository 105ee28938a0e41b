// Names for files that a user saves without being asked for a name. Nothing is ever overwritten. Any thread.
#pragma once

#include <ctime>
#include <filesystem>
#include <string_view>

#include "planet/base/result.h"

namespace worldy {

// Creates an empty file in an existing folder and returns its path, "worldy 2026-11-26 16.40.12 NAME.EXTENSION" by the
// time, with a number if there is such a file already. name may be empty. The Error says why no file can be created.
planet::Result<std::filesystem::path> newTimedFile(const std::filesystem::path& folder,
                                                   const std::tm& localTime, std::string_view name,
                                                   std::string_view extension);

// Creates an empty folder in the same way.
planet::Result<std::filesystem::path> newTimedFolder(const std::filesystem::path& folder,
                                                     const std::tm& localTime, std::string_view name);

// Writes text atomically into a new file of the current time. Returns the file.
planet::Result<std::filesystem::path> writeNewTextFile(const std::filesystem::path& folder,
                                                       std::string_view name, std::string_view extension,
                                                       std::string_view text);

std::tm localTimeNow();

}  // namespace worldy
