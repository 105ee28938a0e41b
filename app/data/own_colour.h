// Finds the colour image that belongs to a source of heights.
#pragma once

#include <filesystem>

namespace worldy {

// Returns colour.jpg or colour.png in the folder of a file; empty if there is none.
std::filesystem::path colourImageBeside(const std::filesystem::path& file);

// Returns the image beside the source, or beside the file that detail is added to; empty for terrain without
// a file.
std::filesystem::path ownColourImage(const std::filesystem::path& source);

}  // namespace worldy
