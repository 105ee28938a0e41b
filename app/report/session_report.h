// The session report: what was looked at and measured, for a person who did not run the program. One Markdown file and
// pictures in a new folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "app/settings/settings.h"
#include "planet/format/chunk_file.h"
#include "ui/model/editor_view.h"

namespace worldy {

// The data of a report that no panel has.
struct ReportFacts {
    std::string writtenAt;                     // "2026-11-26 17:05"
    std::string version;                       // of Worldy
    std::string openGl;                        // "OpenGL 4.5, llvmpipe"
    std::string commandLine;                   // draws the view again
    std::vector<std::string> usedBookmarks{};  // names, in the order of their first use
    const planet::ChunkFile* file = nullptr;   // null: the planet has none
};

// Returns the report as Markdown. view.planet must be set. The figures are those of the panels; a measurement that was
// not made is "not measured", and one of another view or other settings says so.
std::string sessionReport(const ui::EditorView& view, const Settings& settings, const ReportFacts& facts);

// Writes the report and its pictures into a new folder and returns the folder. planet: the view without panels; empty if
// there is none. On an Error nothing is left.
planet::Result<std::filesystem::path> writeSessionReport(const std::filesystem::path& folder,
                                                         const std::string& report, const Picture& planet,
                                                         const Picture& window);

}  // namespace worldy
