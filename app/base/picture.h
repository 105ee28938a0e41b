// Reads and writes 8-bit colour pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/image_placement.h"

namespace worldy {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  // sRGB, row 0 at the top
};

// Reads any image that OpenImageIO can read. Grey becomes RGB, alpha is dropped.
planet::Result<Picture> readPicture(const std::filesystem::path& file);

// Returns the part of a picture in a rectangle of pixels, cut off at the picture's borders.
Picture partOf(const Picture& picture, int x, int y, int width, int height);

// Reads a picture of a whole planet and resamples it to pixel centres from longitude -180 to 180. GeoTIFF
// tags or the size say where its samples lie (planet/raster/image_placement.h). A picture without tags may
// have any shape. A region or another projection is an Error.
planet::Result<Picture> readPlanetPicture(const std::filesystem::path& file);

// Returns the picture resampled bilinearly to pixel centres from longitude -180 to 180.
Picture placedPicture(const Picture& picture, const planet::ImagePlacement& placement);

// A text stored in the picture's file; in a PNG it is a tEXt chunk. The keyword has [1, 79] bytes.
struct PictureText {
    std::string keyword;
    std::string text;
};

// Writes the file atomically. Its extension chooses the format.
planet::Result<void> writePicture(const Picture& picture, const std::filesystem::path& file,
                                  std::span<const PictureText> texts = {});

// Returns the text of a keyword without reading the pixels; empty if there is none.
planet::Result<std::string> readPictureText(const std::filesystem::path& file, const std::string& keyword);

}  // namespace worldy
