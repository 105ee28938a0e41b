// Reads a world file: TOML that lists layers of elevation and of colour from the bottom up. README.md beside this file has the
// schema. Internal to the library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/placed_image.h"
#include "planet/raster/vertical_datum.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Says how a layer joins the heights of the layers under it.
enum class LayerJoin : std::uint8_t {
    Replace,  // its heights count
    Max,      // the higher one counts
    Add       // its heights are added
};

// Says how a layer shows samples of a raster that have no height.
enum class LayerVoids : std::uint8_t {
    Below,  // the layers under it show through
    Fill,   // their heights are interpolated from those around them
    Height  // they have the height voidM
};

struct WorldLayer {
    std::string name;  // for messages; the first file or the terrain if the file gives none
    bool on = true;    // a layer that is off is only kept in the file
    std::vector<std::filesystem::path>
        files;            // paths or patterns, relative ones from the folder of the world file
    std::string terrain;  // instead of files: "noise:ridged,seed=7"
    std::string detail;   // instead of files: "strength=0.8", detail below what lies under it
    LayerJoin join = LayerJoin::Replace;
    LayerVoids voids = LayerVoids::Below;
    double voidM = 0;        // metres, before scale and offsetM; magnitude at most 1e6
    double featherM = 0;     // the width of the blend inwards from the rim of its coverage, [0, 1e6]
    double scale = 1;        // height = offsetM + scale * the height that the files say; magnitude (0, 1e6]
    double offsetM = 0;      // magnitude at most 1e6
    bool hasOffset = false;  // the file gives offsetM
    // The datum of the files' heights. It is set only if the world file sets the planet's datum.
    std::optional<VerticalDatum> datum;
    std::optional<ImagePlace> place;  // of the one file, which has no position of its own
    std::optional<int> rawSize;       // only with place: of a raw file, samples per side, or in a row
    std::optional<int> rawRows;       // of rawSize samples; unset: rawSize
    bool rawBigEndian = false;
    bool rawSigned = false;
};

struct WorldFile {
    // The layers of elevation and those of colour, from the bottom up. At least one layer is on. A layer of colour has
    // only a name, files and featherM, and is on or off.
    std::vector<WorldLayer> layers;
    std::vector<WorldLayer> colours;
    double radiusM = earthRadiusM;       // of the planet, for widths in metres; [1, 1e9]
    double fillM = 0;                    // the height where no layer has one, metres; magnitude at most 1e6
    std::optional<VerticalDatum> datum;  // of the planet's heights
};

// Reads a world file. The Error names the file, the line, the key and the expected value.
Result<WorldFile> readWorldFile(const std::filesystem::path& path);

// Reads the text of a world file as if it lay at a path, from whose folder its relative paths count.
Result<WorldFile> worldFromText(std::string_view text, const std::filesystem::path& path);

// Returns the text of a world file that lies in a folder. It names files relative to the folder where that is possible.
// Keys with their defaults are left out.
std::string worldText(const WorldFile& world, const std::filesystem::path& folder);

// Returns the layers that are on.
std::vector<WorldLayer> layersOn(const std::vector<WorldLayer>& layers);

// Returns the name of a layer that has none of its own: its first file, its terrain or its detail.
std::string defaultNameOf(const WorldLayer& layer);

std::string_view nameOf(LayerJoin join);  // as in the file: "replace", "max", "add"

// Returns the files that a layer's paths and patterns name, in their order. The Error names a pattern without
// files, or a file that does not exist.
Result<std::vector<std::filesystem::path>> filesOfLayer(const WorldLayer& layer);

}  // namespace planet
