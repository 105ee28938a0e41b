// The folders and files that Worldy finds without being told. Any thread, while the environment does not
// change.
#pragma once

#include <filesystem>

namespace worldy {

// Returns $XDG_CONFIG_HOME/worldy or ~/.config/worldy: the settings, the layout of tables and windows, recent
// files and presets/.
std::filesystem::path configFolder();

// Returns $XDG_CACHE_HOME/worldy or ~/.cache/worldy: chunk files of sources that were opened.
std::filesystem::path cacheFolder();

// Returns the folder for screenshots: the desktop's folder for pictures, that is $XDG_PICTURES_DIR, or what
// user-dirs.dirs in the configuration folder says, or ~/Pictures; the current folder if none of them exists.
std::filesystem::path picturesFolder();

// Returns the data that comes with Worldy: the source tree's if it exists, otherwise ../share/worldy from the
// binary.
std::filesystem::path dataFolder();

// Returns the elevation image of the Earth that comes with Worldy, earth/elevation.tif in dataFolder().
std::filesystem::path earthElevation();
// Returns the world file of the Earth that Worldy opens: that image with two finer regions, earth/earth.toml.
std::filesystem::path earthWorld();

}  // namespace worldy
