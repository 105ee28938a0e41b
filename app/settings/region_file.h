// The regions of a planet (planet/tree/region.h) as TOML, in files named *.regions.toml. Files are untrusted until
// checked.
//
//   [[region]]                              up to 255 of them, in any order
//   name = "Valley"                         required, unique
//   on = true                               false: kept in the file, without effect
//   circles = [[46.5, 7.9, 30000]]          latitude and longitude, degrees; radius, metres. Up to 4096
//   polygons = [[[46, 7], [46, 8], [47, 8]]]
//                                           corners, latitude and longitude, degrees, each once. Up to 64 of up to
//                                           1000 corners, within 80 degrees of their middle; edges must not cross
//   heights_m = [1000, 9000]                lowest and highest ground, metres above the planet's radius, as baked
//   heights_border_m = 200                  soft border below and above these, metres of height
//   border_m = 20000                        soft border around circles and polygons, metres along the ground
//   tau_factor = 0.5                        factor on the tolerance, [1/64, 64]
//   least_level = 6                         levels, [0, 24]
//   most_level = 12                         not less than least_level
//   metric = "tight"                        or "additive"
//
// A region covers its circles and polygons together, at the heights in heights_m. Without circles and polygons it covers
// all ground at these heights, and without any of them nothing. What is not given has no effect; only name is required.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/tree/region.h"

namespace worldy {

inline constexpr std::string_view regionsFileEnding = ".regions.toml";
inline constexpr std::string_view regionsFileHead = "# Regions of a planet, for Worldy.\n";

// Loads a file. The Error names the file, the line, the entry, what is wrong and what is expected.
planet::Result<std::vector<planet::Region>> loadRegions(const std::filesystem::path& file);
// Does the same for text; place stands for the file's name in errors.
planet::Result<std::vector<planet::Region>> regionsFromText(std::string_view text,
                                                            const std::filesystem::path& place);

// Returns the text of a file, which gives the same regions, bit for bit.
std::string regionsText(const std::vector<planet::Region>& regions);
// Saves a file atomically.
planet::Result<void> saveRegions(const std::vector<planet::Region>& regions,
                                 const std::filesystem::path& file);

// Returns true if the file is named *.regions.toml.
bool isRegionsFile(const std::filesystem::path& file);
// Returns "earth.regions.toml" in the same folder for "earth.chk", whether or not it exists.
std::filesystem::path regionsFileOf(const std::filesystem::path& planetFile);

// Returns the regions of a planet for settings: those of the given file or, if that is empty, of the file beside the
// planet. Without either there are none.
planet::Result<RegionSettings> regionsFor(const std::filesystem::path& given,
                                          const std::filesystem::path& planetFile);

}  // namespace worldy
