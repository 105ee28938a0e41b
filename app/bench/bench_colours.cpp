#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/bench/bench_parts.h"
#include "planet/bake/bake.h"
#include "planet/bake/colour_report.h"
#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/draw/chunk_renderer.h"
#include "planet/planet.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

using planet::ColourFormat;
using planet::Result;

// Returns synthetic colours for use without an image: patches with grain, of a size that is fast to compute.
planet::ColourSource madeColours() {
    planet::ColourSource source;
    source.description = "synthetic colours";
    source.naturalFaceSize = 513;
    source.sample = [](const planet::SampleTile& tile, std::span<glm::vec3> out) -> Result<void> {
        std::size_t at = 0;
        for (int j = 0; j < tile.rows; ++j) {
            for (int i = 0; i < tile.columns; ++i) {
                const double u = 2.0 * (tile.firstColumn + i) / tile.faceCells - 1;
                const double v = 2.0 * (tile.firstRow + j) / tile.faceCells - 1;
                const glm::dvec3 d = planet::sphereFromCube(planet::cubePoint(tile.face, u, v));
                const double grain = 0.5 + 0.25 * std::sin(91 * d.x + 37 * d.z) + 0.25 * std::sin(83 * d.y);
                out[at++] = glm::vec3(0.3 * grain, 0.2 + 0.1 * std::sin(5 * d.x), 0.1 * grain);
            }
        }
        return {};
    };
    return source;
}

// Bakes six chunks without children, so that only colours are paged.
Result<planet::ChunkFile> bakeColours(const planet::ColourSource& colours, ColourFormat format,
                                      const std::filesystem::path& output) {
    planet::BakeSettings settings;
    settings.faceSize = 33;
    settings.colour.format = format;
    const auto heights = planet::openHeightSource("noise:fbm", {});
    if (!heights) return tl::unexpected(heights.error());
    const auto report = planet::bake(*heights, settings, output, {}, &colours);
    if (!report) return tl::unexpected(report.error());
    return planet::ChunkFile::open(output);
}

Result<void> readUnder(const planet::ChunkFile& file, const planet::TileData& tile) {
    if (!tile.children.exists()) return {};
    const auto children = file.readColourChildren(tile.id, tile.children);
    if (!children) return tl::unexpected(children.error());
    for (const planet::TileData& child : *children) {
        if (auto read = readUnder(file, child); !read) return read;
    }
    return {};
}

// Reads, checks and unpacks each block once on one thread.
Result<void> readAll(const planet::ChunkFile& file) {
    for (const planet::Face face : planet::allFaces) {
        const auto root = file.readColourRoot(face);
        if (!root) return tl::unexpected(root.error());
        if (auto read = readUnder(file, *root); !read) return read;
    }
    return {};
}

struct Pool {
    planet::gl::ChunkRenderer renderer;
    std::size_t bytes = 0;
};

Result<Pool> makePool(const planet::ChunkFile& file, std::uint64_t tiles) {
    auto renderer = planet::gl::ChunkRenderer::create({file.info().shape, planet::faceCount, {}});
    if (!renderer) return tl::unexpected(renderer.error());
    const std::size_t before = renderer->gpuMemory().total();
    const planet::ColourPyramid& colour = *file.info().colour;
    const auto made = renderer->setColours(
        planet::gl::ColourPoolConfig{colour.format, colour.leafLevel, static_cast<std::uint32_t>(tiles)});
    if (!made) return tl::unexpected(made.error());
    const std::size_t bytes = renderer->gpuMemory().total() - before;
    return Pool{std::move(*renderer), bytes};
}

// Pages in all tiles with one loader. The Error says that they were not loaded.
Result<void> pageInAll(const std::filesystem::path& chunkFile, std::uint64_t tiles, Pool& pool) {
    planet::PagingSettings paging;
    paging.budgetBytes = std::size_t{2} << 30;
    paging.colourShare = 0.9;
    paging.uploadLimitMs = 100;
    const auto planet = planet::Planet::open(chunkFile, paging);
    if (!planet) return tl::unexpected(planet.error());
    planet::ViewInput input;
    input.lodView = planet::viewFromPose({.altitudeM = 1e7}, (*planet)->tree().shape.radiusM, 1.0, 640, 480);
    input.lod.frustumCulling = input.lod.horizonCulling = false;
    input.colours = {.enabled = true, .texelsPerPixel = 1e9};
    const Stopwatch watch;
    while ((*planet)->paging()[planet::BlockKind::Colours].resident < tiles) {
        (*planet)->step({&input, 1}, [](std::uint32_t, planet::StepsView) {});
        pool.renderer.followColours((*planet)->takeTileChanges(planet::BlockKind::Colours));
        if (watch.elapsedMs() > 1000 * loadTimeoutS ||
            (*planet)->paging()[planet::BlockKind::Colours].failed > 0)
            return planet::ioError(chunkFile.string() + ": not all of its colours could be loaded");
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    glFinish();
    return {};
}

std::vector<BenchRow> rateRows(const std::string& name, double tiles,
                               const std::vector<std::vector<double>>& ms) {
    constexpr double megatexelsPerTile = planet::colourTileCells * planet::colourTileCells / 1e6;
    const auto perSecond = [](double amount, const std::vector<double>& times) {
        std::vector<double> rates;
        for (const double time : times) rates.push_back(1000 * amount / time);
        return rates;
    };
    const std::string loop = name + ", the same in a loop";
    const std::vector<double> ours = perSecond(tiles, ms[0]);
    const std::vector<double> plain = perSecond(tiles, ms[1]);
    const Spread ratio = spreadOf(ratios(ours, plain));
    return {{name + ", loaded and uploaded", "rate", "tiles/s", spreadOf(ours), ratio, loop},
            {name + ", loaded and uploaded", "rate", "Mtexel/s",
             spreadOf(perSecond(tiles * megatexelsPerTile, ms[0])), ratio, loop},
            {loop, "rate", "tiles/s", spreadOf(plain)}};
}

BenchRow once(const std::string& name, const char* quantity, double bytes) {
    const double kibibytes = bytes / 1024;
    return {name + ", per tile", quantity, "KiB", {kibibytes, kibibytes, kibibytes}};
}

BenchRows benchFormat(const planet::ColourSource& colours, ColourFormat format, const BenchOptions& options,
                      const std::filesystem::path& folder) {
    const std::string name = format == ColourFormat::Bc1 ? "BC1" : "lossless";
    const std::filesystem::path path = folder / ("colours_" + name + ".chk");
    const Result<planet::ChunkFile> file = bakeColours(colours, format, path);
    if (!file) return tl::unexpected(file.error());
    const std::uint64_t tiles = planet::tileCountOf(file->info().colour->leafLevel);
    Result<Pool> pool = makePool(*file, tiles);
    if (!pool) return tl::unexpected(pool.error());
    Result<void> done;
    const auto keep = [&](const Result<void>& result) {
        if (!result && done) done = result;
    };
    const std::array<std::function<void()>, 2> jobs = {[&] { keep(pageInAll(path, tiles, *pool)); },
                                                       [&] { keep(readAll(*file)); }};
    const std::vector<std::vector<double>> ms = timeInTurn(jobs, options.rounds);
    if (!done) return tl::unexpected(done.error());
    std::vector<BenchRow> rows = rateRows(name, static_cast<double>(tiles), ms);
    const Result<std::vector<planet::ColourLevelReport>> levels = planet::reportColours(*file);
    if (!levels) return tl::unexpected(levels.error());
    double fileBytes = 0;
    for (const planet::ColourLevelReport& level : *levels) fileBytes += static_cast<double>(level.bytes);
    const auto count = static_cast<double>(tiles);
    rows.push_back(once(name, "file", fileBytes / count));
    rows.push_back(once(name, "GPU memory", static_cast<double>(pool->bytes) / count));
    rows.push_back(once(name, "CPU memory", sizeof(planet::TileNode)));
    return rows;
}

}  // namespace

BenchRows benchColours(const std::filesystem::path& image, const BenchOptions& options,
                       const std::filesystem::path& folder) {
    const auto context = planet::gl::OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    planet::ColourSource colours = madeColours();
    if (!image.empty()) {
        Result<planet::ColourSource> opened = planet::openColourSource(image);
        if (!opened) return tl::unexpected(opened.error());
        colours = std::move(*opened);
    }
    BenchRows all = std::vector<BenchRow>{};
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        const BenchRows rows = benchFormat(colours, format, options, folder);
        if (!rows) return rows;
        all->insert(all->end(), rows->begin(), rows->end());
    }
    return all;
}

}  // namespace worldy
