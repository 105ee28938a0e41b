// Surveys a planet into an atlas (planet/measure/atlas.h), for the command atlas and for the window. Draws nothing.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/camera_text.h"
#include "app/settings/setting_difference.h"
#include "app/settings/view_settings.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_run.h"
#include "planet/paging/disk_simulator.h"

namespace worldy {

struct AtlasRequest {
    std::filesystem::path file;      // the chunk file
    std::filesystem::path output{};  // the atlas; empty: it is kept in memory alone
    ViewSettings view;               // with the simulated disk in paging.badDisk
    PictureSize size;
    planet::AtlasGrid grid;
    bool measuresError = false;
    bool recordsTree = true;
    bool resumes = false;  // continues the unfinished survey of the output
    std::size_t threads = 1;
    // The atlas whose viewpoints are surveyed again, with its picture size, field of view and grid instead of those above.
    std::shared_ptr<const planet::Atlas> revisited{};
};

struct AtlasOutcome {
    planet::Atlas atlas;
    planet::AtlasRun run;
    double treeS = 0;  // for reading the tree
};

// Gives a disk that is not slowed a latency of 5 ms and 100 MB/s, because the time until a picture is sharp says little
// about an immediate disk.
void setUsualDisk(planet::BadDiskSettings& disk);

// Called a few times per second, from any thread, one call at a time. While the tree is read, there is no progress yet.
// Returning false cancels.
using WatchAtlas = std::function<bool(const std::optional<planet::AtlasProgress>&)>;

// Surveys a planet. A cancelled survey leaves its unfinished file, and so does a killed one. The Error names the file and
// the problem: a survey is continued only with the same bake and settings.
planet::Result<AtlasOutcome> surveyAtlas(const AtlasRequest& request, const WatchAtlas& goOn);

// Returns the view settings of an atlas with its regions. The Error names what its text has wrong.
planet::Result<ViewSettings> settingsOf(const planet::AtlasSurvey& survey, const std::string& name);
// Returns them with other regions: those of now, because they belong to the planet and not to the view.
planet::Result<ViewSettings> settingsOf(const planet::AtlasSurvey& survey, const std::string& name,
                                        const RegionSettings& regions);

// Returns what differs between the settings of two surveys and can change what is measured: "regions" stands for their
// regions, by name, and overlays are left out. An unreadable text counts as that of the defaults.
std::vector<SettingDifference> differencesOf(const planet::AtlasSurvey& before,
                                             const planet::AtlasSurvey& now);

// Returns the request that continues an unfinished survey: with its settings, picture, viewpoints and measures. regions:
// those of now; surveyAtlas refuses others than those of the survey. The Error names what the file's text has wrong, or
// says that a revisit needs the atlas whose viewpoints it surveys.
planet::Result<AtlasRequest> requestToResume(const planet::Atlas& unfinished,
                                             const std::filesystem::path& output,
                                             const std::filesystem::path& chunkFile,
                                             const RegionSettings& regions,
                                             std::shared_ptr<const planet::Atlas> revisited);

}  // namespace worldy
