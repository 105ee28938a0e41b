// Samples six cube faces, each a square grid whose outermost samples lie on the cube's edges.
//
// Neighbouring faces repeat the samples of their common edge. Files whose faces differ there by more than
// rounding are rejected. A sample on an edge or corner of the cube is taken from the first of its faces in
// enum order, so a difference by rounding opens no crack. The kernel extends across an edge onto the next
// face. Beyond a corner, where there is no fourth face, the rows of the next face are mirrored.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <system_error>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/raster/height_raster.h"
#include "planet/source/height_face_edges.h"
#include "planet/source/height_filter.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/whole_layer.h"
#include "planet/sphere/face_fold.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

namespace {

constexpr std::size_t regionSamples = 2u << 20;  // samples of a face in memory at once: 8 MB

struct FaceSet {
    std::array<HeightRaster, faceCount> faces;
    int size = 0;  // samples per side
    float minM = 0;
    float maxM = 0;

    const HeightRaster& operator[](Face face) const { return faces[static_cast<std::size_t>(face)]; }
};

// A place on a face in whole steps, row 0 at the top (v = +1).
struct FaceSample {
    Face face = Face::PosX;
    int column = 0;
    int row = 0;
};

// Folds a sample beyond one edge of its face, by up to the face's width, onto the next face.
FaceSample foldedSample(Face face, int column, int row, int size) {
    const int last = size - 1;
    const FaceGridPoint next = foldedOver({face, column, last - row}, last);
    return {next.face, next.column, last - next.row};
}

// Reads a rectangle that lies completely beyond one edge of a face.
Result<void> readBeyondEdge(const FaceSet& set, Face face, const RasterRect& rect, float* out,
                            std::size_t stride) {
    if (rect.width <= 0 || rect.height <= 0) return {};
    const auto at = [&](int column, int row) {
        return foldedSample(face, rect.x + column, rect.y + row, set.size);
    };
    const FaceSample first = at(0, 0);
    const FaceSample last = at(rect.width - 1, rect.height - 1);
    const RasterRect from{std::min(first.column, last.column), std::min(first.row, last.row),
                          std::abs(first.column - last.column) + 1, std::abs(first.row - last.row) + 1};
    const auto fromStride = static_cast<std::size_t>(from.width);
    std::vector<float> samples(fromStride * static_cast<std::size_t>(from.height));
    TRY(set[first.face].read(from, samples.data(), fromStride));
    for (int row = 0; row < rect.height; ++row) {
        for (int column = 0; column < rect.width; ++column) {
            const FaceSample place = at(column, row);
            out[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)] =
                samples[static_cast<std::size_t>(place.row - from.y) * fromStride +
                        static_cast<std::size_t>(place.column - from.x)];
        }
    }
    return {};
}

// Returns the row of a face that replaces a row above its top or below its bottom next to a corner.
int mirroredRow(int row, int size) {
    const int last = size - 1;
    return std::clamp(row < 0 ? -row : 2 * last - row, 0, last);
}

// Reads a rectangle of a face that may extend beyond its edges.
Result<void> readRegion(const FaceSet& set, Face face, const RasterRect& rect, std::vector<float>& out) {
    const auto stride = static_cast<std::size_t>(rect.width);
    out.resize(stride * static_cast<std::size_t>(rect.height));
    const int right = rect.x + rect.width;
    const int bottom = rect.y + rect.height;
    const int faceLeft = std::clamp(0, rect.x, right);
    const int faceRight = std::clamp(set.size, rect.x, right);
    // Reads the rows on the face at once, and those beyond it one by one.
    for (int y = rect.y; y < bottom;) {
        const bool inside = y >= 0 && y < set.size;
        const int rows = inside ? std::min(bottom, set.size) - y : 1;
        const int besideY = inside ? y : mirroredRow(y, set.size);
        float* const to = out.data() + static_cast<std::size_t>(y - rect.y) * stride;
        float* const toFace = to + (faceLeft - rect.x);
        float* const toRight = to + (faceRight - rect.x);
        Result<void> read = readBeyondEdge(set, face, {rect.x, besideY, faceLeft - rect.x, rows}, to, stride);
        if (read)
            read = readBeyondEdge(set, face, {faceRight, besideY, right - faceRight, rows}, toRight, stride);
        if (!read) return read;
        const RasterRect middle{faceLeft, y, faceRight - faceLeft, rows};
        read = inside ? set[face].read(middle, toFace, stride)
                      : readBeyondEdge(set, face, middle, toFace, stride);
        if (!read) return read;
        y += rows;
    }
    return {};
}

// The taps of the samples along one direction of a piece.
struct AxisTaps {
    int tapsEach = 4;
    std::vector<int> first;
    std::vector<float> weights;  // tapsEach per sample

    int begin() const { return *std::min_element(first.begin(), first.end()); }
    int end() const { return *std::max_element(first.begin(), first.end()) + tapsEach; }
};

// Returns the taps of samples firstCell, firstCell + step, ... Cell k of the grid lies at source sample k
// (size - 1) / faceCells, which is exact, because faceCells is a power of two.
// The filter covers a cell of the grid of filterCells.
AxisTaps tapsAlong(int firstCell, int step, int count, const SampleTile& tile, int size) {
    const double perCell = static_cast<double>(size - 1) / tile.faceCells;
    const double stretch = std::max(1.0, static_cast<double>(size - 1) / filterCellsOf(tile));
    AxisTaps taps;
    taps.tapsEach = tapCount(static_cast<float>(stretch));
    taps.weights.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(taps.tapsEach));
    for (int i = 0; i < count; ++i) {
        const double position = (firstCell + i * step) * perCell;
        const double first = std::floor(position - 2 * stretch) + 1;
        taps.first.push_back(static_cast<int>(first));
        kernelWeights(static_cast<float>(position - first), static_cast<float>(stretch),
                      std::span(taps.weights)
                          .subspan(static_cast<std::size_t>(i) * static_cast<std::size_t>(taps.tapsEach),
                                   static_cast<std::size_t>(taps.tapsEach)));
    }
    return taps;
}

// Filters one row of source samples, starting at source column `column`, to one row of the piece.
void filterAcross(const AxisTaps& taps, int column, const float* samples, float* out) {
    const auto each = static_cast<std::size_t>(taps.tapsEach);
    for (std::size_t i = 0; i < taps.first.size(); ++i) {
        const float* const from = samples + (taps.first[i] - column);
        const float* const weights = taps.weights.data() + i * each;
        Float4 sum{};
        for (std::size_t k = 0; k < each; k += 4) sum += loadFloat4(weights + k) * loadFloat4(from + k);
        out[i] = sumOfLanes(sum);
    }
}

// Filters along columns. across: the source rows starting at taps.begin(), already filtered along rows.
void filterDown(const FaceSet& set, const AxisTaps& taps, const std::vector<float>& across,
                std::size_t columns, float* out, std::size_t stride) {
    const int top = taps.begin();
    const auto each = static_cast<std::size_t>(taps.tapsEach);
    for (std::size_t row = 0; row < taps.first.size(); ++row) {
        float* const to = out + row * stride;
        std::fill_n(to, columns, 0.0f);
        for (std::size_t k = 0; k < each; ++k) {
            const float weight = taps.weights[row * each + k];
            const float* const from =
                across.data() + (static_cast<std::size_t>(taps.first[row] - top) + k) * columns;
            for (std::size_t i = 0; i < columns; ++i) to[i] += weight * from[i];
        }
        for (std::size_t i = 0; i < columns; ++i) to[i] = std::clamp(to[i], set.minM, set.maxM);
    }
}

// Samples a piece into out, whose rows are `stride` samples apart.
Result<void> samplePiece(const FaceSet& set, const SampleTile& piece, float* out, std::size_t stride) {
    const AxisTaps across = tapsAlong(piece.firstColumn, 1, piece.columns, piece, set.size);
    // Rows of the grid run upwards along v, those of the source downwards.
    const AxisTaps down = tapsAlong(piece.faceCells - piece.firstRow, -1, piece.rows, piece, set.size);
    const int left = across.begin();
    const int width = across.end() - left;
    const int top = down.begin();
    const int height = down.end() - top;
    const int bandRows =
        std::clamp(static_cast<int>(regionSamples / static_cast<std::size_t>(width)), 1, height);
    const auto columns = static_cast<std::size_t>(piece.columns);
    std::vector<float> filtered(columns * static_cast<std::size_t>(height));
    std::vector<float> samples;
    for (int done = 0; done < height; done += bandRows) {
        const int rows = std::min(bandRows, height - done);
        TRY(readRegion(set, piece.face, {left, top + done, width, rows}, samples));
        for (int row = 0; row < rows; ++row) {
            filterAcross(across, left,
                         samples.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width),
                         filtered.data() + static_cast<std::size_t>(done + row) * columns);
        }
    }
    filterDown(set, down, filtered, columns, out, stride);
    return {};
}

// Samples only this face, also on the cube's edges.
Result<void> sampleOwnFace(const FaceSet& set, const SampleTile& tile, std::span<float> out) {
    // Pieces are smaller if a sample covers many source samples, to bound the memory.
    const int side = set.size > 64 * tile.faceCells ? 16 : 65;
    return sampleInPieces(tile, side, out, [&](const SampleTile& piece, float* to, std::size_t stride) {
        return samplePiece(set, piece, to, stride);
    });
}

Result<void> sampleTile(const FaceSet& set, const SampleTile& tile, std::span<float> out);

// Samples a line of the tile from the next face, which shares the line, into the tile's samples.
Result<void> sampleFromNextFace(const FaceSet& set, const SampleTile& tile, const SampleTile& line, Face next,
                                std::span<float> out) {
    const FaceGridPoint first =
        placeOnFace(next, {tile.face, line.firstColumn, line.firstRow}, tile.faceCells);
    const FaceGridPoint last =
        placeOnFace(next, {tile.face, line.firstColumn + line.columns - 1, line.firstRow + line.rows - 1},
                    tile.faceCells);
    SampleTile there = tileBetween(first, last, tile.faceCells);
    there.filterCells = tile.filterCells;
    std::vector<float> heights(samplesIn(there));
    TRY(sampleTile(set, there, heights));
    const bool reversed = first.column > last.column || first.row > last.row;
    if (reversed) std::reverse(heights.begin(), heights.end());
    const auto stride = static_cast<std::size_t>(tile.columns);
    const std::size_t begin = indexIn(tile, line.firstColumn, line.firstRow);
    const std::size_t step = line.columns > 1 ? 1 : stride;
    for (std::size_t i = 0; i < heights.size(); ++i) out[begin + i * step] = heights[i];
    return {};
}

// Samples a tile. The recursion ends, because each call continues with faces earlier in enum order.
Result<void> sampleTile(const FaceSet& set, const SampleTile& tile, std::span<float> out) {
    assert(tile.faceCells > 0 && tile.columns >= 0 && tile.rows >= 0);
    assert(out.size() == samplesIn(tile));
    if (tile.columns == 0 || tile.rows == 0) return {};
    TRY(sampleOwnFace(set, tile, out));
    const FaceAxes& axes = faceAxes(tile.face);
    const int cells = tile.faceCells;
    const auto takeFrom = [&](const glm::dvec3& outward, bool touches,
                              const SampleTile& line) -> Result<void> {
        const Face next = faceAlong(outward);
        if (!touches || next > tile.face) return {};
        return sampleFromNextFace(set, tile, line, next, out);
    };
    SampleTile column = tile;
    column.columns = 1;
    SampleTile row = tile;
    row.rows = 1;
    column.firstColumn = 0;
    Result<void> taken = takeFrom(-axes.u, tile.firstColumn == 0, column);
    column.firstColumn = cells;
    if (taken) taken = takeFrom(axes.u, tile.firstColumn + tile.columns == cells + 1, column);
    row.firstRow = 0;
    if (taken) taken = takeFrom(-axes.v, tile.firstRow == 0, row);
    row.firstRow = cells;
    if (taken) taken = takeFrom(axes.v, tile.firstRow + tile.rows == cells + 1, row);
    return taken;
}

// The format of the six files.
struct FaceFormat {
    int size = 0;
    SampleType type = SampleType::Uint16;
    std::string typeName;
};

Result<void> checkNoneMissing(const FaceFiles& files) {
    std::string missing;
    for (const std::filesystem::path& path : files.paths) {
        std::error_code problem;
        if (std::filesystem::exists(path, problem)) continue;
        if (!missing.empty()) missing += ", ";
        missing += path.filename().string();
    }
    if (missing.empty()) return {};
    const std::filesystem::path folder = files.paths[0].parent_path();
    return badInput(fmt::format("{}: a cube has six faces; missing in {}: {}", files.stem,
                                folder.empty() ? "this folder" : folder.string(), missing));
}

Result<void> checkSize(const std::string& file, int size) {
    constexpr int mostSize = (1 << maxFaceCellsLog2) + 1;
    if (size >= 2 && size <= mostSize) return {};
    return badInput(fmt::format("{}: a face of {} samples per side; expected [2, {}]", file, size, mostSize));
}

Result<std::uint64_t> lengthOf(const std::filesystem::path& path) {
    std::error_code problem;
    const std::uintmax_t bytes = std::filesystem::file_size(path, problem);
    if (problem) return ioError(fmt::format("{}: {}", path.string(), problem.message()));
    return std::uint64_t{bytes};
}

// Returns the side of a square of this many samples; 0 if it is no square.
int squareSide(std::uint64_t samples) {
    const auto side = static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(samples))));
    return side * side == samples && side < (1u << 30) ? static_cast<int>(side) : 0;
}

Result<int> rawSideByLength(const FaceFiles& files, const HeightSourceSettings& settings,
                            std::uint64_t bytes) {
    // The length and half of it are never both squares, so the number of bits is unambiguous.
    if (settings.rawBits != 16 && squareSide(bytes) > 0) return squareSide(bytes);
    if (settings.rawBits != 8 && bytes % 2 == 0 && squareSide(bytes / 2) > 0) return squareSide(bytes / 2);
    return badInput(
        fmt::format("{} is {} bytes, which no square of 8 or 16 bit samples has; its name may end "
                    "in the samples per side, as in earth4097_{}.raw, or --raw-size may give them",
                    files.paths[0].filename().string(), bytes, faceName(Face::PosX)));
}

Result<int> rawSideOf(const FaceFiles& files, const HeightSourceSettings& settings, std::uint64_t bytes) {
    if (settings.rawSize) return *settings.rawSize;
    if (files.sizeInName) return *files.sizeInName;
    return rawSideByLength(files, settings, bytes);
}

// Returns a hint for names that end in a number that is not the size. side: the actual samples per side; < 2
// if unknown.
std::string otherSizeHint(const FaceFiles& files, const HeightSourceSettings& settings, int side) {
    if (settings.rawSize || !files.sizeInName || side < 2) return {};
    return fmt::format("; if the {} in the name is not the size, use --raw-size {}", *files.sizeInName, side);
}

Result<FaceFormat> rawFormat(const FaceFiles& files, const HeightSourceSettings& settings) {
    const std::string file = files.paths[0].filename().string();
    TRY_ASSIGN(const auto bytes, lengthOf(files.paths[0]));
    TRY_ASSIGN(const auto side, rawSideOf(files, settings, bytes));
    TRY(checkSize(file, side));
    const std::uint64_t samples = static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    const bool fits8 = bytes == samples && settings.rawBits != 16;
    const bool fits16 = bytes == 2 * samples && settings.rawBits != 8;
    if (!fits8 && !fits16) {
        const std::string expected =
            settings.rawBits ? fmt::format("{} bits would be {}", *settings.rawBits,
                                           samples * static_cast<std::uint64_t>(*settings.rawBits / 8))
                             : fmt::format("8 or 16 bits would be {} or {}", samples, 2 * samples);
        const Result<int> fitting = rawSideByLength(files, settings, bytes);
        return badInput(fmt::format("{} is {} bytes; {} x {} samples of {}{}", file, bytes, side, side,
                                    expected, otherSizeHint(files, settings, fitting.value_or(0))));
    }
    for (const std::filesystem::path& path : files.paths) {
        TRY_ASSIGN(const auto other, lengthOf(path));
        if (other == bytes) continue;
        return badInput(fmt::format("{} is {} bytes but {} is {}; all six faces must have one size and type",
                                    path.filename().string(), other, file, bytes));
    }
    if (fits8) return FaceFormat{side, SampleType::Uint8, "uint8"};
    if (settings.rawSigned) return FaceFormat{side, SampleType::Int16, "int16"};
    return FaceFormat{side, SampleType::Uint16, "uint16"};
}

using ImageFiles = std::array<std::shared_ptr<ImageFile>, faceCount>;

Result<ImageFiles> openImages(const FaceFiles& files, std::optional<int> colourChannel) {
    ImageFiles images;
    for (std::size_t i = 0; i < images.size(); ++i) {
        TRY_ASSIGN(images[i], ImageFile::open(files.paths[i], colourChannel));
    }
    return images;
}

Result<FaceFormat> imageFormat(const FaceFiles& files, const HeightSourceSettings& settings,
                               const ImageFiles& images) {
    const ImageLayout& first = images[0]->layout();
    const std::string firstName = files.paths[0].filename().string();
    const std::optional<int> expected = settings.rawSize ? settings.rawSize : files.sizeInName;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const ImageLayout& layout = images[i]->layout();
        const std::string name = files.paths[i].filename().string();
        if (layout.width != layout.height) {
            return badInput(fmt::format("{} is {} x {} samples; expected a square cube face", name,
                                        layout.width, layout.height));
        }
        if (layout.width != first.width || layout.typeName != first.typeName) {
            return badInput(fmt::format(
                "{} is {} x {} {} but {} is {} x {} {}; all six faces must have one size and type", name,
                layout.width, layout.height, layout.typeName, firstName, first.width, first.height,
                first.typeName));
        }
        if (layout.geoTags.noDataValue != first.geoTags.noDataValue) {
            return badInput(
                fmt::format("{} and {} have different GDAL_NODATA tags; expected the same no-data value "
                            "in all six faces",
                            name, firstName));
        }
        const bool sameUnits = layout.geoTags.scale == first.geoTags.scale &&
                               layout.geoTags.offset == first.geoTags.offset &&
                               layout.geoTags.unit == first.geoTags.unit;
        if (!sameUnits) {
            return badInput(fmt::format(
                "{} and {} have a different scale, offset or unit by their tags; expected the same "
                "in all six faces",
                name, firstName));
        }
        if (expected && layout.width != *expected) {
            return badInput(fmt::format("{} is {} x {} samples; {} {} x {}{}", name, layout.width,
                                        layout.height,
                                        settings.rawSize ? "--raw-size asks for" : "its name says", *expected,
                                        *expected, otherSizeHint(files, settings, layout.width)));
        }
    }
    TRY(checkSize(firstName, first.width));
    return FaceFormat{first.width, first.type, first.typeName};
}

// Returns the rounding of a face: edges may differ by one step of the sample type.
double roundingOf(const FaceFormat& format, const HeightSource& source) {
    if (source.stepM > 0) return source.stepM * (1 + 1e-6);
    const double largestM = std::max(std::abs(source.minM), std::abs(source.maxM));
    return largestM * (format.typeName == "half" ? 1e-3 : 1e-5);
}

// Reads the sample nearest to a place.
Result<SourceReading> nearestSample(const FaceSet& set,
                                    const std::array<std::filesystem::path, faceCount>& paths,
                                    const Geographic& place) {
    const FacePoint point = facePointFromDirection(directionFromGeographic(place));
    const int last = set.size - 1;
    const auto nearest = [&](double along) {
        return std::clamp(static_cast<int>(std::lround((along + 1) / 2 * last)), 0, last);
    };
    SourceReading reading;
    reading.file = paths[static_cast<std::size_t>(point.face)];
    reading.column = nearest(point.u);
    reading.row = last - nearest(point.v);
    float height = 0;
    TRY(set[point.face].read({static_cast<int>(reading.column), static_cast<int>(reading.row), 1, 1}, &height,
                             1));
    reading.heightM = static_cast<double>(height);
    return reading;
}

Result<HeightSource> describeFaces(const FaceFiles& files, const FaceFormat& format,
                                   const HeightConversion& conversion, const HeightSourceSettings& settings,
                                   FaceSet set, FaceEdges edges) {
    HeightStatistics statistics;
    for (const HeightRaster& face : set.faces) {
        TRY_ASSIGN(const auto part, face.statistics(settings.stop, settings.share.get()));
        addTo(statistics, part);
    }
    set.size = format.size;
    set.minM = statistics.minM;
    set.maxM = statistics.maxM;
    HeightSource source;
    source.description =
        fmt::format("{}, six faces of {} x {} {}", files.stem, format.size, format.size, format.typeName);
    source.naturalFaceSize = powerOfTwoCells(format.size - 1) + 1;
    const auto side = static_cast<std::uint64_t>(format.size);
    source.sampleCount = faceCount * side * side;
    source.densities.alongPerRad = (format.size - 1) / (std::numbers::pi / 2);
    describeHeights(source, conversion, statistics);
    const FaceLines lines{format.size, statistics.missingCount > 0, conversion.fillM};
    if (edges == FaceEdges::MustAgree) {
        TRY(checkHeightEdges(set.faces, lines, files.stem, roundingOf(format, source)));
    } else {
        TRY_ASSIGN(auto seams, findColourSeams(set.faces, lines, files.stem));
        source.seamEdges = seams.edges;
        source.notice = std::move(seams.notice);
    }
    if (edges == FaceEdges::MustAgree) {
        source.layers = singleLayer(
            wholeLayer(source, LayerKind::Faces, std::numbers::pi / 2 / (format.size - 1)),
            [set, paths = files.paths](const Geographic& place) { return nearestSample(set, paths, place); });
    }
    source.sample = [shared = std::move(set)](const SampleTile& tile, std::span<float> out) {
        return sampleTile(shared, tile, out);
    };
    return source;
}

}  // namespace

Result<HeightSource> openFaceSource(const FaceFiles& files, const HeightSourceSettings& settings,
                                    FaceEdges edges) {
    TRY(checkNoneMissing(files));
    const bool raw = files.extension == ".raw" || files.extension == ".RAW";
    if (raw && settings.colourChannel) {
        return badInput(fmt::format("{}: raw faces hold heights; name an image, or six, for colours",
                                    files.paths[0].string()));
    }
    ImageFiles images;
    if (!raw) {
        TRY_ASSIGN(images, openImages(files, settings.colourChannel));
    }
    TRY_ASSIGN(const auto format, raw ? rawFormat(files, settings) : imageFormat(files, settings, images));
    const GeoTags tags = raw ? GeoTags() : images[0]->layout().geoTags;
    TRY_ASSIGN(auto conversion, conversionFor(files.paths[0].string(), settings, format.type, tags));
    conversion.swapBytes = raw && settings.rawBigEndian != (std::endian::native == std::endian::big);

    const auto cache = std::make_shared<StoredBlockCache>(settings.cacheBytes);
    FaceSet set;
    for (int i = 0; i < faceCount; ++i) {
        const auto face = static_cast<std::size_t>(i);
        const RasterMemory memory{cache, face, settings.cacheBytes / faceCount};
        TRY_ASSIGN(set.faces[face],
                   raw ? openRawRaster(files.paths[face], format.size, format.size, conversion, memory,
                                       settings.fileCalls)
                       : openImageRaster(images[face], conversion, memory, settings.fileCalls));
    }
    return describeFaces(files, format, conversion, settings, std::move(set), edges);
}

}  // namespace planet
