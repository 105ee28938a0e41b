// Places worth coming back to: some that come with Worldy, and the user's own in a TOML file.
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
    std::filesystem::path file;      // of the user's own
    std::vector<ui::Bookmark> list;  // shipped ones first
    // Why the file could not be read; it is then never written over. Empty: all is well.
    std::string problem;
};

// configFolder()/bookmarks.toml.
std::filesystem::path bookmarksFile();

// The shipped ones alone where the file is bad, and then Bookmarks::problem names the file, the line and what
// would be right. No file is no problem.
Bookmarks loadBookmarks(const std::filesystem::path& file);

// Adds one, or replaces the user's own of the same name, and writes the file. The Error says what is wrong
// with the name, or with the file; then nothing has changed.
planet::Result<void> addBookmark(Bookmarks& bookmarks, std::string_view name, const planet::CameraPose& pose);

// One of the user's own; the same holds.
planet::Result<void> removeBookmark(Bookmarks& bookmarks, std::string_view name);

}  // namespace worldy
