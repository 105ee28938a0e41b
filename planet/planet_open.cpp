// Opens a planet from a chunk file: everything that the runtime needs of the file itself.
#include "planet/base/try.h"
#include "planet/paging/normal_roots.h"
#include "planet/planet.h"

namespace planet {

namespace {

Result<std::array<ChunkData, faceCount>> readRoots(const ChunkFile& file) {
    std::array<ChunkData, faceCount> roots;
    for (const Face face : allFaces) {
        TRY_ASSIGN(roots[static_cast<std::size_t>(face)], readRoot([&] { return file.readRoot(face); }));
    }
    return roots;
}

// Reads the roots of colours. An unreadable root becomes a checker pattern without descendants.
void readColourRoots(const ChunkFile& file, PlanetSource& source) {
    for (const Face face : allFaces) {
        TileData& root = source.colourRoots[static_cast<std::size_t>(face)];
        Result<TileData> read = readRoot([&] { return file.readColourRoot(face); });
        if (read) {
            root = std::move(*read);
        } else {
            source.problems.push_back(std::move(read.error().message));
            root = {{face, 0, 0, 0}, {}, checkerTexels(file.info().colour->format)};
        }
    }
}

}  // namespace

Result<std::unique_ptr<Planet>> Planet::open(const std::filesystem::path& path,
                                             const PagingSettings& settings, const FileCalls& calls) {
    TRY_ASSIGN(auto file, ChunkFile::open(path, calls));
    TRY_ASSIGN(auto source, planetSource(std::move(file)));
    return open(std::move(source), settings);
}

Result<PlanetSource> planetSource(ChunkFile file) {
    const auto shared = std::make_shared<const ChunkFile>(std::move(file));
    PlanetSource source;
    TRY_ASSIGN(source.roots, readRoots(*shared));
    source.shape = shared->info().shape;
    source.minStep = shared->info().minStep;
    source.maxStep = shared->info().maxStep;
    source.chunks = shared->info().chunks;
    source.loadChildren = [shared](const ChunkId& parent, BlockLocation location, StepsView parentHeights) {
        return shared->readChildren(parent, location, parentHeights);
    };
    if (shared->info().colour) {
        source.colour = shared->info().colour;
        readColourRoots(*shared, source);
        source.loadColours = [shared](const ChunkId& parent, BlockLocation location) {
            return shared->readColourChildren(parent, location);
        };
    }
    source.file = shared;
    return source;
}

}  // namespace planet
