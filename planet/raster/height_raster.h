// A rectangular grid of heights in metres from an image or a raw file. Small ones are kept whole in memory;
// others are read block by block through a cache of bounded size. Internal to the library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"
#include "planet/raster/geo_tags.h"
#include "planet/raster/height_source_settings.h"

namespace planet {

enum class SampleType : std::uint8_t { Uint8, Int8, Uint16, Int16, Uint32, Int32, Float, Double };
inline constexpr std::size_t sampleTypeCount = 8;
inline std::size_t bytesOf(SampleType type) {
    constexpr std::array<std::size_t, sampleTypeCount> bytes = {1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

// The conversion of stored values to metres.
struct HeightConversion {
    SampleType type = SampleType::Int16;
    bool swapBytes = false;    // opposite to this machine's byte order
    double metresPerUnit = 1;  // height = offsetM + metresPerUnit * value
    double offsetM = 0;        // metres
    bool decodesSrgb = false;  // the converted values are shares of white in sRGB, and become linear light
    std::optional<double> noDataValue;  // missing, as are all values without a finite height
    float fillM = 0;                    // height of missing samples, metres
};

// Returns the conversion by the settings or, if they are unset, by the file's tags. The Error names an
// unknown unit.
Result<HeightConversion> conversionFor(const std::string& file, const HeightSourceSettings& settings,
                                       SampleType type, const GeoTags& tags);

struct HeightStatistics {
    float minM = std::numeric_limits<float>::infinity();  // of all samples, including filled ones
    float maxM = -std::numeric_limits<float>::infinity();
    std::uint64_t missingCount = 0;
};
void addTo(HeightStatistics& sum, const HeightStatistics& part);

// Converts out.size() samples; native has exactly as many. Any thread.
HeightStatistics convertToMetres(const HeightConversion& conversion, std::span<const std::byte> native,
                                 std::span<float> out);

// A block of one of the rasters that share a cache.
struct HeightBlockKey {
    std::uint64_t raster = 0;
    std::int32_t x = 0;  // counted in blocks
    std::int32_t y = 0;

    bool operator==(const HeightBlockKey&) const = default;
    struct Hash {
        std::size_t operator()(const HeightBlockKey& key) const;
    };
};

// Caches the most recently used blocks: at most a limit of bytes besides those in use. Thread-safe.
template <class Sample>
class BlockCache {
public:
    using Block = std::shared_ptr<const std::vector<Sample>>;

    explicit BlockCache(std::size_t maxBytes) : limit_([maxBytes] { return maxBytes; }) {}
    // limit is asked for before each new block, by any thread.
    explicit BlockCache(std::function<std::size_t()> limit) : limit_(std::move(limit)) {}

    // Returns the block of a key; calls load() if it is not cached.
    Result<Block> get(const HeightBlockKey& key, const std::function<Result<std::vector<Sample>>()>& load);
    std::size_t bytes() const;  // currently cached

private:
    struct Entry {
        HeightBlockKey key;
        Block block;
    };
    Block find(const HeightBlockKey& key);
    void insert(const HeightBlockKey& key, const Block& block);

    const std::function<std::size_t()> limit_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  // most recently used first
    std::unordered_map<HeightBlockKey, typename std::list<Entry>::iterator, HeightBlockKey::Hash> byKey_;
    std::size_t bytes_ = 0;
};
extern template class BlockCache<float>;
extern template class BlockCache<std::byte>;

using HeightBlockCache = BlockCache<float>;
// Blocks as a file stores them, or heights.
using StoredBlockCache = BlockCache<std::byte>;

struct RasterRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

// Copies share the open files. Thread-safe.
class HeightRaster {
public:
    struct Blocks {
        int width = 0;  // samples per block; blocks extend beyond the right and bottom edges
        int height = 0;
        // Fills a block's native samples, row-major; samples beyond the edges may have any value.
        std::function<Result<void>(int blockX, int blockY, std::span<std::byte> native)> read;
        std::shared_ptr<StoredBlockCache> cache;
        std::uint64_t cacheSlot = 0;  // distinguishes rasters that share a cache
    };

    HeightRaster() = default;
    static HeightRaster whole(int width, int height, std::vector<float> heightsM,
                              const HeightStatistics& statistics);
    // Makes a raster that is read in blocks. statistics: if already known, to avoid the scan.
    static HeightRaster inBlocks(int width, int height, const HeightConversion& conversion, Blocks blocks,
                                 const std::optional<HeightStatistics>& statistics = {});

    int width() const { return width_; }
    int height() const { return height_; }

    // Copies a rectangle of the grid; its row r starts at out + r * strideSamples.
    Result<void> read(const RasterRect& rect, float* out, std::size_t strideSamples) const;

    // Returns the statistics of all samples. If they are unknown, it reads each sample once, in parallel, unless a stop is
    // requested; with `share`, each of its processes reads its part.
    Result<HeightStatistics> statistics(const std::stop_token& stop = {},
                                        const SurveyShare* share = nullptr) const;

private:
    RasterRect blockRect(int blockX, int blockY) const;  // clipped to the grid
    bool cachesStored() const;  // whether the cache holds samples as the file stores them, and no heights
    Result<std::vector<std::byte>> readStored(int blockX, int blockY) const;
    // Reads the blocks of a part of so many.
    Result<HeightStatistics> statisticsOf(const SurveyShare& part, const std::stop_token& stop) const;
    // Returns a block for the cache; its rows have the same number of samples.
    Result<std::vector<std::byte>> loadBlock(int blockX, int blockY) const;
    // Converts the part of a block that lies on the grid; out has as many samples.
    HeightStatistics convertBlock(const RasterRect& block, std::span<const std::byte> stored,
                                  std::span<float> out) const;

    int width_ = 0;
    int height_ = 0;
    std::shared_ptr<const std::vector<float>> whole_;
    std::optional<HeightStatistics> statistics_;
    HeightConversion conversion_;
    Blocks blocks_;
};

// The header of an image.
struct ImageLayout {
    int width = 0;
    int height = 0;
    int originX = 0;  // of the first sample, in the file's own coordinates
    int originY = 0;
    int tileWidth = 0;  // 0: not tiled
    int tileHeight = 0;
    SampleType type = SampleType::Uint8;
    std::string typeName;  // "int16"; "half" is read as Float
    GeoTags geoTags;       // of a TIFF
};

// A channel of an image, open for reading by several threads; each borrows a reader of its own.
class ImageFile {
public:
    // Opens an image. colourChannel: as in HeightSourceSettings; without it the image must have one grey
    // channel. The Error says that the file is missing or unreadable, or has other channels or an unsupported
    // sample type.
    static Result<std::shared_ptr<ImageFile>> open(const std::filesystem::path& path,
                                                   std::optional<int> colourChannel);
    ~ImageFile();

    const std::filesystem::path& path() const { return path_; }
    const ImageLayout& layout() const { return layout_; }

    // Reads the native samples of the tile that contains (x, y), counted from the first sample.
    Result<void> readTile(int x, int y, std::span<std::byte> native);
    // Reads the native samples of rows [firstRow, firstRow + count). Ascending calls are fastest.
    Result<void> readRows(int firstRow, int count, std::span<std::byte> native);

private:
    struct Readers;
    ImageFile(std::filesystem::path path, ImageLayout layout, int channel, std::unique_ptr<Readers> readers);

    std::filesystem::path path_;
    ImageLayout layout_;
    int channel_ = 0;
    std::unique_ptr<Readers> readers_;
};

struct RasterMemory {
    std::shared_ptr<StoredBlockCache> cache;
    std::uint64_t cacheSlot = 0;      // distinguishes rasters that share the cache
    std::size_t wholeLimitBytes = 0;  // an untiled image up to this size is kept whole
};

// Opens an image. A tiled image is read tile by tile. An untiled one is kept whole in memory if it fits.
// Otherwise it is copied once to a nameless temporary file, which disappears with the raster even if the
// program is killed.
Result<HeightRaster> openImageRaster(const std::shared_ptr<ImageFile>& image,
                                     const HeightConversion& conversion, const RasterMemory& memory,
                                     const FileCalls& calls = systemFileCalls());

// Opens a headerless file of width x height samples, rows from the top. The caller must check its length.
Result<HeightRaster> openRawRaster(const std::filesystem::path& path, int width, int height,
                                   const HeightConversion& conversion, const RasterMemory& memory,
                                   const FileCalls& calls = systemFileCalls());

}  // namespace planet
