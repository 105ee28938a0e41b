// Opens a height source: an image of the whole planet, georeferenced rasters, six cube faces, procedural terrain
// (terrain.h), or a world file that lists several of them as layers.
//
// An image of the whole planet is equirectangular, north up, with one grey channel. GeoTIFF tags give the
// placement of its samples. Without tags, an image of 2 n + 1 by n + 1 samples, or 2 n by n + 1, has the
// points of a grid whose first point lies at longitude -180 on the north pole. Any other image has its
// samples at pixel centres, from longitude -180 to 180.
//
// Georeferenced rasters cover any part of the planet in any coordinate reference system that PROJ knows: a
// GeoTIFF, HGT, DTED, ASCII grid, netCDF, JPEG 2000 or ENVI file, or several that a pattern lists. Geodetic
// latitude goes onto the sphere unchanged. Rasters on one grid are joined before they are filtered; of others,
// the finest that has a height at a place counts. Where none has one, the height is fillM.
//
// Face images are seen as in cube_sphere.h: row 0 at v = +1, column 0 at u = -1, outermost samples on the
// cube's edges, where neighbouring faces have the same heights. Raw faces are headerless, with rows in the
// same order.
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
    // One image, the existing faces, or the files of a pattern; then the files next to them that are read too:
    // ESRI world files (.tfw), .aux.xml, .prj and .hdr.
    std::vector<std::filesystem::path> files;
};
HeightSourceFiles heightSourceFiles(const std::filesystem::path& path);
// Returns whether a path names a source: an image, a face, a pattern of files, or a valid terrain text. A
// chunk file is not a source.
bool heightSourceExists(const std::filesystem::path& path);

// Returns whether a path is a world file, valid or not: TOML with a table [[elevation]] or [[colour]]. README.md beside
// this file describes it.
bool isWorldFile(const std::filesystem::path& path);

// Returns whether a file is a raster with a coordinate reference system and a position, by its header.
bool isGeoreferenced(const std::filesystem::path& file);

// Opens a world file, a terrain text ("noise:ridged,seed=7", terrain.h), an elevation image, georeferenced rasters by a
// pattern or list ("tiles/*.tif|more.hgt", in quotes in a shell), or six cube faces. For faces,
// the path is one of the files (earth4097_z_pos.raw) or their common stem (earth4097), with the extension
// .raw or that of an image. A face's size is the number at the end of the stem or, without one, follows from
// the file. It is an Error if heights of faces differ along an edge of the cube by more than rounding. Reads
// every sample once if it must look for NaN, noDataValue or the range of a wide type. Settings describe how
// to read a file: for procedural terrain, any but the defaults are an Error.
Result<HeightSource> openHeightSource(const std::filesystem::path& path,
                                      const HeightSourceSettings& settings);

}  // namespace planet
