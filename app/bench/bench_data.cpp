#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/base/picture_file.h"
#include "app/bench/bench_parts.h"
#include "planet/bake/bake.h"
#include "planet/bake/file_report.h"
#include "planet/planet.h"

namespace worldy {

namespace {

using planet::Result;

// A block that is read again.
struct BlockToRead {
    planet::ChunkId parent;
    planet::BlockLocation location;
    planet::SharedHeights parentHeights;
};

std::vector<BlockToRead> residentBlocks(const planet::ChunkTree& tree) {
    std::vector<BlockToRead> blocks;
    planet::forEachNode(tree, [&](planet::NodeIndex, const planet::ChunkNode& node) {
        if (node.childrenState == planet::ChildrenState::Resident)
            blocks.push_back({node.id, node.children, node.heights});
    });
    return blocks;
}

std::vector<double> perSecond(double amount, const std::vector<double>& ms) {
    std::vector<double> result;
    for (const double value : ms) result.push_back(1000 * amount / value);
    return result;
}

// Returns the rates of two implementations; the second is the baseline.
std::vector<BenchRow> pairedRates(const std::array<std::string, 2>& subjects, const std::string& unit,
                                  double amount, const std::vector<std::vector<double>>& ms) {
    const std::vector<double> ours = perSecond(amount, ms[0]);
    const std::vector<double> plain = perSecond(amount, ms[1]);
    return {{subjects[0], "rate", unit, spreadOf(ours), spreadOf(ratios(ours, plain)), subjects[1]},
            {subjects[1], "rate", unit, spreadOf(plain)}};
}

// Reads rows of a face, because the bake's own tiles are small, and packs them at once.
Result<std::size_t> packSource(const planet::HeightSource& source, int faceSize, double quantumM) {
    std::size_t packed = 0;
    constexpr int rowsAtOnce = 65;
    std::vector<float> heights;
    std::vector<std::int16_t> steps;
    std::vector<char> room;
    for (const planet::Face face : planet::allFaces) {
        for (int row = 0; row < faceSize; row += rowsAtOnce) {
            const int rows = std::min(rowsAtOnce, faceSize - row);
            heights.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(faceSize));
            const Result<void> read = source.sample({face, faceSize - 1, 0, row, faceSize, rows}, heights);
            if (!read) return tl::unexpected(read.error());
            steps.resize(heights.size());
            std::transform(heights.begin(), heights.end(), steps.begin(), [&](float height) {
                return static_cast<std::int16_t>(std::clamp(height / quantumM, -32768.0, 32767.0));
            });
            const std::size_t bytes = steps.size() * sizeof(std::int16_t);
            room.resize(ZSTD_compressBound(bytes));
            packed += ZSTD_compress(room.data(), room.size(), steps.data(), bytes, 1);
        }
    }
    return packed;
}

struct FaceImage {
    int side = 0;
    std::vector<std::int16_t> steps;  // side * side, from the south
};

Result<void> copyLeaves(const planet::ChunkFile& file, const planet::ChunkData& chunk, FaceImage& image) {
    const planet::PlanetShape& shape = file.info().shape;
    if (chunk.children.exists()) {
        const auto children = file.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!children) return tl::unexpected(children.error());
        for (const planet::ChunkData& child : *children) {
            if (Result<void> copied = copyLeaves(file, child, image); !copied) return copied;
        }
        return {};
    }
    const auto size = static_cast<std::size_t>(planet::chunkSize(shape));
    const auto side = static_cast<std::size_t>(image.side);
    for (std::size_t row = 0; row < size; ++row) {
        const std::size_t start = (chunk.id.y * (size - 1) + row) * side + chunk.id.x * (size - 1);
        for (std::size_t i = 0; i < size; ++i)
            image.steps[start + i] = static_cast<std::int16_t>(chunk.heights[row * size + i]);
    }
    return {};
}

std::size_t zstdBytes(const void* data, std::size_t bytes) {
    std::vector<char> room(ZSTD_compressBound(bytes));
    return ZSTD_compress(room.data(), room.size(), data, bytes, 3);
}

// Returns the zstd size of the differences between samples, low bytes before high bytes, which zstd
// compresses well.
std::size_t deltaZstdBytes(const FaceImage& image) {
    const std::size_t count = image.steps.size();
    std::vector<std::uint8_t> bytes(2 * count);
    int previous = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto delta = static_cast<std::uint16_t>(image.steps[i] - previous);
        previous = image.steps[i];
        bytes[i] = static_cast<std::uint8_t>(delta & 0xFF);
        bytes[count + i] = static_cast<std::uint8_t>(delta >> 8);
    }
    return zstdBytes(bytes.data(), bytes.size());
}

std::vector<std::uint16_t> greyOf(const FaceImage& image, std::int16_t darkest) {
    std::vector<std::uint16_t> grey(image.steps.size());
    std::transform(image.steps.begin(), image.steps.end(), grey.begin(),
                   [&](std::int32_t step) { return static_cast<std::uint16_t>(step - darkest); });
    return grey;
}

Result<std::size_t> pngBytes(int side, const std::vector<std::uint16_t>& grey,
                             const std::filesystem::path& file) {
    if (Result<void> written = writeGrey16(side, grey, file); !written)
        return tl::unexpected(written.error());
    return static_cast<std::size_t>(std::filesystem::file_size(file));
}

// Returns 0 if opj_compress is not installed.
std::size_t jpeg2000Bytes(int side, const std::vector<std::uint16_t>& grey,
                          const std::filesystem::path& folder) {
    const std::filesystem::path input = folder / "face.pgm";
    std::ofstream pgm(input, std::ios::binary);
    pgm << fmt::format("P5\n{} {}\n65535\n", side, side);
    for (const std::uint16_t value : grey)
        pgm.put(static_cast<char>(value >> 8)).put(static_cast<char>(value & 0xFF));
    pgm.close();
    const std::filesystem::path output = folder / "face.j2k";
    const std::string command =
        fmt::format("opj_compress -r 1 -i '{}' -o '{}' >/dev/null 2>&1", input.string(), output.string());
    if (std::system(command.c_str()) != 0) return 0;
    return static_cast<std::size_t>(std::filesystem::file_size(output));
}

struct FinestSizes {
    std::size_t zstd = 0;
    std::size_t deltaZstd = 0;
    std::size_t png = 0;
    std::size_t jpeg2000 = 0;
};

Result<void> addSizes(const planet::ChunkFile& file, planet::Face face, const std::filesystem::path& folder,
                      FinestSizes& sizes) {
    if (!isDense(file.info())) {
        return planet::badInput(fmt::format(
            "{}: has leaves on several levels; expected all leaves at the deepest level", file.name()));
    }
    if (file.info().shape.fractionBits > 0) {
        return planet::badInput(fmt::format(
            "{}: has heights in fractions of its quantum; expected steps of 16 bits", file.name()));
    }
    const int side = planet::faceCells(file.info().shape) + 1;
    FaceImage image{
        side, std::vector<std::int16_t>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
    const Result<planet::ChunkData> root = file.readRoot(face);
    if (!root) return tl::unexpected(root.error());
    if (Result<void> copied = copyLeaves(file, *root, image); !copied) return copied;
    const std::vector<std::uint16_t> grey = greyOf(image, static_cast<std::int16_t>(file.info().minStep));
    const Result<std::size_t> png = pngBytes(side, grey, folder / "face.png");
    if (!png) return tl::unexpected(png.error());
    sizes.png += *png;
    sizes.zstd += zstdBytes(image.steps.data(), image.steps.size() * sizeof(std::int16_t));
    sizes.deltaZstd += deltaZstdBytes(image);
    sizes.jpeg2000 += jpeg2000Bytes(side, grey, folder);
    return {};
}

}  // namespace

BenchRows benchPageIn(const BenchPlanet& planet, const BenchOptions& options) {
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    // All leaves in view from a great height: enough blocks that the time to open the file is negligible.
    const planet::View view = planet::viewFromPose({.latitudeDeg = 27, .longitudeDeg = 87, .altitudeM = 5e6},
                                                   file->info().shape.radiusM, glm::radians(60.0),
                                                   options.size.widthPx, options.size.heightPx);
    planet::LodSettings lod;
    lod.tauPx = 1e-6;
    const planet::UploadChunk nowhere = [](std::uint32_t, planet::StepsView) {};
    planet::PagingSettings paging;
    paging.uploadLimitMs = 100;
    paging.budgetBytes = std::size_t{1} << 30;
    std::vector<BlockToRead> blocks;
    double bytes = 0;
    const std::array<std::function<void()>, 2> jobs = {
        [&] {
            const auto opened = planet::Planet::open(planet.chunkFile, paging);
            if (!opened) return;
            (*opened)->settle(view, lod, nowhere, loadTimeoutS);
            bytes = static_cast<double>((*opened)->paging().bytesRead());
            if (blocks.empty()) blocks = residentBlocks((*opened)->tree());
        },
        [&] {
            for (const BlockToRead& block : blocks)
                static_cast<void>(file->readChildren(block.parent, block.location, *block.parentHeights));
        }};
    const std::vector<std::vector<double>> ms = timeInTurn(jobs, options.rounds);
    if (blocks.empty()) return planet::badInput(planet.chunkFile.string() + ": no block could be loaded");
    std::vector<BenchRow> rows =
        pairedRates({"loading, one loader", "the same blocks in a loop"}, "MB/s", bytes / 1e6, ms);
    rows.front().aim = {.bound = 0.9, .isUpperBound = false, .isOfRatio = true};
    const auto count = static_cast<double>(blocks.size());
    rows.push_back({"either", "blocks", "", {count, count, count}});
    return rows;
}

BenchRows benchBake(const planet::HeightSource& source, int faceSize, const BenchOptions& options,
                    const std::filesystem::path& folder) {
    planet::BakeSettings settings;
    settings.faceSize = faceSize;
    settings.threads = 1;
    Result<planet::BakeReport> report = planet::bake(source, settings, folder / "timed.chk");
    if (!report) return tl::unexpected(report.error());
    const double quantumM = fileQuantumM(report->shape);
    const std::array<std::function<void()>, 2> jobs = {
        [&] { report = planet::bake(source, settings, folder / "timed.chk"); },
        [&] { static_cast<void>(packSource(source, faceSize, quantumM)); }};
    const std::vector<std::vector<double>> ms = timeInTurn(jobs, options.rounds);
    if (!report) return tl::unexpected(report.error());
    std::vector<BenchRow> rows =
        pairedRates({fmt::format("baking faces of {}, one thread", faceSize), "reading and zstd -1"},
                    "Msamples/s", static_cast<double>(report->samples) / 1e6, ms);
    rows.front().aim = {.bound = 13, .isUpperBound = false};
    return rows;
}

BenchRows benchVerify(const BenchPlanet& planet, const BenchOptions& options) {
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    Result<planet::VerifyReport> report;
    const auto verify = [&] { report = planet::verifyFile(*file, nullptr); };
    tbb::task_arena all;
    tbb::task_arena one(1);
    const std::array<std::function<void()>, 2> jobs = {[&] { all.execute(verify); },
                                                       [&] { one.execute(verify); }};
    const std::vector<std::vector<double>> ms = timeInTurn(jobs, options.rounds);
    if (!report) return tl::unexpected(report.error());
    return pairedRates({fmt::format("verifying, {} threads", all.max_concurrency()), "one thread"},
                       "k chunks/s", static_cast<double>(report->chunks) / 1e3, ms);
}

BenchRows benchFileSize(const BenchPlanet& planet, const std::filesystem::path& folder) {
    const Result<planet::ChunkFile> file = planet::ChunkFile::open(planet.chunkFile);
    if (!file) return tl::unexpected(file.error());
    FinestSizes sizes;
    for (const planet::Face face : planet::allFaces) {
        if (const Result<void> added = addSizes(*file, face, folder, sizes); !added)
            return tl::unexpected(added.error());
    }
    const double side = planet::faceCells(file->info().shape) + 1;
    std::vector<BenchRow> rows;
    const auto ours = static_cast<double>(file->sizeBytes());
    const auto add = [&](const char* subject, std::size_t bytes) {
        const double bits = 8 * static_cast<double>(bytes) / (6 * side * side);
        BenchRow row{subject, "per finest sample", "bits", {bits, bits, bits}};
        const double ratio = static_cast<double>(bytes) / ours;
        if (!rows.empty()) row.ratio = {ratio, ratio, ratio}, row.yardstick = "chunk file";
        rows.push_back(std::move(row));
    };
    add("chunk file, all levels", file->sizeBytes());
    add("finest level: zstd -3", sizes.zstd);
    add("finest level: byte-shuffled deltas, zstd -3", sizes.deltaZstd);
    add("finest level: 16-bit PNG", sizes.png);
    if (sizes.jpeg2000 > 0) add("finest level: reversible JPEG 2000", sizes.jpeg2000);
    return rows;
}

}  // namespace worldy
