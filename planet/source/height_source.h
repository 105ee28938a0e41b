// Opens a height source: an elevation image, six cube faces or procedural terrain (terrain.h).
//
// An elevation image is equirectangular, of the whole planet, north up, with one grey channel. GeoTIFF tags
// give the place of its samples; without them an image of 2 n + 1 by n + 1 samples, or 2 n by n + 1, holds
// the points of a grid whose first lies at longitude -180 on the north pole, and any other has its samples at
// pixel centres, from longitude -180 to 180. Face images are seen as in cube_sphere.h: row 0 at v = +1,
// column 0 at u = -1, outermost samples on the cube's edges, where neighbouring faces hold the same heights.
// Raw faces are headerless, rows in the same order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/source/height_source_types.h"

namespace planet {

// The files that openHeightSource would open for a path. The text of a detail terrain has the files of its
// source.
struct HeightSourceFiles {
    std::string stem;  // "elevation", "earth4097" of earth4097_z_pos.raw, "ridged" of noise:ridged,seed=7
    std::vector<std::filesystem::path>
        files;  // one image, or those of the six faces that are there; then world
                // files and .aux.xml beside them
};
HeightSourceFiles heightSourceFiles(const std::filesystem::path& path);
// Returns whether a path names a source: an image, a face, or a valid terrain's text. A chunk file is not a
// source.
bool heightSourceExists(const std::filesystem::path& path);

// Opens a terrain's text ("noise:ridged,seed=7", terrain.h), an elevation image, or the six cube faces that
// the path names one of (earth4097_z_pos.raw) or the common stem of (earth4097: .raw, or an image's
// extension). A face's size is the number that the stem ends in or, where it ends in none, what the file
// holds. Heights of faces that differ along an edge of the cube by more than rounding are an Error. Reads
// every sample once where NaN, noDataValue or the range of a wide type must be looked for. Settings tell how
// a file is read: with made terrain any but the defaults are an Error.
Result<HeightSource> openHeightSource(const std::filesystem::path& path,
                                      const HeightSourceSettings& settings);

}  // namespace planet
