#include "planet/raster/height_raster.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

#include "planet/base/cpu_clones.h"
#include "planet/base/error_bytes.h"
#include "planet/base/little_endian.h"
#include "planet/base/parallel.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"

namespace planet {

namespace {

template <class T>
T loadSample(const std::byte* from, bool swapBytes) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if (swapBytes) std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
}

// Returns whether a value means "missing"; a float file cannot hold every double exactly.
template <class T>
bool isNoData(T value, double noDataValue) {
    if constexpr (std::is_same_v<T, float>) {
        return value == static_cast<float>(noDataValue);
    } else {
        return static_cast<double>(value) == noDataValue;
    }
}

// Decodes sRGB (IEC 61966-2-1).
double linearFromSrgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

template <class T>
double converted(const HeightConversion& conversion, T value) {
    const double scaled = conversion.offsetM + conversion.metresPerUnit * static_cast<double>(value);
    return conversion.decodesSrgb ? linearFromSrgb(scaled) : scaled;
}

template <class T>
HeightStatistics convertSamples(const HeightConversion& conversion, std::span<const std::byte> native,
                                std::span<float> out) {
    HeightStatistics statistics;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const T value = loadSample<T>(native.data() + i * sizeof(T), conversion.swapBytes);
        auto height = static_cast<float>(converted(conversion, value));
        if (!std::isfinite(height) || (conversion.noDataValue && isNoData(value, *conversion.noDataValue))) {
            height = conversion.fillM;
            ++statistics.missingCount;
        }
        out[i] = height;
        statistics.minM = std::min(statistics.minM, height);
        statistics.maxM = std::max(statistics.maxM, height);
    }
    return statistics;
}

// Does the same for the order of bytes of this machine and heights that are linear in the values, which the compiler
// vectorises. Missing heights are NaN.
template <class T>
PLANET_ALWAYS_INLINE void convertLinear(const HeightConversion& conversion, const std::byte* native,
                                        std::size_t count, float* __restrict out) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();  // equals no value
    constexpr float most = std::numeric_limits<float>::max();
    const double offsetM = conversion.offsetM;
    const double metresPerUnit = conversion.metresPerUnit;
    const double noData = conversion.noDataValue.value_or(none);
    const auto noDataFloat = static_cast<float>(noData);
    for (std::size_t i = 0; i < count; ++i) {
        T value;
        std::memcpy(&value, native + i * sizeof(T), sizeof(T));
        const auto height = static_cast<float>(offsetM + metresPerUnit * static_cast<double>(value));
        bool isMissing;
        if constexpr (std::is_same_v<T, float>) {
            isMissing = value == noDataFloat;
        } else {
            isMissing = static_cast<double>(value) == noData;
        }
        const bool isFinite = height >= -most && height <= most;
        out[i] = isMissing || !isFinite ? std::numeric_limits<float>::quiet_NaN() : height;
    }
}

// Fills in missing heights and returns the statistics.
PLANET_CPU_CLONES HeightStatistics fillMissing(float fillM, std::size_t count, float* out) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> lowest;
    std::array<float, lanes> highest;
    HeightStatistics statistics;
    lowest.fill(statistics.minM);
    highest.fill(statistics.maxM);
    std::array<std::int32_t, lanes> missing{};
    const auto take = [&](std::size_t i, std::size_t lane) {
        const bool isMissing = std::isnan(out[i]);
        const float height = isMissing ? fillM : out[i];
        out[i] = height;
        missing[lane] += isMissing ? 1 : 0;
        // A NaN to fill in counts as no height.
        lowest[lane] = height < lowest[lane] ? height : lowest[lane];
        highest[lane] = height > highest[lane] ? height : highest[lane];
    };
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) take(i + lane, lane);
    }
    for (; i < count; ++i) take(i, 0);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        statistics.minM = std::min(statistics.minM, lowest[lane]);
        statistics.maxM = std::max(statistics.maxM, highest[lane]);
        statistics.missingCount += static_cast<std::uint64_t>(missing[lane]);
    }
    return statistics;
}

PLANET_CPU_CLONES void convertLinearSamples(const HeightConversion& conversion, const std::byte* native,
                                            std::size_t count, float* out) {
    switch (conversion.type) {
        case SampleType::Uint8:
            return convertLinear<std::uint8_t>(conversion, native, count, out);
        case SampleType::Int8:
            return convertLinear<std::int8_t>(conversion, native, count, out);
        case SampleType::Uint16:
            return convertLinear<std::uint16_t>(conversion, native, count, out);
        case SampleType::Int16:
            return convertLinear<std::int16_t>(conversion, native, count, out);
        case SampleType::Uint32:
            return convertLinear<std::uint32_t>(conversion, native, count, out);
        case SampleType::Int32:
            return convertLinear<std::int32_t>(conversion, native, count, out);
        case SampleType::Float:
            return convertLinear<float>(conversion, native, count, out);
        case SampleType::Double:
            return convertLinear<double>(conversion, native, count, out);
    }
}

}  // namespace

void addTo(HeightStatistics& sum, const HeightStatistics& part) {
    sum.minM = std::min(sum.minM, part.minM);
    sum.maxM = std::max(sum.maxM, part.maxM);
    sum.missingCount += part.missingCount;
}

HeightStatistics convertToMetres(const HeightConversion& conversion, std::span<const std::byte> native,
                                 std::span<float> out) {
    assert(native.size() == out.size() * bytesOf(conversion.type));
    if (!conversion.swapBytes && !conversion.decodesSrgb) {
        convertLinearSamples(conversion, native.data(), out.size(), out.data());
        return fillMissing(conversion.fillM, out.size(), out.data());
    }
    constexpr std::array<decltype(&convertSamples<float>), sampleTypeCount> converters = {
        convertSamples<std::uint8_t>, convertSamples<std::int8_t>,   convertSamples<std::uint16_t>,
        convertSamples<std::int16_t>, convertSamples<std::uint32_t>, convertSamples<std::int32_t>,
        convertSamples<float>,        convertSamples<double>};
    return converters[static_cast<std::size_t>(conversion.type)](conversion, native, out);
}

std::size_t HeightBlockKey::Hash::operator()(const HeightBlockKey& key) const {
    return XXH3_64bits(&key, sizeof(key));
}

template <class Sample>
Result<typename BlockCache<Sample>::Block> BlockCache<Sample>::get(
    const HeightBlockKey& key, const std::function<Result<std::vector<Sample>>()>& load) {
    if (Block kept = find(key)) return kept;
    // The block is loaded without the lock. Two threads may load the same block, which is slower but correct.
    TRY_ASSIGN(auto loaded, load());
    Block block = std::make_shared<const std::vector<Sample>>(std::move(loaded));
    insert(key, block);
    return block;
}

template <class Sample>
std::size_t BlockCache<Sample>::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

template <class Sample>
typename BlockCache<Sample>::Block BlockCache<Sample>::find(const HeightBlockKey& key) {
    const std::lock_guard lock(mutex_);
    const auto found = byKey_.find(key);
    if (found == byKey_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->block;
}

template <class Sample>
void BlockCache<Sample>::insert(const HeightBlockKey& key, const Block& block) {
    const std::size_t blockBytes = block->size() * sizeof(Sample);
    const std::size_t limit = limit_();
    const std::lock_guard lock(mutex_);
    if (byKey_.contains(key) || blockBytes > limit) return;
    while (bytes_ + blockBytes > limit) {
        bytes_ -= entries_.back().block->size() * sizeof(Sample);
        byKey_.erase(entries_.back().key);
        entries_.pop_back();
    }
    entries_.push_front({key, block});
    byKey_.emplace(key, entries_.begin());
    bytes_ += blockBytes;
}

template class BlockCache<float>;
template class BlockCache<std::byte>;

HeightRaster HeightRaster::whole(int width, int height, std::vector<float> heightsM,
                                 const HeightStatistics& statistics) {
    assert(heightsM.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    HeightRaster raster;
    raster.width_ = width;
    raster.height_ = height;
    raster.whole_ = std::make_shared<const std::vector<float>>(std::move(heightsM));
    raster.statistics_ = statistics;
    return raster;
}

HeightRaster HeightRaster::inBlocks(int width, int height, const HeightConversion& conversion, Blocks blocks,
                                    const std::optional<HeightStatistics>& statistics) {
    assert(blocks.width > 0 && blocks.height > 0 && blocks.read && blocks.cache);
    HeightRaster raster;
    raster.width_ = width;
    raster.height_ = height;
    raster.conversion_ = conversion;
    raster.blocks_ = std::move(blocks);
    raster.statistics_ = statistics;
    return raster;
}

RasterRect HeightRaster::blockRect(int blockX, int blockY) const {
    const int x = blockX * blocks_.width;
    const int y = blockY * blocks_.height;
    return {x, y, std::min(blocks_.width, width_ - x), std::min(blocks_.height, height_ - y)};
}

// A cache of 16-bit samples holds twice as many as one of heights, and only what is sampled is converted. Colours are
// converted once, because decoding sRGB is slow.
bool HeightRaster::cachesStored() const {
    return bytesOf(conversion_.type) <= sizeof(float) && !conversion_.decodesSrgb;
}

Result<std::vector<std::byte>> HeightRaster::readStored(int blockX, int blockY) const {
    std::vector<std::byte> stored(static_cast<std::size_t>(blocks_.width) *
                                  static_cast<std::size_t>(blocks_.height) * bytesOf(conversion_.type));
    TRY(blocks_.read(blockX, blockY, stored));
    return stored;
}

HeightStatistics HeightRaster::convertBlock(const RasterRect& block, std::span<const std::byte> stored,
                                            std::span<float> out) const {
    const std::size_t sampleBytes = bytesOf(conversion_.type);
    const std::size_t rowBytes = static_cast<std::size_t>(blocks_.width) * sampleBytes;
    const auto inside = static_cast<std::size_t>(block.width);
    HeightStatistics statistics;
    for (std::size_t row = 0; row < static_cast<std::size_t>(block.height); ++row) {
        addTo(statistics, convertToMetres(conversion_, stored.subspan(row * rowBytes, inside * sampleBytes),
                                          out.subspan(row * inside, inside)));
    }
    return statistics;
}

Result<std::vector<std::byte>> HeightRaster::loadBlock(int blockX, int blockY) const {
    TRY_ASSIGN(auto stored, readStored(blockX, blockY));
    if (cachesStored()) return stored;
    const RasterRect rect = blockRect(blockX, blockY);
    std::vector<float> heights(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
    convertBlock(rect, stored, heights);
    const auto bytes = std::as_bytes(std::span(heights));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
}

namespace {

// Calls visit(source, target, count) for each row of the intersection of two rectangles: its first sample in either, and
// the number of its samples.
template <class Visit>
void forSharedRows(const RasterRect& from, std::size_t fromStride, const RasterRect& to, std::size_t toStride,
                   const Visit& visit) {
    const int x0 = std::max(from.x, to.x);
    const int x1 = std::min(from.x + from.width, to.x + to.width);
    const int y0 = std::max(from.y, to.y);
    const int y1 = std::min(from.y + from.height, to.y + to.height);
    for (int y = y0; y < y1; ++y) {
        visit(static_cast<std::size_t>(y - from.y) * fromStride + static_cast<std::size_t>(x0 - from.x),
              static_cast<std::size_t>(y - to.y) * toStride + static_cast<std::size_t>(x0 - to.x),
              static_cast<std::size_t>(x1 - x0));
    }
}

}  // namespace

Result<void> HeightRaster::read(const RasterRect& rect, float* out, std::size_t strideSamples) const {
    assert(rect.x >= 0 && rect.y >= 0 && rect.x + rect.width <= width_ && rect.y + rect.height <= height_);
    if (rect.width <= 0 || rect.height <= 0) return {};
    if (whole_) {
        forSharedRows({0, 0, width_, height_}, static_cast<std::size_t>(width_), rect, strideSamples,
                      [&](std::size_t source, std::size_t target, std::size_t count) {
                          std::copy_n(whole_->data() + source, count, out + target);
                      });
        return {};
    }
    for (int blockY = rect.y / blocks_.height; blockY * blocks_.height < rect.y + rect.height; ++blockY) {
        for (int blockX = rect.x / blocks_.width; blockX * blocks_.width < rect.x + rect.width; ++blockX) {
            const HeightBlockKey key{blocks_.cacheSlot, blockX, blockY};
            TRY_ASSIGN(const auto block, blocks_.cache->get(key, [&] { return loadBlock(blockX, blockY); }));
            const RasterRect place = blockRect(blockX, blockY);
            if (cachesStored()) {
                const std::size_t sampleBytes = bytesOf(conversion_.type);
                forSharedRows(place, static_cast<std::size_t>(blocks_.width), rect, strideSamples,
                              [&](std::size_t source, std::size_t target, std::size_t count) {
                                  convertToMetres(
                                      conversion_,
                                      std::span(*block).subspan(source * sampleBytes, count * sampleBytes),
                                      std::span(out + target, count));
                              });
            } else {
                forSharedRows(place, static_cast<std::size_t>(place.width), rect, strideSamples,
                              [&](std::size_t source, std::size_t target, std::size_t count) {
                                  std::memcpy(out + target, block->data() + source * sizeof(float),
                                              count * sizeof(float));
                              });
            }
        }
    }
    return {};
}

namespace {

// The statistics that a process has found, or its Error, for the others. size: of the raster, so that processes with different
// ones notice.
std::vector<std::byte> surveyBytes(const std::array<std::int64_t, 2>& size,
                                   const Result<HeightStatistics>& statistics) {
    std::vector<std::byte> bytes;
    ByteWriter to(bytes);
    for (const std::int64_t side : size) to.put(side);
    to.put(static_cast<std::uint8_t>(statistics.has_value()));
    if (!statistics) {
        putError(bytes, statistics.error());
        return bytes;
    }
    to.put(statistics->minM);
    to.put(statistics->maxM);
    to.put(statistics->missingCount);
    return bytes;
}

// Returns the statistics of all processes together, or the first Error; nothing if one has another raster.
std::optional<Result<HeightStatistics>> joinedStatistics(const std::array<std::int64_t, 2>& size,
                                                         std::span<const std::vector<std::byte>> all) {
    Result<HeightStatistics> joined = HeightStatistics();
    for (const std::vector<std::byte>& theirs : all) {
        ByteReader in(theirs);
        if (theirs.size() < sizeof(size)) return std::nullopt;
        for (const std::int64_t side : size) {
            if (in.get<std::int64_t>() != side) return std::nullopt;
        }
        if (in.get<std::uint8_t>() == 0) {
            if (joined) joined = tl::unexpected(takeError(in));
            continue;
        }
        HeightStatistics part;
        part.minM = in.get<float>();
        part.maxM = in.get<float>();
        part.missingCount = in.get<std::uint64_t>();
        if (joined) addTo(*joined, part);
    }
    return joined;
}

}  // namespace

Result<HeightStatistics> HeightRaster::statisticsOf(const SurveyShare& part,
                                                    const std::stop_token& stop) const {
    const int across = (width_ + blocks_.width - 1) / blocks_.width;
    const int down = (height_ + blocks_.height - 1) / blocks_.height;
    HeightStatistics statistics;
    std::optional<std::pair<std::size_t, Error>> problem;  // of the first block that has one
    std::mutex mutex;
    parallelFor(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), [&](std::size_t block) {
        if (!part.reads(block) || stop.stop_requested()) return;
        {
            const std::lock_guard lock(mutex);
            if (problem && problem->first < block) return;
        }
        const int x = static_cast<int>(block) % across;
        const int y = static_cast<int>(block) / across;
        const auto stored = readStored(x, y);
        if (!stored) {
            const std::lock_guard lock(mutex);
            if (!problem || block < problem->first) problem = {block, stored.error()};
            return;
        }
        const RasterRect rect = blockRect(x, y);
        std::vector<float> heights(static_cast<std::size_t>(rect.width) *
                                   static_cast<std::size_t>(rect.height));
        const HeightStatistics ofBlock = convertBlock(rect, *stored, heights);
        const std::lock_guard lock(mutex);
        addTo(statistics, ofBlock);
    });
    if (stop.stop_requested()) return cancelled();
    if (problem) return tl::unexpected(std::move(problem->second));
    return statistics;
}

Result<HeightStatistics> HeightRaster::statistics(const std::stop_token& stop,
                                                  const SurveyShare* share) const {
    if (statistics_) return *statistics_;
    if (share) {
        const Stopwatch stopwatch;
        const Result<HeightStatistics> own = statisticsOf(*share, stop);
        if (!own && own.error().kind == ErrorKind::Cancelled) return own;
        const std::array<std::int64_t, 2> size = {width_, height_};
        if (const auto all = share->exchange(surveyBytes(size, own), stopwatch.elapsedS())) {
            if (auto joined = joinedStatistics(size, *all)) return *std::move(joined);
        }
    }
    return statisticsOf({}, stop);
}

}  // namespace planet
