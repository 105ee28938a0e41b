// A raster of heights on a grid of its own: what a mosaic joins. Internal to the library.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/vertical_datum.h"

namespace planet {

struct RasterLayout {
    int width = 0;  // samples, [1, 2^22]
    int height = 0;
    int blockWidth = 0;  // samples that are decoded together; the last blocks of a row or column are cut off
    int blockHeight = 0;
    // Maps a sample's (column, row) to the coordinates of its centre in the reference system: x = x[0] + x[1]
    // column + x[2] row, and y likewise.
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    std::string crs;           // the horizontal coordinate reference system as WKT 2 or a PROJ string
    std::string crsName;       // "WGS 84 / UTM zone 19S"
    std::string verticalName;  // "EGM96 height", which the file says its heights are; empty: it does not say
    std::optional<VerticalDatum> datum;  // of that name; unset: none that a world file can name
    std::string typeName;                // "int16"
    HeightConversion conversion;         // from floats, which hold the values of all types that heights need
    double stepM = 0;                    // of an integer raster, metres; 0 for floats
};

// An open raster. Several threads may read at once.
class Raster {
public:
    virtual ~Raster() = default;
    Raster(const Raster&) = delete;
    Raster& operator=(const Raster&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const RasterLayout& layout() const { return layout_; }

    // Reads a block as heights in metres, row-major, with NaN for missing samples. The last blocks of a row or column
    // are narrower or lower. The Error names the file and the block.
    virtual Result<std::vector<float>> readBlock(int blockX, int blockY) const = 0;
    // Returns whether the file is known to store nothing for a block, whose samples are all missing then.
    virtual bool isEmpty(int /*blockX*/, int /*blockY*/) const { return false; }
    // Returns of how many rows of blocks the file is read when the first block in them is asked for. Other threads that ask
    // for one of these blocks wait meanwhile. 0: each block is read by itself.
    virtual int rowsReadTogether() const { return 0; }
    // Returns how many samples of the file were read so far, if those are not the samples of the blocks that were read.
    virtual std::optional<std::uint64_t> samplesRead() const { return std::nullopt; }

protected:
    Raster() = default;

    std::filesystem::path path_;
    RasterLayout layout_;
};

// Remembers which surface the first raster says that its heights are measured from.
class ToldDatum {
public:
    // Returns an Error that names both files if the raster says another datum than the first one did. The caller gives the
    // end of the message in `expected`: it tells the user what to write instead.
    Result<void> add(const Raster& raster, std::string_view expected);

private:
    std::filesystem::path path_;  // empty: no raster has said anything
    std::string name_;
    std::optional<VerticalDatum> datum_;
};

}  // namespace planet
