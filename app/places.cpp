#include "app/places.h"

#include <cstdlib>
#include <string_view>

namespace worldy {

namespace {

namespace fs = std::filesystem;

fs::path userFolder(const char* variable, const char* belowHome) {
    // The XDG base directory specification: relative paths in these variables are to be ignored.
    const char* given = std::getenv(variable);
    if (given && fs::path(given).is_absolute()) return fs::path(given) / "worldy";
    const char* home = std::getenv("HOME");
    return fs::path(home && *home ? home : "/tmp") / belowHome / "worldy";
}

}  // namespace

fs::path configFolder() {
    return userFolder("XDG_CONFIG_HOME", ".config");
}

fs::path cacheFolder() {
    return userFolder("XDG_CACHE_HOME", ".cache");
}

fs::path dataFolder() {
    std::error_code status;
    const fs::path source = WORLDY_DATA_DIR;
    if (fs::is_directory(source, status)) return source;
    return fs::read_symlink("/proc/self/exe", status).parent_path().parent_path() / "share" / "worldy";
}

}  // namespace worldy
