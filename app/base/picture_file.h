// Files of 8-bit colour pictures, and textures of one to four channels. The image libraries that these functions need
// are loaded at the first call (app/images/image_functions.h). Any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/base/picture.h"
#include "planet/base/result.h"
#include "planet/raster/image_placement.h"

namespace worldy {

// Loads the image libraries now, if that is not done, so that a later call need not wait.
void loadImageLibraries();

// Reads any image that OpenImageIO can read. Grey becomes RGB, alpha is dropped.
planet::Result<Picture> readPicture(const std::filesystem::path& file);

// Reads a picture of a whole planet and resamples it to pixel centres from longitude -180 to 180. GeoTIFF
// tags or the size say where its samples lie (planet/raster/image_placement.h). A picture without tags may
// have any shape. A region or another projection is an Error.
planet::Result<Picture> readPlanetPicture(const std::filesystem::path& file);

// Returns the picture resampled bilinearly to pixel centres from longitude -180 to 180. The program itself has no such
// function, because only readPlanetPicture calls it.
Picture placedPicture(const Picture& picture, const planet::ImagePlacement& placement);

// A text stored in the picture's file; in a PNG it is a tEXt chunk. The keyword has [1, 79] bytes.
struct PictureText {
    std::string keyword;
    std::string text;
};

// Writes the file atomically. Its extension chooses the format.
planet::Result<void> writePicture(const Picture& picture, const std::filesystem::path& file,
                                  std::span<const PictureText> texts = {});

// Returns an Error if writePicture knows no format for the extension of a name.
planet::Result<void> checkPictureName(const std::filesystem::path& file);

// Returns whether a file is a picture as writePicture writes it under its name: 8-bit RGB without GeoTIFF tags.
bool isOwnPicture(const std::filesystem::path& file);

// Returns the text of a keyword without reading the pixels; empty if there is none.
planet::Result<std::string> readPictureText(const std::filesystem::path& file, const std::string& keyword);

// A square texture.
struct Texture {
    int size = 0;      // texels per side
    int channels = 0;  // [1, 4]; alpha is not multiplied into the colours
    std::vector<std::uint8_t> bytes;
};

// The sides of a texture are powers of two in this range.
inline constexpr int leastTextureSize = 8;
inline constexpr int mostTextureSize = 4096;

planet::Result<Texture> readTexture(const std::filesystem::path& file);
// Writes a PNG atomically.
planet::Result<void> writeTexture(const Texture& texture, const std::filesystem::path& file);

// Writes a square 16-bit grey image in the format of its extension. grey: row-major, size * size.
planet::Result<void> writeGrey16(int size, std::span<const std::uint16_t> grey,
                                 const std::filesystem::path& file);

// A grey image of 16-bit samples as the file stores them, signed or not.
struct Grey16 {
    int width = 0;
    int height = 0;
    std::vector<std::int32_t> samples;  // width * height, row-major
};
planet::Result<Grey16> readGrey16(const std::filesystem::path& file);

}  // namespace worldy
