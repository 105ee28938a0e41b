#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/base/picture_file.h"
#include "app/base/places.h"
#include "app/bench/bench_parts.h"
#include "app/bench/raster_pyramid.h"
#include "app/bench/square_formats.h"
#include "planet/format/chunk_file.h"
#include "planet/format/height_codec.h"

namespace worldy {

namespace {

using planet::Result;

// --- A planet's faces

Result<void> copyLeaves(const planet::ChunkFile& file, const planet::ChunkData& chunk, HeightSquare& square) {
    const planet::PlanetShape& shape = file.info().shape;
    if (chunk.children.exists()) {
        const auto children = file.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!children) return tl::unexpected(children.error());
        for (const planet::ChunkData& child : *children) {
            if (Result<void> copied = copyLeaves(file, child, square); !copied) return copied;
        }
        return {};
    }
    const auto size = static_cast<std::size_t>(planet::chunkSize(shape));
    const auto side = static_cast<std::size_t>(square.side);
    for (std::size_t row = 0; row < size; ++row) {
        const std::size_t start = (chunk.id.y * (size - 1) + row) * side + chunk.id.x * (size - 1);
        for (std::size_t i = 0; i < size; ++i)
            square.steps[start + i] = static_cast<std::int16_t>(chunk.heights[row * size + i]);
    }
    return {};
}

Result<HeightSquare> finestHeights(const planet::ChunkFile& file, planet::Face face) {
    if (!isDense(file.info())) {
        return planet::badInput(fmt::format(
            "{}: has leaves on several levels; expected all leaves at the deepest level", file.name()));
    }
    if (file.info().shape.fractionBits > 0) {
        return planet::badInput(fmt::format(
            "{}: has heights in fractions of its quantum; expected steps of 16 bits", file.name()));
    }
    const int side = planet::faceCells(file.info().shape) + 1;
    HeightSquare square{
        side, std::vector<std::int16_t>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
    const Result<planet::ChunkData> root = file.readRoot(face);
    if (!root) return tl::unexpected(root.error());
    if (Result<void> copied = copyLeaves(file, *root, square); !copied) return tl::unexpected(copied.error());
    return square;
}

// Returns the row of a format that could not be used, with the reason.
BenchRow missingRow(const std::string& subject, const std::string& problem) {
    return {fmt::format("{} ({})", subject, problem), "per finest sample", "bits", {}};
}

// JPEG XL takes minutes to code the faces of a planet.
constexpr std::array formatsOfFaces = {SquareFormat::Zstd, SquareFormat::ShuffledDeltas, SquareFormat::Png,
                                       SquareFormat::Jpeg2000};

BenchRows planetRows(const BenchPlanet& planet, const std::filesystem::path& folder) {
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    std::array<StoredSquare, formatsOfFaces.size()> faces{};
    for (const planet::Face face : planet::allFaces) {
        const auto square = finestHeights(*file, face);
        if (!square) return tl::unexpected(square.error());
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (!faces[i].problem.empty()) continue;
            const auto stored = storeSquare(formatsOfFaces[i], *square, folder, 0);
            if (!stored) return tl::unexpected(stored.error());
            faces[i].bytes += stored->bytes;
            faces[i].problem = stored->problem;
        }
    }
    const double side = planet::faceCells(file->info().shape) + 1;
    std::vector<BenchRow> rows;
    const auto ours = static_cast<double>(file->sizeBytes());
    const auto add = [&](const std::string& subject, std::size_t bytes) {
        const double bits = 8 * static_cast<double>(bytes) / (6 * side * side);
        BenchRow row{subject, "per finest sample", "bits", {bits, bits, bits}};
        const double ratio = static_cast<double>(bytes) / ours;
        if (!rows.empty()) row.ratio = {ratio, ratio, ratio}, row.yardstick = "chunk file";
        rows.push_back(std::move(row));
    };
    add("chunk file, all levels", file->sizeBytes());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::string subject = "finest level: " + nameOf(formatsOfFaces[i]);
        if (faces[i].problem.empty())
            add(subject, faces[i].bytes);
        else
            rows.push_back(missingRow(subject, faces[i].problem));
    }
    return rows;
}

// --- Rasters on their own grids

constexpr std::int32_t voidOfSrtm = -32767;

// A square window of a raster that comes with Worldy.
struct RasterWindow {
    const char* name;
    const char* file;  // in the data folder
    int x, y;          // of its first sample
    int side;
};

// The windows of SRTM are the middle of their tiles.
constexpr std::array<RasterWindow, 4> rasterWindows = {{
    {"ETOPO5", "earth/elevation.tif", 2100, 50, 2049},
    {"S33W071", "regions/S33W071.tif", 88, 88, 1025},
    {"N49W123", "regions/N49W123.tif", 88, 88, 1025},
    {"N49W124", "regions/N49W124.tif", 88, 88, 1025},
}};

// Fills voids from their rims inwards with the means of the samples around.
void fillVoids(HeightSquare& square) {
    const auto at = [&](int x, int y) -> std::int16_t& {
        return square.steps[static_cast<std::size_t>(y) * static_cast<std::size_t>(square.side) +
                            static_cast<std::size_t>(x)];
    };
    std::vector<std::pair<int, int>> voids;
    for (int y = 0; y < square.side; ++y)
        for (int x = 0; x < square.side; ++x)
            if (at(x, y) == voidOfSrtm) voids.emplace_back(x, y);
    const auto meanAround = [&](int x, int y) {
        int sum = 0;
        int count = 0;
        for (int j = std::max(0, y - 1); j <= std::min(square.side - 1, y + 1); ++j)
            for (int i = std::max(0, x - 1); i <= std::min(square.side - 1, x + 1); ++i) {
                if (at(i, j) == voidOfSrtm) continue;
                sum += at(i, j);
                ++count;
            }
        return count > 0 ? static_cast<std::int16_t>(sum / count) : static_cast<std::int16_t>(voidOfSrtm);
    };
    while (!voids.empty()) {
        std::vector<std::int16_t> means;
        for (const auto& [x, y] : voids) means.push_back(meanAround(x, y));
        for (std::size_t i = 0; i < voids.size(); ++i) at(voids[i].first, voids[i].second) = means[i];
        const auto filled = std::erase_if(voids, [&](const std::pair<int, int>& place) {
            return at(place.first, place.second) != voidOfSrtm;
        });
        if (filled == 0) return;
    }
}

Result<HeightSquare> readWindow(const RasterWindow& window) {
    const std::filesystem::path file = dataFolder() / window.file;
    const auto image = readGrey16(file);
    if (!image) return tl::unexpected(image.error());
    if (window.x + window.side > image->width || window.y + window.side > image->height) {
        return planet::badInput(fmt::format("{}: {} x {} samples; expected at least {} x {}", file.string(),
                                            image->width, image->height, window.x + window.side,
                                            window.y + window.side));
    }
    HeightSquare square{window.side, {}};
    for (int y = 0; y < window.side; ++y)
        for (int x = 0; x < window.side; ++x)
            square.steps.push_back(
                static_cast<std::int16_t>(image->samples[static_cast<std::size_t>(window.y + y) *
                                                             static_cast<std::size_t>(image->width) +
                                                         static_cast<std::size_t>(window.x + x)]));
    fillVoids(square);
    return square;
}

constexpr std::array formatsOfRasters = {SquareFormat::Zstd, SquareFormat::ShuffledDeltas, SquareFormat::Png,
                                         SquareFormat::Jpeg2000, SquareFormat::JpegXl};

struct CodedRaster {
    std::string subject;
    std::size_t bytes = 0;
    std::vector<double> decodingCpuS;
    std::string problem{};  // why another program has not coded it; empty otherwise
};

Result<CodedRaster> codedByUs(const HeightSquare& square, int chunkCells, int level, int rounds) {
    const RasterPyramid pyramid = codePyramid(square, chunkCells, level);
    CodedRaster coded{fmt::format("chunks of {}, level {}", chunkCells + 1, level), pyramid.fileBytes, {}};
    for (int round = 0; round < rounds; ++round) {
        const double start = threadCpuS();
        if (const Result<void> decoded = decodePyramid(pyramid); !decoded)
            return tl::unexpected(decoded.error());
        coded.decodingCpuS.push_back(threadCpuS() - start);
    }
    return coded;
}

// The chunk file at all levels in chunks of the default size, and at the highest level in larger chunks; then the other
// formats.
Result<std::vector<CodedRaster>> allCodings(const HeightSquare& square, const std::filesystem::path& folder,
                                            int rounds) {
    constexpr int defaultCells = 32;
    constexpr int largerCells = 64;
    std::vector<CodedRaster> all;
    const auto add = [&](Result<CodedRaster> coded) -> Result<void> {
        if (!coded) return tl::unexpected(coded.error());
        all.push_back(*std::move(coded));
        return {};
    };
    for (int level = 1; level <= planet::maxCompressionLevel; ++level)
        if (Result<void> added = add(codedByUs(square, defaultCells, level, rounds)); !added)
            return tl::unexpected(added.error());
    if (Result<void> added = add(codedByUs(square, largerCells, planet::maxCompressionLevel, rounds)); !added)
        return tl::unexpected(added.error());
    for (const SquareFormat format : formatsOfRasters) {
        auto stored = storeSquare(format, square, folder, rounds);
        if (!stored) return tl::unexpected(stored.error());
        all.push_back(
            {nameOf(format), stored->bytes, std::move(stored->decodingCpuS), std::move(stored->problem)});
    }
    return all;
}

Result<void> addRasterRows(const RasterWindow& window, const std::filesystem::path& folder, int rounds,
                           std::vector<BenchRow>& rows) {
    const auto square = readWindow(window);
    if (!square) return tl::unexpected(square.error());
    const auto codings = allCodings(*square, folder, rounds);
    if (!codings) return tl::unexpected(codings.error());
    const auto samples = static_cast<double>(square->steps.size());
    const CodedRaster& ours = (*codings)[planet::maxCompressionLevel - 1];
    for (const CodedRaster& coded : *codings) {
        const std::string subject = fmt::format("{}: {}", window.name, coded.subject);
        if (!coded.problem.empty()) {
            rows.push_back(missingRow(subject, coded.problem));
            continue;
        }
        const double bits = 8 * static_cast<double>(coded.bytes) / samples;
        BenchRow size{subject, "per finest sample", "bits", {bits, bits, bits}};
        if (&coded != &ours) {
            const double ratio = static_cast<double>(coded.bytes) / static_cast<double>(ours.bytes);
            size.ratio = {ratio, ratio, ratio};
            size.yardstick = ours.subject;
        }
        rows.push_back(std::move(size));
        std::vector<double> rates;
        for (const double seconds : coded.decodingCpuS)
            rates.push_back(2e-6 * samples / std::max(seconds, 1e-9));
        rows.push_back({subject, "decoding", "MB/s of CPU time", spreadOf(rates)});
    }
    return {};
}

}  // namespace

BenchRows benchFileSize(const BenchPlanet& planet, const BenchOptions& options,
                        const std::filesystem::path& folder) {
    BenchRows rows = planetRows(planet, folder);
    // The rasters are of the Earth that comes with Worldy.
    if (!rows || !options.source.empty()) return rows;
    for (const RasterWindow& window : rasterWindows)
        if (const Result<void> added = addRasterRows(window, folder, options.rounds, *rows); !added)
            return tl::unexpected(added.error());
    return rows;
}

}  // namespace worldy
