#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <thread>

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
    const auto loadWith = [&](int loaders) {
        paging.loaderThreads = loaders;
        const auto opened = planet::Planet::open(planet.chunkFile, paging);
        if (!opened) return;
        (*opened)->settle(view, lod, nowhere, loadTimeoutS);
        bytes = static_cast<double>((*opened)->paging().bytesRead());
        if (blocks.empty()) blocks = residentBlocks((*opened)->tree());
    };
    const auto readOne = [&](const BlockToRead& block) {
        return file->readChildren(block.parent, block.location, *block.parentHeights);
    };
    // Every other block, for two threads.
    const auto readHalf = [&](std::size_t first) {
        for (std::size_t i = first; i < blocks.size(); i += 2) static_cast<void>(readOne(blocks[i]));
    };
    const std::array<std::function<void()>, 5> jobs = {
        [&] { loadWith(1); },
        [&] {
            for (const BlockToRead& block : blocks) static_cast<void>(readOne(block));
        },
        [&] { loadWith(2); },
        // Loading keeps what it has read, and new memory takes time.
        [&] {
            std::vector<Result<planet::SiblingBlock>> kept;
            for (const BlockToRead& block : blocks) kept.push_back(readOne(block));
        },
        [&] {
            const std::jthread other(readHalf, std::size_t{1});
            readHalf(0);
        }};
    const std::vector<std::vector<double>> ms = timeInTurn(jobs, options.rounds);
    if (blocks.empty()) return planet::badInput(planet.chunkFile.string() + ": no block could be loaded");
    const std::string loop = "the same blocks in a loop";
    std::vector<BenchRow> rows = pairedRates({"loading, one loader", loop}, "MB/s", bytes / 1e6, ms);
    BenchRow two = pairedRates({"loading, two loaders", loop}, "MB/s", bytes / 1e6, {ms[2], ms[1]}).front();
    rows.front().aim = {.bound = 0.9, .isUpperBound = false, .isOfRatio = true};
    two.aim = {.bound = 1.6, .isUpperBound = false, .isOfRatio = true};
    rows.insert(rows.begin() + 1, std::move(two));
    // This row shows how much faster two threads are on this machine if they only read and decode.
    rows.push_back(pairedRates({loop + ", two threads", loop}, "MB/s", bytes / 1e6, {ms[4], ms[1]}).front());
    rows.push_back({loop + ", kept in memory", "rate", "MB/s", spreadOf(perSecond(bytes / 1e6, ms[3]))});
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

}  // namespace worldy
