// Describes what a height source consists of, and says which of its layers made the height of a place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/coverage_outline.h"
#include "planet/source/world_file.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

enum class LayerKind : std::uint8_t {
    Rasters,  // georeferenced rasters, or one image that the world file places
    Image,    // one image of the whole planet
    Faces,    // six cube faces
    Terrain,  // procedural terrain
    Detail    // refines what lies under it
};

struct SourceLayer {
    std::string name;
    LayerKind kind = LayerKind::Rasters;
    std::string about;  // "mesa.tif, 101 x 101 float, WGS 84"
    LayerJoin join = LayerJoin::Replace;
    double spacingRad = 0;  // between its finest samples, seen from the planet's centre; 0: it has no samples
    std::uint64_t sampleCount = 0;
    std::uint64_t missingCount = 0;      // samples without a height
    std::vector<std::string> skipped{};  // a message for each file that was left out
    bool coversPlanet = false;
    // The outlines of its files, whether their samples have heights or not: at most 64 lines for each grid
    // (coverage_outline.h). None if it covers the planet.
    std::vector<Outline> outlines{};
    Geographic middle{};  // of what it covers
};

// The sample of a layer that is nearest to a place.
struct SourceReading {
    std::size_t layer = 0;  // in SourceLayers::layers
    // The height that the layer gives there in metres, after its scale, its offset and its datum; nothing if it has none
    // there. A bake interpolates between samples, so its height differs between them.
    std::optional<double> heightM;
    std::filesystem::path file{};  // the file of the sample; empty if the place lies on none
    std::int64_t column = 0;       // of the sample in the file, from the left and from the top
    std::int64_t row = 0;
    bool isVoid = false;  // the sample has no height; heightM then is what LayerVoids says
    double weight = 1;    // of the layer over what lies under it, by its feather, [0, 1]
};

// The layers of an open source. Copies share the open files. Several threads may call at once.
struct SourceLayers {
    std::vector<SourceLayer> layers;  // from the bottom up; at least one
    double fillM = 0;                 // the height where no layer has one, metres
    // Returns what each layer says about a place, the top layer first. Reads a block of a file if it is not cached. The
    // Error names a file that cannot be read.
    std::function<Result<std::vector<SourceReading>>(const Geographic& place)> at;
};

// Returns the share of each reading in the height that a bake shows: that height is the sum of the readings' heights times
// their shares, and of what is left of 1 times fillM. A layer that others cover has a share of 0. Layers that are added have
// shares of their own beside those of the layers under them, which together may exceed 1.
// readings: all of a place, as SourceLayers::at returns them.
std::vector<double> sharesOf(const SourceLayers& layers, std::span<const SourceReading> readings);

// Returns the first reading with a height, that of the topmost layer; null if no layer has one.
const SourceReading* topmost(std::span<const SourceReading> readings);

}  // namespace planet
