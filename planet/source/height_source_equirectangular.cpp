// Samples an equirectangular image of the whole planet, north up, placed by ImagePlacement.
//
// The image continues without end: columns wrap, and a row beyond a pole is the row at the same distance on
// this side, half a turn further. The kernel covers a cell of the filter's grid, (pi/2) / filterCells
// radians, divided by cos(latitude) in longitude; at a pole that is the whole row.

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

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

void tapsOfRow(const Projection& projection, const GeographicRow& places, std::size_t begin,
               PieceTaps& taps) {
    const double width = projection.width;
    const double middleColumn = projection.placement.zeroColumn;
    const double middleRow = projection.height / 2.0 - 0.5;
    const double wholeRow = width / 4;  // a kernel with a larger stretch would overlap itself
    const int wholeRowGroups = (projection.width + 3) / 4;
    const double reachRows = 2.0 * projection.stretchRows;
    // The bias makes truncation to an int a floor.
    const int columnBias = 2 * projection.width + 4;
    const int rowBias = 2 * projection.height + 4;
    const auto count = static_cast<int>(places.ring.size());
    const double* const longitudes = places.longitudeRad.data();
    const double* const latitudes = places.latitudeRad.data();
    const double* const rings = places.ring.data();
    int* const firstColumns = taps.firstColumn.data() + begin;
    int* const firstRows = taps.firstRow.data() + begin;
    int* const groups = taps.columnGroups.data() + begin;
    float* const columns = taps.column.data() + begin;
    float* const rows = taps.row.data() + begin;
    float* const stretches = taps.stretchColumns.data() + begin;
    for (int i = 0; i < count; ++i) {
        const double column = middleColumn + longitudes[i] * projection.columnsPerRad;
        const double row = middleRow - latitudes[i] * projection.rowsPerRad;
        const double wanted = projection.stretchAtEquator / (rings[i] + 1e-30);
        const bool whole = wanted > wholeRow;
        const double atLeast1 = wanted < 1 ? 1.0 : wanted;
        const double stretch = whole ? wholeRow : atLeast1;
        const int below = static_cast<int>(stretch);
        const int firstColumn = static_cast<int>(column - 2 * stretch + columnBias) - columnBias + 1;
        const int firstRow = static_cast<int>(row - reachRows + rowBias) - rowBias + 1;
        firstColumns[i] = whole ? 0 : firstColumn;
        firstRows[i] = firstRow;
        groups[i] = whole ? wholeRowGroups : below + (stretch > below ? 1 : 0);
        columns[i] = static_cast<float>(column - firstColumn);
        rows[i] = static_cast<float>(row - firstRow);
        stretches[i] = whole ? 0.0f : static_cast<float>(stretch);
    }
}

PieceTaps tapsOfPiece(const Projection& projection, const SampleTile& piece) {
    const auto columns = static_cast<std::size_t>(piece.columns);
    PieceTaps taps(columns * static_cast<std::size_t>(piece.rows));
    std::vector<double> scratch(3 * columns);
    const std::span places(scratch);
    const GeographicRow row{places.first(columns), places.subspan(columns, columns), places.last(columns)};
    for (int r = 0; r < piece.rows; ++r) {
        geographicRow(piece.face, piece.faceCells, piece.firstColumn, piece.firstRow + r, row);
        tapsOfRow(projection, row, static_cast<std::size_t>(r) * columns, taps);
    }
    return taps;
}

// Returns the smallest region that contains all taps. Moves columns west of the middle by one turn to the
// east if that makes the region narrower, across the date line.
Region regionOf(const Projection& projection, PieceTaps& taps) {
    const int half = static_cast<int>(projection.placement.zeroColumn + 0.5);
    int low = taps.firstColumn[0], high = low, lowMoved = low + projection.width, highMoved = 0;
    int top = taps.firstRow[0], bottom = top;
    for (std::size_t i = 0; i < taps.firstColumn.size(); ++i) {
        const int first = taps.firstColumn[i];
        const int moved = first < half ? first + projection.width : first;
        const int count = 4 * taps.columnGroups[i];
        low = std::min(low, first);
        high = std::max(high, first + count);
        lowMoved = std::min(lowMoved, moved);
        highMoved = std::max(highMoved, moved + count);
        top = std::min(top, taps.firstRow[i]);
        bottom = std::max(bottom, taps.firstRow[i]);
    }
    bottom += tapCount(projection.stretchRows);
    if (highMoved - lowMoved >= high - low) return {low, top, high - low, bottom - top};
    for (int& first : taps.firstColumn) first = first < half ? first + projection.width : first;
    return {lowMoved, top, highMoved - lowMoved, bottom - top};
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

// Filters the samples of a piece from regions of the image, one band of rows after another.
class PieceFilter {
public:
    PieceFilter(const Projection& projection, const PieceTaps& taps)
        : taps_(taps), width_(projection.width), stretchRows_(projection.stretchRows) {
        rowWeights_.resize(static_cast<std::size_t>(tapCount(stretchRows_)));
    }

    // Adds the rows of a band to a sample; bands come in ascending order.
    Float4 add(Float4 sum, std::size_t sample, const Region& band, const float* samples) {
        const int firstRow = taps_.firstRow[sample] - band.row;
        const float* const from = samples + (taps_.firstColumn[sample] - band.column);
        const bool unstretched = stretchRows_ == 1 && taps_.stretchColumns[sample] == 1;
        if (unstretched && firstRow >= 0 && firstRow + 4 <= band.rows) {
            return addFourByFour(sum, sample, from + firstRow * std::ptrdiff_t{band.columns}, band.columns);
        }
        return addStretched(sum, sample, firstRow, from, band);
    }

private:
    Float4 addFourByFour(Float4 sum, std::size_t sample, const float* from, std::ptrdiff_t stride) const {
        const Float4 across = catmullRomWeights(taps_.column[sample] - 1);
        const Float4 down = catmullRomWeights(taps_.row[sample] - 1);
        sum += down[0] * (across * loadFloat4(from));
        sum += down[1] * (across * loadFloat4(from + stride));
        sum += down[2] * (across * loadFloat4(from + 2 * stride));
        sum += down[3] * (across * loadFloat4(from + 3 * stride));
        return sum;
    }

    Float4 addStretched(Float4 sum, std::size_t sample, int firstRow, const float* from, const Region& band) {
        setWeights(sample);
        const int begin = std::max(0, -firstRow);
        const int end = std::min(static_cast<int>(rowWeights_.size()), band.rows - firstRow);
        for (int tap = begin; tap < end; ++tap) {
            const float* const row = from + (firstRow + tap) * std::ptrdiff_t{band.columns};
            Float4 rowSum{};
            for (std::size_t k = 0; k < columnWeights_.size(); k += 4) {
                rowSum += loadFloat4(columnWeights_.data() + k) * loadFloat4(row + k);
            }
            sum += rowWeights_[static_cast<std::size_t>(tap)] * rowSum;
        }
        return sum;
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

    float finished(Float4 sum) const { return std::clamp(sumOfLanes(sum), minM, maxM); }
};

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
        for (std::size_t i = 0; i < taps.firstColumn.size(); ++i) {
            float* const sum = lanes.data() + 4 * i;
            storeFloat4(sum, filter.add(loadFloat4(sum), i, band, samples.data()));
        }
    }
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t i = 0; i < taps.firstColumn.size(); ++i) {
        out[i / columns * stride + i % columns] = source.finished(loadFloat4(lanes.data() + 4 * i));
    }
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
    const RasterMemory memory{std::make_shared<HeightBlockCache>(settings.cacheBytes), 0,
                              settings.cacheBytes};
    TRY_ASSIGN(const auto image, openImageRaster(file, conversion, memory, settings.fileCalls));
    TRY_ASSIGN(const auto statistics, image.statistics(settings.stop));

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
