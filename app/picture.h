// Colour pictures: reading what lies over a planet, writing what was seen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "planet/result.h"

namespace worldy {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  // sRGB, row 0 at the top
};

// Any image that OpenImageIO reads; grey becomes colour, alpha is left out.
planet::Result<Picture> readPicture(const std::filesystem::path& file);

// Written under a temporary name, then renamed. The file's ending chooses the format.
planet::Result<void> writePicture(const Picture& picture, const std::filesystem::path& file);

}  // namespace worldy
