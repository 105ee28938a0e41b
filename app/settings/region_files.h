// The regions files of the planets that were shown, as they are on disk, and the regions that are not saved yet. A file that
// cannot be read is never overwritten, and neither are changes by another program or comments unless the user agrees. One
// thread.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/tree/region.h"

namespace worldy {

// A regions file as it was read or written last.
struct RegionsOnDisk {
    std::string text{};  // empty if there was no file
    std::shared_ptr<const std::vector<planet::Region>> list{};
    std::string
        problem{};  // why it cannot be read, with the line and what is right; empty: it can, or is missing
};

struct RegionFiles {
    std::filesystem::path planet{};  // the source of the shown planet; empty: none was shown yet
    std::filesystem::path beside{};  // the regions file beside it, which need not exist
    RegionSettings shown{};          // of that planet, when it was followed last
    std::map<std::filesystem::path, RegionsOnDisk> known{};
    std::map<std::filesystem::path, RegionSettings> unsaved{};  // of other planets, by their sources
    std::string question{};  // that the user must answer before the regions are saved; empty: none
    std::vector<std::string>
        quitQuestion{};  // files whose changes the user would lose by quitting; empty: not asked
};

// Tells how an attempt to save regions ended.
struct RegionsSave {
    std::filesystem::path file{};  // that was written; empty: nothing was, because the user must be asked
    std::string question{};        // says what saving would destroy
    std::string problem{};         // why another file than the one asked for was written; empty: it was not
};

// Reads the regions of a file and remembers what it holds. A missing file beside a planet has none.
planet::Result<RegionSettings> readRegions(RegionFiles& files, const std::filesystem::path& file);
// Remembers what a file holds, of which the regions were read elsewhere.
void noteRead(RegionFiles& files, const RegionSettings& regions);

// Returns the second file beside a regions file, "earth.session.regions.toml", if it exists, or else an empty path.
std::filesystem::path secondRegionsFile(const std::filesystem::path& file);

// Returns the file that the regions are saved in: the one they were read from, or else the one beside the planet.
std::filesystem::path fileOf(const RegionFiles& files, const RegionSettings& regions);
// Returns whether the regions are those of their file.
bool areSaved(const RegionFiles& files, const RegionSettings& regions);

// Saves regions in a file. If it cannot be read, it stays as it is, and they are saved in
// "earth.session.regions.toml" beside it. replaces: the user agrees to lose comments, and changes by another program.
planet::Result<RegionsSave> saveRegionsIn(RegionFiles& files, const RegionSettings& regions,
                                          const std::filesystem::path& file, bool replaces);

// Returns the names of the regions files that quitting would leave behind changes. current: the regions in use.
std::vector<std::string> unsavedRegions(const RegionFiles& files, const RegionSettings& current);
// Saves all unsaved regions. The Error says which file needs an answer of the user, or cannot be written.
planet::Result<void> saveAllRegions(RegionFiles& files, const RegionSettings& current);

// Returns whether a TOML text, which is valid, holds a comment other than the first line of a file that Worldy wrote.
bool hasOwnComments(std::string_view text);

}  // namespace worldy
