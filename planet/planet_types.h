// The inputs of Planet::open and Planet::step (planet.h), as plain data.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planet/format/chunk_file.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_types.h"
#include "planet/select/lod_types.h"
#include "planet/select/tile_select.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"

namespace planet {

// The content of a planet: a chunk file, or an equivalent for tests and generated planets.
struct PlanetSource {
    PlanetShape shape;
    std::int32_t minStep = 0;  // over the whole planet
    std::int32_t maxStep = 0;
    std::uint64_t chunks = 0;                // of all levels; 0: all leaves are at the deepest level
    std::array<ChunkData, faceCount> roots;  // in face order
    LoadChildren loadChildren;
    // The colours; unset without a pyramid.
    std::optional<ColourPyramid> colour{};
    std::array<TileData, faceCount> colourRoots{};
    LoadColours loadColours{};
    std::vector<std::string> problems{};    // non-fatal problems found while opening, for takeProblems()
    std::shared_ptr<const ChunkFile> file;  // the file that it was read from; may be null
};

// One of the views that share a planet.
struct ViewInput {
    View lodView;
    LodSettings lod;
    double priorityFactor = 1;  // factor on the priorities of its requests relative to other views; > 0
    TileSettings colours{};
    TileSettings normals{};
};

inline constexpr std::size_t maxAnnounced = 64;
inline constexpr double latestAnnouncedS = 3600;

// A view that a camera will have.
struct AnnouncedView {
    View view;
    double inS = 0;  // seconds from the announcement, in the time of step(), [0, latestAnnouncedS]
};

// One view of the last step.
struct PlanetView {
    ViewInput input;
    Selection selection;
    TileSelection colours;
    TileSelection normals;

    // Returns the selection of tiles; kind must not be Heights.
    const TileSelection& tiles(BlockKind kind) const {
        return kind == BlockKind::Colours ? colours : normals;
    }
};

// The duration of each stage of the last step, ms.
struct StageTimes {
    double uploadMs = 0;
    double selectMs = 0;
    double pagingMs = 0;  // page-outs and requests
};

struct LastStep {
    StageTimes times;
    double nowS = 0;      // since the planet was opened, at the last step
    double elapsedS = 0;  // between the last two steps
};

}  // namespace planet
