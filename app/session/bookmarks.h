// Bookmarked views: some come with Worldy, the user's own are in a TOML file.
//
//     [[bookmark]]
//     name = "Mont Blanc from the north"
//     latitude_deg = 46.4
//     longitude_deg = 6.9
//     altitude_m = 6000      # above the planet's radius
//     heading_deg = 180
//     pitch_deg = -10
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "planet/base/result.h"
#include "ui/model/editor_view.h"

namespace worldy {

struct Bookmarks {
    std::filesystem::path file;      // the file of the user's own
    std::vector<ui::Bookmark> list;  // shipped ones first
    // Why the file could not be read, in which case it is never overwritten. Empty: no problem.
    std::string problem;
};

// Returns configFolder()/bookmarks.toml.
std::filesystem::path bookmarksFile();

// Reads the bookmarks. If the file is bad, returns only the shipped ones, and Bookmarks::problem names the
// file, the line and what is expected. A missing file is no problem.
Bookmarks loadBookmarks(const std::filesystem::path& file);

// Adds a bookmark, or replaces the user's own of the same name, and writes the file. The Error says what is
// wrong with the name or the file; then nothing has changed.
planet::Result<void> addBookmark(Bookmarks& bookmarks, std::string_view name, const planet::CameraPose& pose);

// Removes one of the user's own and writes the file. On an Error nothing has changed.
planet::Result<void> removeBookmark(Bookmarks& bookmarks, std::string_view name);

}  // namespace worldy
