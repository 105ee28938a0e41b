// Opens a colour source, with one sampling function: an image of the whole planet or of its six faces, georeferenced
// rasters of any part of it, or a world file with layers [[colour]].
//
// Images of the whole planet and of faces have the layout of height images (height_source.h) and any size: grey or
// RGB, 8 or 16 bits in sRGB, or floats in linear light. Their alpha is ignored. Georeferenced rasters may have a
// colour table too; masks, alpha and no-data values say where they have no colour, and it is black if nothing lies
// under it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>

#include "planet/base/result.h"
#include "planet/raster/survey_share.h"
#include "planet/source/height_source_types.h"

namespace planet {

// Copies share the open files. Several threads may call sample at once.
struct ColourSource {
    std::string description;  // "colour.jpg, 2048 x 1024 uint8, equirectangular"
    int naturalFaceSize = 0;  // the smallest 2^n + 1 that loses no resolution
    // The warning that six faces differ along the cube's edges, with visible seams; empty if they agree.
    std::string notice{};
    // Returns the smallest power of two of cells along a face that loses no resolution under a square, as
    // HeightSource::finestCells does. Null: naturalFaceSize - 1 everywhere.
    std::function<int(const ChunkId& square)> finestCells{};

    // Returns a hash of what the colours depend on. Reads the files. Null: unknown.
    std::function<Result<std::uint64_t>()> signature{};

    // Fills out, row-major, with columns x rows colours in linear light, [0, 1]. Like HeightSource::sample,
    // it filters to the grid's spacing and returns the same bits on an edge of the cube from either face.
    std::function<Result<void>(const SampleTile& tile, std::span<glm::vec3> out)> sample;
};

// Returns whether a path is a valid world file with layers of colour, which openColourSource opens.
bool hasColourLayers(const std::filesystem::path& path);

inline constexpr std::size_t defaultColourCacheBytes = 192u << 20;

// Opens a source. cacheBytes: memory limit for the image. share: as in HeightSourceSettings. The Error names the file.
Result<ColourSource> openColourSource(const std::filesystem::path& path,
                                      std::size_t cacheBytes = defaultColourCacheBytes,
                                      const std::shared_ptr<const SurveyShare>& share = {});

}  // namespace planet
