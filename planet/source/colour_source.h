// Opens a colour source: an image of the whole planet or of its six faces, behind one sampling function.
//
// Images are laid out as those of heights (height_source.h), of any size: grey or RGB, 8 or 16 bits in sRGB,
// or floats in linear light; alpha is ignored.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "planet/base/result.h"
#include "planet/source/height_source_types.h"

namespace planet {

// Copies share the open files. sample may be called by several threads at once.
struct ColourSource {
    std::string description;  // "colour.jpg, 2048 x 1024 uint8, equirectangular"
    int naturalFaceSize = 0;  // the smallest 2^n + 1 that loses no resolution
    // Says that six faces differ along the cube's edges so that seams will be visible; empty if they agree.
    std::string notice{};

    // Fills out, row-major, columns x rows colours in linear light, [0, 1]. Like HeightSource::sample, it
    // filters to the grid's spacing and gives the same bits on an edge of the cube through either face.
    std::function<Result<void>(const SampleTile& tile, std::span<glm::vec3> out)> sample;
};

inline constexpr std::size_t defaultColourCacheBytes = 192u << 20;

// cacheBytes: the largest memory for the image. The Error names the file.
Result<ColourSource> openColourSource(const std::filesystem::path& path,
                                      std::size_t cacheBytes = defaultColourCacheBytes);

}  // namespace planet
