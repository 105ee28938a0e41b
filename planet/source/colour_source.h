// Opens a colour source: an image of the whole planet or of its six faces, with one sampling function.
//
// Images have the layout of height images (height_source.h) and any size: grey or RGB, 8 or 16 bits in sRGB,
// or floats in linear light. Alpha is ignored.
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

// Copies share the open files. Several threads may call sample at once.
struct ColourSource {
    std::string description;  // "colour.jpg, 2048 x 1024 uint8, equirectangular"
    int naturalFaceSize = 0;  // the smallest 2^n + 1 that loses no resolution
    // The warning that six faces differ along the cube's edges, with visible seams; empty if they agree.
    std::string notice{};

    // Returns a hash of what the colours depend on. Reads the files. Null: unknown.
    std::function<Result<std::uint64_t>()> signature{};

    // Fills out, row-major, with columns x rows colours in linear light, [0, 1]. Like HeightSource::sample,
    // it filters to the grid's spacing and returns the same bits on an edge of the cube from either face.
    std::function<Result<void>(const SampleTile& tile, std::span<glm::vec3> out)> sample;
};

inline constexpr std::size_t defaultColourCacheBytes = 192u << 20;

// Opens a source. cacheBytes: memory limit for the image. The Error names the file.
Result<ColourSource> openColourSource(const std::filesystem::path& path,
                                      std::size_t cacheBytes = defaultColourCacheBytes);

}  // namespace planet
