// A source of heights behind one sampling function, and the settings for reading its file (height_source.h
// opens one).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"
#include "planet/sphere/cube_sphere.h"

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

// Copies share the open files. sample may be called by several threads at once.
struct HeightSource {
    std::string description;  // "elevation.tif, 4320 x 2160 int16, equirectangular"
    // The smallest 2^n + 1 that loses no source resolution. Procedural terrain, which may have finer detail,
    // names one that bakes in some minutes.
    int naturalFaceSize = 0;
    double stepM = 0;  // an integer source's own step, metres; 0 for a float source
    // The lowest and highest of the file's samples, fillM included where it was used, metres. All heights
    // that sample() gives lie in [minM, maxM].
    double minM = 0;
    double maxM = 0;
    std::uint64_t sampleCount = 0;
    std::uint64_t missingCount = 0;  // samples without data, filled
    // Colours only: the number of the cube's edges along which six faces differ visibly, and the notice that
    // says so. 0 and empty if the faces agree.
    int seamEdges = 0;
    std::string notice{};

    // Fills out, row-major, columns x rows heights in metres. A sample's value depends only on its point of
    // the cube and faceCells, never on the tile or the face it is asked through, so shared edges are
    // bit-identical. Filtered: a source finer than the grid is averaged over the grid's spacing, a coarser
    // one is interpolated smoothly; faces on a grid of their own size are copied exactly. Where faces differ
    // by rounding along an edge of the cube, the first in enum order is taken. A call needs about 16 MB
    // besides the cache. The Error names the file.
    std::function<Result<void>(const SampleTile& tile, std::span<float> out)> sample;
};

struct HeightSourceSettings {
    // height = offsetM + metresPerUnit * value, where the file says nothing else: 1 and 0. metresPerUnit, not
    // 0, overrides the file's scale, offset and unit; offsetM, metres, overrides its offset alone.
    std::optional<double> metresPerUnit;
    std::optional<double> offsetM;
    // A value that means "missing", instead of the file's own GDAL_NODATA; NaN and infinities always do.
    std::optional<double> noDataValue;
    double fillM = 0;            // height given to missing samples, metres
    std::optional<int> rawSize;  // raw faces: samples a side, where the name does not say
    std::optional<int> rawBits;  // raw faces: 8 or 16, where the file's length does not say
    bool rawSigned = false;      // raw faces of 16 bits: signed steps
    bool rawBigEndian = false;   // raw faces of 16 bits
    // [0, 2]: the source gives that channel of a colour image instead of heights, as linear light in [0, 1].
    // Integers are read as sRGB, floats as linear light. A grey image is the same in all three; alpha is
    // ignored.
    std::optional<int> colourChannel;
    // The most memory spent on heights, bytes; 4 bytes each. A larger source is read in blocks; one whose
    // file has no blocks, such as a PNG, is copied once to a temporary file.
    std::size_t cacheBytes = 48u << 20;
    FileCalls fileCalls = systemFileCalls();  // for raw faces and that temporary file
};

}  // namespace planet
