// The command worldy FILE: opens the window, or draws a picture of its first view if there is no display.
#pragma once

#include <filesystem>

namespace worldy {

struct AppOptions {
    std::filesystem::path file;          // empty: the settings' data set, or the Earth
    std::filesystem::path settingsFile;  // empty: the user's own
    std::filesystem::path shaderFolder;  // empty: the built-in shaders
    std::filesystem::path regionsFile;   // empty: the one beside the planet, if there is one
    std::filesystem::path
        itemMapFile;  // for the positions of controls (ui/kit/item_map.h); empty: not written
};

// Returns the program's exit code.
int runApp(const AppOptions& options);

}  // namespace worldy
