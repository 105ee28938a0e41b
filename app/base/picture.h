// Colour pictures: reading what lies over a planet, writing what was seen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/source/image_placement.h"

namespace worldy {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  // sRGB, row 0 at the top
};

// Any image that OpenImageIO reads; grey becomes colour, alpha is left out.
planet::Result<Picture> readPicture(const std::filesystem::path& file);

// A picture of a whole planet, moved to pixel centres from longitude -180 to 180: its GeoTIFF tags or its
// size tell where it lies (planet/source/image_placement.h). One without tags may have any shape. The Error of a
// region or of another projection says what was found.
planet::Result<Picture> readPlanetPicture(const std::filesystem::path& file);

// The same picture with its samples at pixel centres from longitude -180 to 180, bilinear in between.
Picture placedPicture(const Picture& picture, const planet::ImagePlacement& placement);

// A text kept in a picture's file: in a PNG a tEXt chunk of that keyword, 1 to 79 bytes.
struct PictureText {
    std::string keyword;
    std::string text;
};

// Written under a temporary name, then renamed. The file's ending chooses the format.
planet::Result<void> writePicture(const Picture& picture, const std::filesystem::path& file,
                                  std::span<const PictureText> texts = {});

// The text of a keyword without reading the picture; empty where there is none.
planet::Result<std::string> readPictureText(const std::filesystem::path& file, const std::string& keyword);

}  // namespace worldy
