// The image formats that OpenImageIO reads. Internal to the library; any thread.
#pragma once

#include <string>

namespace planet {

// Returns whether OpenImageIO reads files with an extension such as ".tif".
bool isImageExtension(const std::string& extension);

}  // namespace planet
