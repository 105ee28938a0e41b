// Sets of texture layers as TOML, in their own files and inside the settings. Files are untrusted until
// checked.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/result.h"
#include "planet/surface/layer_set.h"

namespace worldy {

inline constexpr std::array<std::string_view, 2> layerBlendNames = {"weight", "height"};

// Loads a set. A file may contain these keys:
//   blend = "height"                       or "weight"
//   blend_depth = 0.3
//   [[layer]]                              1 to 8 of them, the lowest first
//   name = "rock"
//   albedo = "rock_albedo.png"             relative to the file's folder, or absolute
//   height_m = [300, 4000, 200]            lowest, highest, soft edge; slope_deg and latitude_deg alike
// Missing keys have default values. The Error names the file, the line, the key and the expected value.
// Contradictory ranges are no Error: planet::layerProblem reports them, and the layer is drawn as a
// checkerboard.
planet::Result<planet::LayerSet> loadLayerSet(const std::filesystem::path& file);
// Does the same for text; place stands for the file's name in errors.
planet::Result<planet::LayerSet> layerSetFromText(std::string_view text, const std::filesystem::path& place);

// Returns the file's text. Equal sets give equal text.
std::string layerSetText(const planet::LayerSet& set);

// Saves a set, with texture paths adapted to the new file. folder: the folder that the paths are relative to
// now.
planet::Result<void> saveLayerSet(const planet::LayerSet& set, const std::filesystem::path& folder,
                                  const std::filesystem::path& file);
// Returns the set as saveLayerSet() writes it: with texture paths relative to newFolder, or absolute if they
// are outside it.
planet::LayerSet movedTo(const std::filesystem::path& newFolder, const std::filesystem::path& folder,
                         planet::LayerSet set);

// Reads an array of layers as settings contain it.
planet::Result<std::vector<planet::TextureLayer>> layersFromToml(const std::filesystem::path& file,
                                                                 std::string_view name,
                                                                 const toml::node& node);
// Returns a layer in one line, { name = "rock", ... }, without keys that have default values.
std::string layerLine(const planet::TextureLayer& layer);

// Returns the folder of a set's textures: that of its file, or that of the built-in textures if it has no
// file.
std::filesystem::path layerFolderOf(const std::filesystem::path& setFile);

}  // namespace worldy
