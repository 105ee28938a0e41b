// Where heights come from: an elevation image, six cube faces or made terrain (terrain.h), behind one
// sampling function.
//
// An elevation image is equirectangular, of the whole planet, north up, with one grey channel. GeoTIFF tags
// tell where its samples lie; without them an image of 2 n + 1 by n + 1 samples, or 2 n by n + 1, holds the
// points of a grid whose first lies at longitude -180 on the north pole, and any other has its samples at
// pixel centres, from longitude -180 to 180. Face images are seen as in cube_sphere.h: row 0 at v = +1,
// column 0 at u = -1, outermost samples on the cube's edges, where neighbouring faces hold the same heights.
// Raw faces are headerless, rows in the same order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/cube_sphere.h"
#include "planet/file_calls.h"
#include "planet/result.h"

namespace planet {

// A rectangle of a face's finest grid of (faceCells + 1)^2 samples; column i lies at u = 2 i / faceCells - 1,
// row j at v = 2 j / faceCells - 1.
struct SampleTile {
    Face face = Face::PosX;
    int faceCells = 0;  // power of two
    int firstColumn = 0;
    int firstRow = 0;
    int columns = 0;  // samples
    int rows = 0;
};

// A value; copies share what is open. sample may be called by several threads at once.
struct HeightSource {
    std::string description;  // "elevation.tif, 4320 x 2160 int16, equirectangular"
    int naturalFaceSize =
        0;             // the smallest 2^n + 1 that loses no source resolution; of made terrain, which may
                       //   go on below, one that bakes in some minutes
    double stepM = 0;  // an integer source's own step in metres; 0 for a float source
    double minM = 0;   // the lowest and highest of the file's samples, fillM where it was used; every
    double maxM = 0;   //   height that sample gives lies between them
    std::uint64_t sampleCount = 0;
    std::uint64_t missingCount = 0;  // samples without data, filled

    // Fills out, row-major, columns x rows heights in metres. A sample's value depends only on its point of
    // the cube and faceCells, never on the tile or the face it is asked through, so shared edges are
    // bit-identical. Filtered: a source finer than the grid is averaged over the grid's spacing, a coarser
    // one is interpolated smoothly; faces on a grid of their own size are copied exactly. Where faces
    // differ by rounding along an edge of the cube, the first in enum order is taken. Takes some 16 MB a call
    // beside the cache. The Error names the file.
    std::function<Result<void>(const SampleTile& tile, std::span<float> out)> sample;
};

struct HeightSourceSettings {
    double metresPerUnit = 1;  // height = offsetM + metresPerUnit * value; not 0
    double offsetM = 0;        // metres
    std::optional<double>
        noDataValue;             // a value that means "missing", instead of the file's own GDAL_NODATA; NaN
                                 //   and infinities always do
    double fillM = 0;            // height given to missing samples, metres
    std::optional<int> rawSize;  // raw faces: samples a side, where the name does not say
    std::optional<int> rawBits;  // raw faces: 8 or 16, where the file's length does not say
    bool rawSigned = false;      // raw faces of 16 bits: signed steps
    bool rawBigEndian = false;   // raw faces of 16 bits
    // 0 to 2: instead of heights that channel of a colour image, as linear light in [0, 1]; integers are
    // taken to be sRGB, floats linear light already. A grey image is the same in all three, alpha is left
    // out.
    std::optional<int> colourChannel;
    // Most memory spent on heights, 4 bytes each. A source that takes more is read in blocks; one whose file
    // has none, a PNG say, is copied once to a temporary file.
    std::size_t cacheBytes = 48u << 20;
    FileCalls fileCalls = systemFileCalls();  // of raw faces and of that temporary file
};

// The files that a path stands for, taken as openHeightSource takes it. A terrain's text stands for those of
// the source that it is added to, if any.
struct HeightSourceFiles {
    std::string stem;  // "elevation", "earth4097" of earth4097_z_pos.raw, "ridged" of noise:ridged,seed=7
    std::vector<std::filesystem::path> files;  // one image, or those of the six faces that are there
};
HeightSourceFiles heightSourceFiles(const std::filesystem::path& path);
// Whether there is something to bake: an image, a face, or a good terrain's text. A chunk file is none.
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
