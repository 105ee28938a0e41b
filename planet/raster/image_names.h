// These functions tell the kind of an image from its name, and find the files beside it that are read with it. They read no
// image.
// Internal to the library; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace planet {

std::string lowerCase(std::string text);  // of ASCII letters

// Returns whether a file is read as headerless 16-bit samples, by its extension.
bool isRawImage(const std::filesystem::path& path);

// Returns the ESRI world file next to an image; empty if there is none. Its extension is the first and last letters of
// the image's and a w, the whole extension and a w, or wld.
std::filesystem::path worldFileBeside(const std::filesystem::path& image);

// Returns the files next to an image that geoTagsOf (geo_tags.h) would read.
std::vector<std::filesystem::path> sidecarsOf(const std::filesystem::path& image);

}  // namespace planet
