// Writes the files of a suggestion: NAME.toml, NAME.regions.toml, NAME.md and NAME.png.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/suggest/suggest_page.h"
#include "app/suggest/suggest_run.h"
#include "planet/base/result.h"

namespace worldy {

struct SuggestFiles {
    std::filesystem::path preset, regions, report, page;
};
SuggestFiles suggestFilesIn(const std::filesystem::path& folder, const std::string& name);

// Returns the content of the page.
SuggestPage suggestPageOf(const SuggestOutcome& outcome, const SuggestRequest& request);

// Writes each file atomically, the report last, so that whoever finds it finds the others. Makes the folder. Without
// suggested regions, no regions file is written, and that of an earlier suggestion is removed; one without the names of
// suggested regions stays, because it may be the user's own. Reads the preset and the regions again, which must be what was measured. Returns the files that were written.
planet::Result<std::vector<std::filesystem::path>> writeSuggestion(const SuggestOutcome& outcome,
                                                                   const SuggestRequest& request,
                                                                   const std::filesystem::path& folder,
                                                                   const std::string& name);

}  // namespace worldy
