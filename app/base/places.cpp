#include "app/base/places.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace worldy {

namespace {

namespace fs = std::filesystem;

fs::path homeFolder() {
    const char* home = std::getenv("HOME");
    return home && *home ? home : "/tmp";
}

// The XDG base directory specification ignores relative paths in these variables.
fs::path userFolder(const char* variable, const char* belowHome) {
    const char* given = std::getenv(variable);
    return given && fs::path(given).is_absolute() ? fs::path(given) : homeFolder() / belowHome;
}

// Returns the folder of a line XDG_PICTURES_DIR="$HOME/Bilder" in user-dirs.dirs; empty if there is none.
// Shell escapes are not resolved: such a folder is not found, and the next choice is taken.
fs::path picturesOfDesktop() {
    constexpr std::string_view start = "XDG_PICTURES_DIR=\"";
    constexpr std::string_view home = "$HOME/";
    const fs::path file = userFolder("XDG_CONFIG_HOME", ".config") / "user-dirs.dirs";
    std::error_code status;
    if (!fs::is_regular_file(file, status)) return {};
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with(start) || !line.ends_with('"') || line.size() <= start.size()) continue;
        const std::string value = line.substr(start.size(), line.size() - start.size() - 1);
        return value.starts_with(home) ? homeFolder() / value.substr(home.size()) : fs::path(value);
    }
    return {};
}

}  // namespace

fs::path configFolder() {
    return userFolder("XDG_CONFIG_HOME", ".config") / "worldy";
}

fs::path cacheFolder() {
    return userFolder("XDG_CACHE_HOME", ".cache") / "worldy";
}

fs::path picturesFolder() {
    const char* given = std::getenv("XDG_PICTURES_DIR");
    for (const fs::path& folder :
         {fs::path(given ? given : ""), picturesOfDesktop(), homeFolder() / "Pictures"}) {
        std::error_code status;
        if (folder.is_absolute() && fs::is_directory(folder, status)) return folder;
    }
    return fs::current_path();
}

fs::path dataFolder() {
    std::error_code status;
    const fs::path source = WORLDY_DATA_DIR;
    if (fs::is_directory(source, status)) return source;
    return fs::read_symlink("/proc/self/exe", status).parent_path().parent_path() / "share" / "worldy";
}

fs::path earthWorld() {
    return dataFolder() / "earth" / "earth.toml";
}

fs::path earthElevation() {
    return dataFolder() / "earth" / "elevation.tif";
}

}  // namespace worldy
