// How the values of a source's files become heights.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>

#include "planet/base/file_calls.h"
#include "planet/raster/survey_share.h"

namespace planet {

struct HeightSourceSettings {
    // height = offsetM + metresPerUnit * value; 0 and 1 if neither the settings nor the file say otherwise.
    // metresPerUnit, not 0, overrides the file's scale, offset and unit; offsetM, metres, overrides only its
    // offset.
    std::optional<double> metresPerUnit;
    std::optional<double> offsetM;
    // The value that means "missing", instead of the file's GDAL_NODATA; NaN and infinities always do.
    std::optional<double> noDataValue;
    double fillM = 0;            // height of missing samples, metres
    std::optional<int> rawSize;  // raw faces: samples per side, if the name does not say
    std::optional<int> rawRows;  // raw images with a place: rows of rawSize samples; unset: rawSize
    std::optional<int> rawBits;  // raw faces: 8 or 16, if the file's length does not say
    bool rawSigned = false;      // raw faces of 16 bits: signed steps
    bool rawBigEndian = false;   // raw faces of 16 bits
    // [0, 2]: the source returns this channel of a colour image instead of heights, as linear light in [0,
    // 1]. Integers are read as sRGB, floats as linear light. A grey image is the same in all three channels;
    // alpha is ignored.
    std::optional<int> colourChannel;
    // Rasters that cannot be opened or read are left out, and HeightSource::skipped tells of them. Otherwise they are an
    // Error.
    bool skipBroken = false;
    // Memory limit for heights, bytes; each takes 4 bytes. A larger source is read in blocks; if its file has
    // no blocks, such as a PNG or a GeoTIFF in strips, it is copied once to a temporary file.
    std::size_t cacheBytes = 48u << 20;
    FileCalls fileCalls = systemFileCalls();  // for raw faces and the temporary file
    // A request ends the opening of a source, which may read every sample, with an Error of the kind Cancelled.
    std::stop_token stop{};
    // Set in a process that opens the source together with others. Null: it reads everything itself.
    std::shared_ptr<const SurveyShare> share{};
};

}  // namespace planet
