// The colour image that belongs to a source of heights.
#pragma once

#include <filesystem>

namespace worldy {

// colour.jpg or colour.png in a file's folder; empty if there is none.
std::filesystem::path colourImageBeside(const std::filesystem::path& file);

// That beside the source, or beside the file that detail is added to; empty of terrain from nothing.
std::filesystem::path ownColourImage(const std::filesystem::path& source);

}  // namespace worldy
