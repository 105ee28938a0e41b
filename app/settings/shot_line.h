// The command line that draws the window's view. Pure functions, any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "planet/sphere/view.h"

namespace worldy {

// Returns a word for a POSIX shell, quoted if necessary.
std::string shellWord(std::string_view text);

// Returns a path as such a word, which no program takes for an option.
std::string pathWord(const std::filesystem::path& path);

// Returns the same for the absolute path, which works in any folder.
std::string absoluteWord(const std::filesystem::path& path);

// Returns the `worldy shot` line for a view: the camera, and the settings that differ from the defaults.
// Paths are written as given; absolute ones work in any folder. colourImage empty: the one beside the chunk
// file. source: the planet's, for settings that show its layers; empty: none.
std::string shotLine(const std::filesystem::path& chunkFile, const planet::CameraPose& pose,
                     const PictureSize& size, const ViewSettings& view,
                     const std::filesystem::path& colourImage, const std::filesystem::path& source = {});

// Returns whether a picture with these settings shows the layers of the planet's source.
bool showsSource(const OverlaySettings& overlay);

}  // namespace worldy
