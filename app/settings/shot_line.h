// The command line that draws what the window shows. Pure functions, any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/settings/camera_text.h"
#include "app/settings/view_settings.h"
#include "planet/sphere/view.h"

namespace worldy {

// One word of a POSIX shell, quoted where it must be.
std::string shellWord(std::string_view text);

// The `worldy shot` line for a view: the camera, and of the settings only those that are not as shot has
// them. Paths go in as they are given: absolute ones work from any folder. colourImage empty: the one beside
// the chunk file.
std::string shotLine(const std::filesystem::path& chunkFile, const planet::CameraPose& pose,
                     const PictureSize& size, const ViewSettings& view,
                     const std::filesystem::path& colourImage);

}  // namespace worldy
