// Samples an equirectangular image of the whole planet, north up, placed by ImagePlacement.
//
// The image continues without end: columns wrap, and a row beyond a pole is the row at the same distance on
// this side, half a turn further. The kernel covers a cell of the filter's grid, (pi/2) / filterCells
// radians, divided by cos(latitude) in longitude; at a pole that is the whole row.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "planet/base/cpu_clones.h"
#include "planet/base/try.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/image_placement.h"
#include "planet/source/height_filter.h"
#include "planet/source/height_geographic.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/whole_layer.h"

namespace planet {

namespace {

constexpr int pieceSide = 65;                    // samples per side of a piece of a tile
constexpr std::size_t regionSamples = 3u << 20;  // samples of the image in memory at once: 12 MB

// Returns the number of rows from pole to pole.
int rowsToPole(const ImagePlacement& placement, int height) {
    return placement.hasPoleRows ? height - 1 : height;
}

// The projection of a grid's samples onto the image.
struct Projection {
    ImagePlacement placement;
    int width = 0;  // columns once around the planet
    int height = 0;
    double columnsPerRad = 0;
    double rowsPerRad = 0;
    double stretchAtEquator = 0;  // of the kernel in longitude, before it is clamped to [1, width / 4]
    float stretchRows = 1;        // of the kernel in latitude

    Projection(const ImagePlacement& imagePlacement, int imageHeight, int filterCells)
        : placement(imagePlacement),
          width(imagePlacement.period),
          height(imageHeight),
          columnsPerRad(width / (2 * std::numbers::pi)),
          rowsPerRad(rowsToPole(imagePlacement, imageHeight) / std::numbers::pi),
          stretchAtEquator(width / (4.0 * filterCells)),
          stretchRows(static_cast<float>(
              std::max(1.0, rowsToPole(imagePlacement, imageHeight) / (2.0 * filterCells)))) {}

    // A kernel with a larger stretch in longitude would overlap itself, and covers the whole row.
    double wholeRow() const { return width / 4.0; }
};

// The taps of every sample of a piece: rows and columns of the endless image.
struct PieceTaps {
    std::vector<int> firstColumn;
    std::vector<int> firstRow;
    std::vector<int> columnGroups;      // groups of four taps
    std::vector<float> column;          // position of the sample, relative to its first tap
    std::vector<float> row;             // likewise
    std::vector<float> stretchColumns;  // 0: all samples of the row have the same weight

    explicit PieceTaps(std::size_t count)
        : firstColumn(count),
          firstRow(count),
          columnGroups(count),
          column(count),
          row(count),
          stretchColumns(count) {}
};

// A rectangle of the endless image.
struct Region {
    int column = 0;
    int row = 0;
    int columns = 0;
    int rows = 0;
};

int wrapped(int value, int period) {
    const int remainder = value % period;
    return remainder < 0 ? remainder + period : remainder;
}

// Fills in the taps of places whose kernel is narrower than a row of the image. The compiler vectorises the loop only with
// pointers that are parameters.
PLANET_CPU_CLONES void fillTaps(const Projection& projection, const double* __restrict longitudes,
                                const double* __restrict latitudes, const double* __restrict rings, int count,
                                int* __restrict firstColumns, int* __restrict firstRows,
                                int* __restrict groups, float* __restrict columns, float* __restrict rows,
                                float* __restrict stretches) {
    const double columnsPerRad = projection.columnsPerRad;
    const double rowsPerRad = projection.rowsPerRad;
    const double stretchAtEquator = projection.stretchAtEquator;
    const double mostStretch = projection.wholeRow();
    const double middleColumn = projection.placement.zeroColumn;
    const double middleRow = projection.height / 2.0 - 0.5;
    const double reachRows = 2.0 * projection.stretchRows;
    // The bias makes truncation to an int a floor.
    const int columnBias = 2 * projection.width + 4;
    const int rowBias = 2 * projection.height + 4;
    for (int i = 0; i < count; ++i) {
        const double column = middleColumn + longitudes[i] * columnsPerRad;
        const double row = middleRow - latitudes[i] * rowsPerRad;
        const double wanted = stretchAtEquator / (rings[i] + 1e-30);
        const double atLeast1 = wanted < 1 ? 1.0 : wanted;
        const double stretch = wanted > mostStretch ? mostStretch : atLeast1;
        const int below = static_cast<int>(stretch);
        const int firstColumn = static_cast<int>(column - 2 * stretch + columnBias) - columnBias + 1;
        const int firstRow = static_cast<int>(row - reachRows + rowBias) - rowBias + 1;
        firstColumns[i] = firstColumn;
        firstRows[i] = firstRow;
        columns[i] = static_cast<float>(column - firstColumn);
        rows[i] = static_cast<float>(row - firstRow);
        stretches[i] = static_cast<float>(stretch);
        groups[i] = below + (stretch > below ? 1 : 0);
    }
}

void tapsOfRow(const Projection& projection, const GeographicRow& places, std::size_t begin,
               PieceTaps& taps) {
    const std::size_t count = places.ring.size();
    const std::span groups = std::span(taps.columnGroups).subspan(begin, count);
    fillTaps(projection, places.longitudeRad.data(), places.latitudeRad.data(), places.ring.data(),
             static_cast<int>(count), taps.firstColumn.data() + begin, taps.firstRow.data() + begin,
             groups.data(), taps.column.data() + begin, taps.row.data() + begin,
             taps.stretchColumns.data() + begin);
    if (std::ranges::max(groups) < projection.wholeRow()) return;
    // Near a pole, the kernel covers the whole row.
    for (std::size_t i = 0; i < count; ++i) {
        if (!(projection.stretchAtEquator / (places.ring[i] + 1e-30) > projection.wholeRow())) continue;
        taps.firstColumn[begin + i] = 0;
        taps.stretchColumns[begin + i] = 0;
        groups[i] = (projection.width + 3) / 4;
    }
}

PieceTaps tapsOfPiece(const Projection& projection, const SampleTile& piece) {
    const auto columns = static_cast<std::size_t>(piece.columns);
    PieceTaps taps(columns * static_cast<std::size_t>(piece.rows));
    std::vector<double> scratch(3 * columns);
    const std::span places(scratch);
    const GeographicRow row{places.first(columns), places.subspan(columns, columns), places.last(columns)};
    const GeographicColumns grid(piece.face, piece.faceCells, piece.firstColumn, piece.columns);
    for (int r = 0; r < piece.rows; ++r) {
        grid.placesOfRow(piece.firstRow + r, row);
        tapsOfRow(projection, row, static_cast<std::size_t>(r) * columns, taps);
    }
    return taps;
}

// The ends of some taps' ranges of columns and rows.
struct TapRange {
    int firstColumn = std::numeric_limits<int>::max();
    int endColumn = std::numeric_limits<int>::min();
    int firstRow = std::numeric_limits<int>::max();
    int lastFirstRow = std::numeric_limits<int>::min();
};

// Returns the range of all taps. Columns below `least` are moved by one turn to the east.
PLANET_CPU_CLONES TapRange rangeOf(const int* firstColumns, const int* firstRows, const int* groups,
                                   std::size_t count, int least, int turn) {
    TapRange range;
    for (std::size_t i = 0; i < count; ++i) {
        const int first = firstColumns[i] < least ? firstColumns[i] + turn : firstColumns[i];
        range.firstColumn = std::min(range.firstColumn, first);
        range.endColumn = std::max(range.endColumn, first + 4 * groups[i]);
        range.firstRow = std::min(range.firstRow, firstRows[i]);
        range.lastFirstRow = std::max(range.lastFirstRow, firstRows[i]);
    }
    return range;
}

// Returns the smallest region that contains all taps. Moves columns west of the middle by one turn to the
// east if that makes the region narrower, across the date line.
Region regionOf(const Projection& projection, PieceTaps& taps) {
    const int half = static_cast<int>(projection.placement.zeroColumn + 0.5);
    const auto rangeFrom = [&](int least) {
        return rangeOf(taps.firstColumn.data(), taps.firstRow.data(), taps.columnGroups.data(),
                       taps.firstColumn.size(), least, projection.width);
    };
    const TapRange range = rangeFrom(std::numeric_limits<int>::min());
    const int columns = range.endColumn - range.firstColumn;
    const int rows = range.lastFirstRow + tapCount(projection.stretchRows) - range.firstRow;
    // Taps on one side of the middle stay there.
    const TapRange moved = range.firstColumn < half && range.endColumn > half ? rangeFrom(half) : range;
    const int movedColumns = moved.endColumn - moved.firstColumn;
    if (movedColumns >= columns) return {range.firstColumn, range.firstRow, columns, rows};
    for (int& first : taps.firstColumn) first = first < half ? first + projection.width : first;
    return {moved.firstColumn, range.firstRow, movedColumns, rows};
}

// Reads columns, with wrapping, of rows of the image.
Result<void> readWrapped(const HeightRaster& image, int period, int column, int row, int columns, int rows,
                         float* out, std::size_t stride) {
    for (int done = 0; done < columns;) {
        const int from = wrapped(column + done, period);
        const int count = std::min(columns - done, period - from);
        TRY(image.read({from, row, count, rows}, out + done, stride));
        done += count;
    }
    return {};
}

Result<void> readRegion(const HeightRaster& image, const ImagePlacement& placement, const Region& region,
                        std::vector<float>& out) {
    const auto stride = static_cast<std::size_t>(region.columns);
    out.resize(stride * static_cast<std::size_t>(region.rows));
    const int turn = 2 * rowsToPole(placement, image.height());
    for (int done = 0; done < region.rows;) {
        const int turned = wrapped(region.row + done, turn);
        const bool beyondPole = turned >= image.height();
        // The row of a pole is not repeated beyond the pole.
        const int row = beyondPole ? turn - (placement.hasPoleRows ? 0 : 1) - turned : turned;
        const int column = region.column + (beyondPole ? placement.period / 2 : 0);
        const int count = beyondPole ? 1 : std::min(region.rows - done, image.height() - row);
        float* const to = out.data() + static_cast<std::size_t>(done) * stride;
        TRY(readWrapped(image, placement.period, column, row, region.columns, count, to, stride));
        done += count;
    }
    return {};
}

constexpr int fewTaps = 16;  // along an axis

// The taps of a piece and the part of them that lies in a band.
struct BandTaps {
    const PieceTaps& taps;
    float stretchRows;
    Region band;
    const float* samples;  // of the band

    int rowTaps() const { return tapCount(stretchRows); }
    bool areFourByFour(std::size_t sample) const {
        return stretchRows == 1 && taps.stretchColumns[sample] == 1 && haveAllRows(sample);
    }
    // Returns whether there are more taps, but few enough for local memory.
    bool areFew(std::size_t sample) const {
        return taps.stretchColumns[sample] != 0 && 4 * taps.columnGroups[sample] <= fewTaps &&
               rowTaps() <= fewTaps && haveAllRows(sample) && !areFourByFour(sample);
    }
    const float* firstTap(std::size_t sample) const {
        return samples + (taps.firstRow[sample] - band.row) * std::ptrdiff_t{band.columns} +
               (taps.firstColumn[sample] - band.column);
    }

private:
    bool haveAllRows(std::size_t sample) const {
        const int firstRow = taps.firstRow[sample] - band.row;
        return firstRow >= 0 && firstRow + rowTaps() <= band.rows;
    }
};

// Adds the taps of samples [begin, end), which are four by four each, to their four sums.
PLANET_CPU_CLONES void addFourByFour(const BandTaps& band, std::size_t begin, std::size_t end, float* lanes) {
    const std::ptrdiff_t stride = band.band.columns;
    for (std::size_t i = begin; i < end; ++i) {
        const float* const from = band.firstTap(i);
        const Float4 across = catmullRomWeights(band.taps.column[i] - 1);
        const Float4 down = catmullRomWeights(band.taps.row[i] - 1);
        Float4 sum = loadFloat4(lanes + 4 * i);
        sum += down[0] * (across * loadFloat4(from));
        sum += down[1] * (across * loadFloat4(from + stride));
        sum += down[2] * (across * loadFloat4(from + 2 * stride));
        sum += down[3] * (across * loadFloat4(from + 3 * stride));
        storeFloat4(lanes + 4 * i, sum);
    }
}

constexpr std::size_t batchSize = 16;  // samples whose weights are computed at once

// Computes the weights of `taps` taps of each of up to batchSize samples, one sample after the other. Gives the same as
// kernelWeights, with the samples as the inner loop: a sum over the taps of one sample is a chain of additions.
PLANET_ALWAYS_INLINE void batchWeights(const float* positions, const float* stretches, std::size_t count,
                                       std::size_t taps, float* weights) {
    std::array<float, batchSize> position{};
    std::array<float, batchSize> perTap{};
    std::array<float, batchSize> sum{};
    std::array<std::array<float, batchSize>, fewTaps> byTap;
    for (std::size_t s = 0; s < count; ++s) position[s] = positions[s];
    for (std::size_t s = 0; s < count; ++s) perTap[s] = 1 / stretches[s];
    for (std::size_t k = 0; k < taps; ++k) {
        const auto tap = static_cast<float>(static_cast<int>(k));
        for (std::size_t s = 0; s < batchSize; ++s) {
            const float d = std::abs((tap - position[s]) * perTap[s]);
            const float near = (1.5f * d - 2.5f) * d * d + 1;
            const float far = ((-0.5f * d + 2.5f) * d - 4) * d + 2;
            const float within = d < 1 ? near : far;
            byTap[k][s] = d >= 2 ? 0.0f : within;
            sum[s] += byTap[k][s];
        }
    }
    for (std::size_t k = 0; k < taps; ++k) {
        for (std::size_t s = 0; s < batchSize; ++s) byTap[k][s] /= sum[s];
    }
    for (std::size_t s = 0; s < count; ++s) {
        float* const own = weights + s * taps;
        for (std::size_t k = 0; k < taps; ++k) own[k] = byTap[k][s];
        if (stretches[s] == 1) storeFloat4(own, catmullRomWeights(positions[s] - 1));
    }
}

// Does the same as addFourByFour for samples with few taps, which have as many along rows as each other.
PLANET_CPU_CLONES void addFew(const BandTaps& band, std::size_t begin, std::size_t end, float* lanes) {
    const std::ptrdiff_t stride = band.band.columns;
    const auto rowTaps = static_cast<std::size_t>(band.rowTaps());
    const auto columnTaps = static_cast<std::size_t>(4 * band.taps.columnGroups[begin]);
    std::array<float, batchSize * fewTaps> columnWeights;
    std::array<float, batchSize * fewTaps> rowWeights;
    std::array<float, batchSize> stretchRows;
    stretchRows.fill(band.stretchRows);
    for (std::size_t first = begin; first < end; first += batchSize) {
        const std::size_t count = std::min(batchSize, end - first);
        batchWeights(&band.taps.column[first], &band.taps.stretchColumns[first], count, columnTaps,
                     columnWeights.data());
        batchWeights(&band.taps.row[first], stretchRows.data(), count, rowTaps, rowWeights.data());
        for (std::size_t s = 0; s < count; ++s) {
            const float* const across = columnWeights.data() + s * columnTaps;
            const float* const down = rowWeights.data() + s * rowTaps;
            const float* from = band.firstTap(first + s);
            Float4 sum = loadFloat4(lanes + 4 * (first + s));
            for (std::size_t row = 0; row < rowTaps; ++row, from += stride) {
                Float4 rowSum = loadFloat4(across) * loadFloat4(from);
                for (std::size_t k = 4; k < columnTaps; k += 4)
                    rowSum += loadFloat4(across + k) * loadFloat4(from + k);
                sum += down[row] * rowSum;
            }
            storeFloat4(lanes + 4 * (first + s), sum);
        }
    }
}

// Filters the samples of a piece from regions of the image, one band of rows after another.
class PieceFilter {
public:
    PieceFilter(const Projection& projection, const PieceTaps& taps)
        : taps_(taps), width_(projection.width), stretchRows_(projection.stretchRows) {
        rowWeights_.resize(static_cast<std::size_t>(tapCount(stretchRows_)));
    }

    // Adds the rows of a band to the four sums of each sample; bands come in ascending order.
    void add(const Region& region, const float* samples, std::span<float> lanes) {
        const BandTaps band{taps_, stretchRows_, region, samples};
        const std::size_t count = taps_.firstColumn.size();
        for (std::size_t i = 0; i < count;) {
            const std::size_t begin = i;
            while (i < count && band.areFourByFour(i)) ++i;
            if (i > begin) addFourByFour(band, begin, i, lanes.data());
            const std::size_t few = i;
            while (i < count && band.areFew(i) && taps_.columnGroups[i] == taps_.columnGroups[few]) ++i;
            if (i > few) addFew(band, few, i, lanes.data());
            if (i > begin) continue;
            addMany(band, i, lanes.data() + 4 * i);
            ++i;
        }
    }

private:
    void addMany(const BandTaps& band, std::size_t sample, float* lanes) {
        setWeights(sample);
        const int firstRow = taps_.firstRow[sample] - band.band.row;
        const int begin = std::max(0, -firstRow);
        const int end = std::min(static_cast<int>(rowWeights_.size()), band.band.rows - firstRow);
        const float* const from = band.firstTap(sample);
        Float4 sum = loadFloat4(lanes);
        for (int tap = begin; tap < end; ++tap) {
            const float* const row = from + tap * std::ptrdiff_t{band.band.columns};
            Float4 rowSum{};
            for (std::size_t k = 0; k < columnWeights_.size(); k += 4) {
                rowSum += loadFloat4(columnWeights_.data() + k) * loadFloat4(row + k);
            }
            sum += rowWeights_[static_cast<std::size_t>(tap)] * rowSum;
        }
        storeFloat4(lanes, sum);
    }

    void setWeights(std::size_t sample) {
        const float stretch = taps_.stretchColumns[sample];
        columnWeights_.assign(static_cast<std::size_t>(4 * taps_.columnGroups[sample]), 0);
        if (stretch == 0) {
            std::fill_n(columnWeights_.begin(), width_, 1 / static_cast<float>(width_));
        } else {
            kernelWeights(taps_.column[sample], stretch, columnWeights_);
        }
        kernelWeights(taps_.row[sample], stretchRows_, rowWeights_);
    }

    const PieceTaps& taps_;
    int width_;
    float stretchRows_;
    std::vector<float> columnWeights_;
    std::vector<float> rowWeights_;
};

struct Equirectangular {
    HeightRaster image;
    ImagePlacement placement;
    float minM = 0;
    float maxM = 0;
};

// Turns the four sums of each sample into its height.
PLANET_CPU_CLONES void finishRow(const float* __restrict lanes, std::size_t count, float minM, float maxM,
                                 float* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) {
        const float* const sum = lanes + 4 * i;
        const float height = (sum[0] + sum[2]) + (sum[1] + sum[3]);  // sumOfLanes
        const float atLeast = height < minM ? minM : height;
        out[i] = maxM < atLeast ? maxM : atLeast;
    }
}

// The taps and the projection of a piece's samples, for an image of a certain size.
struct PiecePlace {
    Projection projection;
    PieceTaps taps;
    Region region;
};

bool sameSquare(const SampleTile& a, const SampleTile& b) {
    return a.face == b.face && a.faceCells == b.faceCells && filterCellsOf(a) == filterCellsOf(b) &&
           a.firstColumn == b.firstColumn && a.firstRow == b.firstRow && a.columns == b.columns &&
           a.rows == b.rows;
}

// Returns the place of a piece, valid until the next call. Each thread caches its last piece, because the
// three channels of a colour image are sampled one after the other.
const PiecePlace& placeOf(const Equirectangular& source, const SampleTile& piece) {
    thread_local std::optional<PiecePlace> last;
    thread_local SampleTile lastPiece;
    const bool same = last && sameSquare(piece, lastPiece) &&
                      last->projection.placement == source.placement &&
                      last->projection.height == source.image.height();
    if (same) return *last;
    last.reset();
    const Projection projection(source.placement, source.image.height(), filterCellsOf(piece));
    PieceTaps taps = tapsOfPiece(projection, piece);
    const Region region = regionOf(projection, taps);
    last.emplace(PiecePlace{projection, std::move(taps), region});
    lastPiece = piece;
    return *last;
}

// Samples a piece into out, whose rows are `stride` samples apart.
Result<void> samplePiece(const Equirectangular& source, const SampleTile& piece, float* out,
                         std::size_t stride) {
    const PiecePlace& place = placeOf(source, piece);
    const auto& [projection, taps, region] = place;
    const int bandRows = std::clamp(
        static_cast<int>(regionSamples / static_cast<std::size_t>(region.columns)), 1, region.rows);
    std::vector<float> lanes(4 * taps.firstColumn.size());
    std::vector<float> samples;
    PieceFilter filter(projection, taps);
    for (int done = 0; done < region.rows; done += bandRows) {
        const Region band{region.column, region.row + done, region.columns,
                          std::min(bandRows, region.rows - done)};
        TRY(readRegion(source.image, source.placement, band, samples));
        filter.add(band, samples.data(), lanes);
    }
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t row = 0; row < static_cast<std::size_t>(piece.rows); ++row)
        finishRow(lanes.data() + 4 * row * columns, columns, source.minM, source.maxM, out + row * stride);
    return {};
}

Result<void> sampleTile(const Equirectangular& source, const SampleTile& tile, std::span<float> out) {
    assert(tile.faceCells > 0 && tile.columns >= 0 && tile.rows >= 0);
    assert(out.size() == samplesIn(tile));
    return sampleInPieces(tile, pieceSide, out, [&](const SampleTile& piece, float* to, std::size_t stride) {
        return samplePiece(source, piece, to, stride);
    });
}

// Reads the sample nearest to a place.
Result<SourceReading> nearestSample(const HeightRaster& image, const ImagePlacement& placement,
                                    const std::filesystem::path& path, const Geographic& place) {
    const Projection projection(placement, image.height(), 1);
    const double column = placement.zeroColumn + place.longitudeRad * projection.columnsPerRad;
    const double row = image.height() / 2.0 - 0.5 - place.latitudeRad * projection.rowsPerRad;
    const int x = wrapped(static_cast<int>(std::lround(column)), placement.period);
    const int y = std::clamp(static_cast<int>(std::lround(row)), 0, image.height() - 1);
    float height = 0;
    TRY(image.read({x, y, 1, 1}, &height, 1));
    SourceReading reading;
    reading.heightM = static_cast<double>(height);
    reading.file = path;
    reading.column = x;
    reading.row = y;
    return reading;
}

}  // namespace

Result<HeightSource> openEquirectangularSource(const std::filesystem::path& path,
                                               const HeightSourceSettings& settings) {
    TRY_ASSIGN(const auto file, ImageFile::open(path, settings.colourChannel));
    const ImageLayout& layout = file->layout();
    TRY_ASSIGN(const auto placement, placementOf(path.string(), layout.width, layout.height, layout.geoTags));
    TRY_ASSIGN(const auto conversion, conversionFor(path.string(), settings, layout.type, layout.geoTags));
    const RasterMemory memory{std::make_shared<StoredBlockCache>(settings.cacheBytes), 0,
                              settings.cacheBytes};
    TRY_ASSIGN(const auto image, openImageRaster(file, conversion, memory, settings.fileCalls));
    TRY_ASSIGN(const auto statistics, image.statistics(settings.stop, settings.share.get()));

    HeightSource source;
    source.description = fmt::format("{}, {} x {} {}, {}", path.filename().string(), layout.width,
                                     layout.height, layout.typeName, placementText(placement, layout.width));
    // With Nowell's mapping, a grid step covers at most 2 / cells radians.
    source.naturalFaceSize = powerOfTwoCells(placement.period / std::numbers::pi) + 1;
    source.sampleCount = static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height);
    describeHeights(source, conversion, statistics);
    source.densities = {rowsToPole(placement, layout.height) / std::numbers::pi,
                        placement.period / (2 * std::numbers::pi)};
    if (!settings.colourChannel) {
        source.layers =
            singleLayer(wholeLayer(source, LayerKind::Image, 2 * std::numbers::pi / placement.period),
                        [image, placement, path](const Geographic& place) {
                            return nearestSample(image, placement, path, place);
                        });
    }
    source.sample = [shared = Equirectangular{image, placement, statistics.minM, statistics.maxM}](
                        const SampleTile& tile, std::span<float> out) {
        return sampleTile(shared, tile, out);
    };
    return source;
}

}  // namespace planet
