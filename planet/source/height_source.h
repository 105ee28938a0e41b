// Opens a height source: an elevation image, six cube faces or procedural terrain (terrain.h).
//
// An elevation image is equirectangular, of the whole planet, north up, with one grey channel. GeoTIFF tags
// give the placement of its samples. Without tags, an image of 2 n + 1 by n + 1 samples, or 2 n by n + 1, has
// the points of a grid whose first point lies at longitude -180 on the north pole. Any other image has its
// samples at pixel centres, from longitude -180 to 180. Face images are seen as in cube_sphere.h: row 0 at v
// = +1, column 0 at u = -1, outermost samples on the cube's edges, where neighbouring faces have the same
// heights. Raw faces are headerless, with rows in the same order.
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
    std::vector<std::filesystem::path> files;  // one image, or the existing faces; then world files and
                                               // .aux.xml next to them
};
HeightSourceFiles heightSourceFiles(const std::filesystem::path& path);
// Returns whether a path names a source: an image, a face, or a valid terrain text. A chunk file is not a
// source.
bool heightSourceExists(const std::filesystem::path& path);

// Opens a terrain text ("noise:ridged,seed=7", terrain.h), an elevation image, or six cube faces. For faces,
// the path is one of the files (earth4097_z_pos.raw) or their common stem (earth4097), with the extension
// .raw or that of an image. A face's size is the number at the end of the stem or, without one, follows from
// the file. It is an Error if heights of faces differ along an edge of the cube by more than rounding. Reads
// every sample once if it must look for NaN, noDataValue or the range of a wide type. Settings describe how
// to read a file: for procedural terrain, any but the defaults are an Error.
Result<HeightSource> openHeightSource(const std::filesystem::path& path,
                                      const HeightSourceSettings& settings);

}  // namespace planet
