#include "app/data/recent_files.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>

#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/data/worlds.h"
#include "planet/source/height_source.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostListBytes = 64u << 10;

bool isThere(const fs::path& path) {
    if (isWorldName(path)) return worldNamed(path).has_value();
    if (planet::isTerrainText(path)) return planet::heightSourceExists(path);
    return !planet::heightSourceFiles(path).files.empty();
}

// Returns true for a name that is not a path, and so means the same in every folder.
bool isName(const fs::path& path) {
    return isWorldName(path) || planet::isTerrainText(path);
}

}  // namespace

fs::path recentFilesFile() {
    return configFolder() / "recent.txt";
}

std::vector<fs::path> loadRecentFiles(const fs::path& file) {
    std::vector<fs::path> recent;
    std::istringstream lines(startOfFile(file, mostListBytes));
    for (std::string line; recent.size() < maxRecentFiles && std::getline(lines, line);) {
        const fs::path path = line;
        const bool good = line.find('\0') == std::string::npos && (path.is_absolute() || isName(path));
        if (good && std::find(recent.begin(), recent.end(), path) == recent.end()) recent.push_back(path);
    }
    return recent;
}

void addRecentFile(std::vector<fs::path>& recent, const fs::path& opened) {
    std::error_code status;
    fs::path path = isWorldName(opened) ? opened : fs::absolute(opened, status).lexically_normal();
    if (planet::isTerrainText(opened)) path = planet::wholeTerrainText(opened).value_or(opened.string());
    if (status || path.empty()) return;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    if (recent.size() > maxRecentFiles) recent.resize(maxRecentFiles);
}

std::vector<fs::path> shownRecentFiles(const std::vector<fs::path>& recent) {
    std::vector<fs::path> shown;
    std::copy_if(recent.begin(), recent.end(), std::back_inserter(shown), isThere);
    return shown;
}

planet::Result<void> saveRecentFiles(const std::vector<fs::path>& recent, const fs::path& file) {
    std::error_code status;
    fs::create_directories(fs::absolute(file).parent_path(), status);
    std::string text;
    for (const fs::path& path : recent) {
        if (path.string().find_first_of("\n\r") == std::string::npos) text += path.string() + "\n";
    }
    return writeTextFile(file, text);
}

}  // namespace worldy
