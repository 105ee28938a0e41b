#include "app/settings/region_files.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "app/base/output_file.h"
#include "app/settings/region_file.h"
#include "planet/base/try.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;
using RegionList = std::shared_ptr<const std::vector<planet::Region>>;

constexpr std::size_t mostRegionsBytes = 8u << 20;  // the regions of a planet take less than 4 MiB
constexpr int mostSecondFiles = 100;

bool isOnDisk(const fs::path& file) {
    std::error_code status;
    return fs::exists(file, status) || fs::is_symlink(fs::symlink_status(file, status));
}

RegionsOnDisk onDisk(const fs::path& file) {
    if (!isOnDisk(file)) return {};
    RegionsOnDisk found{.text = startOfFile(file, mostRegionsBytes)};
    Result<std::vector<planet::Region>> regions = loadRegions(file);
    if (regions)
        found.list = std::make_shared<const std::vector<planet::Region>>(std::move(*regions));
    else
        found.problem = regions.error().message;
    return found;
}

bool areSame(const RegionList& a, const RegionList& b) {
    return a == b || RegionSettings{.list = a}.all() == RegionSettings{.list = b}.all();
}

// Returns "earth.session.regions.toml" for "earth.regions.toml", or "earth.session-2.regions.toml", ...
fs::path secondFile(const fs::path& file, int number) {
    std::string name = file.filename().string();
    if (isRegionsFile(file))
        name.resize(name.size() - regionsFileEnding.size());
    else
        name = file.stem().string();
    name += number == 1 ? ".session" : fmt::format(".session-{}", number);
    return file.parent_path() / (name + std::string(regionsFileEnding));
}

// Chooses the second file: one that holds what this program wrote there, or the first name that is free.
Result<fs::path> secondFileFor(const RegionFiles& files, const fs::path& file) {
    for (int number = 1; number <= mostSecondFiles; ++number) {
        const fs::path path = secondFile(file, number);
        if (!isOnDisk(path)) return path;
        const auto known = files.known.find(path);
        if (known != files.known.end() && known->second.problem.empty() &&
            known->second.text == startOfFile(path, mostRegionsBytes))
            return path;
    }
    return planet::badInput(
        fmt::format("{}: exists; expected to find a free name", secondFile(file, mostSecondFiles).string()));
}

// Returns what replacing a file that can be read would destroy; empty if nothing.
std::string lossOf(const fs::path& file, const RegionsOnDisk& now, const RegionsOnDisk& known) {
    const std::string name = file.filename().string();
    if (now.text != known.text) {
        return fmt::format("{} was {} by another program. Saving replaces it.", name,
                           known.text.empty() ? "written" : "changed");
    }
    return hasOwnComments(now.text) ? fmt::format("{} has comments. Saving removes them.", name)
                                    : std::string();
}

}  // namespace

bool hasOwnComments(std::string_view text) {
    if (text.starts_with(regionsFileHead)) text.remove_prefix(regionsFileHead.size());
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char letter = text[at];
        if (letter == '#') return true;
        if (letter != '"' && letter != '\'') continue;
        const std::string three(3, letter);
        const bool isLong = text.substr(at, 3) == three;
        const std::string_view end = isLong ? std::string_view(three) : text.substr(at, 1);
        for (at += end.size(); at < text.size() && text.substr(at, end.size()) != end; ++at)
            if (letter == '"' && text[at] == '\\') ++at;
        at += end.size() - 1;
        // A long string may end with quotes of its own.
        while (isLong && at + 1 < text.size() && text[at + 1] == letter) ++at;
    }
    return false;
}

Result<RegionSettings> readRegions(RegionFiles& files, const fs::path& file) {
    if (!isOnDisk(file) && file != files.beside) return planet::badInput(file.string() + ": does not exist");
    RegionsOnDisk& known = files.known[file] = onDisk(file);
    if (!known.problem.empty()) return planet::badInput(known.problem);
    if (!known.list) return RegionSettings{};
    return RegionSettings{.list = known.list, .file = file.string()};
}

void noteRead(RegionFiles& files, const RegionSettings& regions) {
    RegionsOnDisk& known = files.known[regions.file] = onDisk(regions.file);
    known.list = regions.list;
}

fs::path secondRegionsFile(const fs::path& file) {
    const fs::path second = secondFile(file, 1);
    return isOnDisk(second) ? second : fs::path();
}

fs::path fileOf(const RegionFiles& files, const RegionSettings& regions) {
    return regions.file.empty() ? files.beside : fs::path(regions.file);
}

bool areSaved(const RegionFiles& files, const RegionSettings& regions) {
    const auto known = files.known.find(fileOf(files, regions));
    return areSame(regions.list, known == files.known.end() ? nullptr : known->second.list);
}

Result<RegionsSave> saveRegionsIn(RegionFiles& files, const RegionSettings& regions, const fs::path& file,
                                  bool replaces) {
    RegionsSave save{.file = file};
    const RegionsOnDisk now = onDisk(file);
    if (!now.problem.empty()) {
        save.problem = now.problem;
        TRY_ASSIGN(save.file, secondFileFor(files, file));
    } else if (isOnDisk(file) && !replaces) {
        save.question = lossOf(file, now, files.known[file]);
        if (!save.question.empty()) return RegionsSave{.question = save.question};
    }
    TRY(saveRegions(regions.all(), save.file));
    files.known[save.file] = {startOfFile(save.file, mostRegionsBytes), regions.list, {}};
    return save;
}

std::vector<std::string> unsavedRegions(const RegionFiles& files, const RegionSettings& current) {
    std::vector<std::string> names;
    if (!files.planet.empty() && !areSaved(files, current)) names.push_back(fileOf(files, current).string());
    for (const auto& [source, regions] : files.unsaved) names.push_back(regions.file);
    return names;
}

Result<void> saveAllRegions(RegionFiles& files, const RegionSettings& current) {
    std::vector<RegionSettings> all;
    if (!files.planet.empty() && !areSaved(files, current)) {
        all.push_back(current);
        all.back().file = fileOf(files, current).string();
    }
    for (const auto& [source, regions] : files.unsaved) all.push_back(regions);
    for (const RegionSettings& regions : all) {
        TRY_ASSIGN(const RegionsSave save, saveRegionsIn(files, regions, regions.file, false));
        if (!save.question.empty())
            return planet::badInput(fmt::format(
                "{} Save the regions in the Regions panel of their planet to replace it", save.question));
    }
    files.unsaved.clear();
    return {};
}

}  // namespace worldy
