// Where Worldy keeps its things.
#pragma once

#include <filesystem>

namespace worldy {

// $XDG_CONFIG_HOME/worldy or ~/.config/worldy: settings.toml, imgui.ini, recent.txt and presets/.
std::filesystem::path configFolder();

// $XDG_CACHE_HOME/worldy or ~/.cache/worldy: chunk files of sources that were opened.
std::filesystem::path cacheFolder();

// Where screenshots go: the desktop's folder for pictures, that is $XDG_PICTURES_DIR, or what user-dirs.dirs
// in the folder of configurations says, or ~/Pictures; the current folder where none of them is there.
std::filesystem::path picturesFolder();

// The data that Worldy starts with: of the source tree it was built from, or else of the place where it is
// installed, ../share/worldy from the binary.
std::filesystem::path dataFolder();

}  // namespace worldy
