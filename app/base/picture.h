// A picture of 8-bit colours in memory; picture_file.h reads and writes it.
#pragma once

#include <cstdint>
#include <vector>

namespace worldy {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  // sRGB, row 0 at the top
};

// Returns the part of a picture in a rectangle of pixels, cut off at the picture's borders.
Picture partOf(const Picture& picture, int x, int y, int width, int height);

}  // namespace worldy
