// Sets of texture layers as TOML, in files of their own and inside the settings. Files are hostile until
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

// What a file may hold, key by key:
//   blend = "height"                       or "weight"
//   blend_depth = 0.3
//   [[layer]]                              1 to 8 of them, the lowest first
//   name = "rock"
//   albedo = "rock_albedo.png"             beside the file, or anywhere
//   height_m = [300, 4000, 200]            lowest, highest, soft edge; slope_deg and latitude_deg alike
// Keys that are left out have their defaults. The Error names the file, the line, the key and what would be
// right. Ranges that contradict themselves are no Error: planet::layerProblem tells of them, and a checker
// pattern is drawn in their layer's place.
planet::Result<planet::LayerSet> loadLayerSet(const std::filesystem::path& file);
// The same of text; place stands for the file's name in errors.
planet::Result<planet::LayerSet> layerSetFromText(std::string_view text, const std::filesystem::path& place);

// The file's text. Equal sets give equal text.
std::string layerSetText(const planet::LayerSet& set);

// With the textures named so that they are found from there. folder: where they are found now.
planet::Result<void> saveLayerSet(const planet::LayerSet& set, const std::filesystem::path& folder,
                                  const std::filesystem::path& file);
// What that has written: names relative to a folder, or absolute where they lie outside it.
planet::LayerSet movedTo(const std::filesystem::path& newFolder, const std::filesystem::path& folder,
                         planet::LayerSet set);

// An array of layers, as it stands in settings.
planet::Result<std::vector<planet::TextureLayer>> layersFromToml(const std::filesystem::path& file,
                                                                 std::string_view name,
                                                                 const toml::node& node);
// A layer in one line, { name = "rock", ... }, without what has its default.
std::string layerLine(const planet::TextureLayer& layer);

// Where a set's textures are looked for: beside its file, or with those that come with Worldy where it has
// none.
std::filesystem::path layerFolderOf(const std::filesystem::path& setFile);

}  // namespace worldy
