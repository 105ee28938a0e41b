// worldy FILE: the window, or a picture of its first view where there is no display.
#pragma once

#include <filesystem>

namespace worldy {

struct AppOptions {
    std::filesystem::path file;          // empty: the settings' data set, or the Earth
    std::filesystem::path settingsFile;  // empty: the user's own
    std::filesystem::path shaderFolder;  // empty: the shaders built in
    std::filesystem::path
        itemMapFile;  // where to write where controls are (ui/kit/item_map.h); empty: nowhere
};

// The program's exit code.
int runApp(const AppOptions& options);

}  // namespace worldy
