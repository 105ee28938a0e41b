#include "planet/paging/normal_tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "planet/base/try.h"
#include "planet/sphere/face_fold.h"

namespace planet {

namespace {

constexpr double steepest = 60'000;  // the largest half float is 65,504

struct Slope {
    double alongU = 0;
    double alongV = 0;
};

// The tangents of Nowell's mapping at (u, v), along the face's normal, u and v.
struct Tangents {
    glm::dvec3 alongU;
    glm::dvec3 alongV;
};
Tangents tangentsAt(double u, double v) {
    const glm::dvec3 roots =
        glm::sqrt(glm::dvec3(1 - (u * u + v * v) / 2 + u * u * v * v / 3, 0.5 - v * v / 6, 0.5 - u * u / 6));
    return {{u * (v * v / 3 - 0.5) / roots.x, roots.y, -u * v / 6 / roots.z},
            {v * (u * u / 3 - 0.5) / roots.x, -u * v / 6 / roots.y, roots.z}};
}

// Returns the alpha of normal_tile.h for the edge u = +-1. Exchange u and v for the edge v = +-1.
double bendAt(double u, double v) {
    const Tangents tangents = tangentsAt(u, v);
    return glm::dot(tangents.alongU, tangents.alongV) / glm::dot(tangents.alongV, tangents.alongV);
}

// The vertices of a chunk of a level's grid.
struct GridChunk {
    std::vector<float> steps;
    bool isRefined = false;  // finer heights exist
};

// Returns the vertices that a chunk would have which lies under a leaf: between the leaf's vertices.
std::vector<float> stepsUnder(const HeldChunk& leaf, const ChunkId& id, int cells) {
    const int levels = id.level - leaf.id.level;
    const auto side = static_cast<std::size_t>(cells) + 1;
    const int firstColumn = static_cast<int>(id.x - (leaf.id.x << levels)) * cells;
    const int firstRow = static_cast<int>(id.y - (leaf.id.y << levels)) * cells;
    const auto step = [&](int column, int row) {
        return static_cast<double>(
            (*leaf.heights)[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)]);
    };
    std::vector<float> steps;
    steps.reserve(side * side);
    for (int j = 0; j <= cells; ++j) {
        const double y = std::ldexp(firstRow + j, -levels);
        const int row = std::min(static_cast<int>(y), cells - 1);
        for (int i = 0; i <= cells; ++i) {
            const double x = std::ldexp(firstColumn + i, -levels);
            const int column = std::min(static_cast<int>(x), cells - 1);
            const double south = std::lerp(step(column, row), step(column + 1, row), x - column);
            const double north = std::lerp(step(column, row + 1), step(column + 1, row + 1), x - column);
            steps.push_back(static_cast<float>(std::lerp(south, north, y - row)));
        }
    }
    return steps;
}

// The heights of one level's grid over the whole planet, between the vertices of leaves of coarser levels
// where the tree is not that deep.
class LevelGrid {
public:
    LevelGrid(const PlanetShape& shape, int level, const std::array<HeldChunk, faceCount>& roots,
              FinestHeights& heights)
        : shape_(shape), level_(level), roots_(roots), heights_(heights) {}

    int cells() const { return chunkCells(shape_) << level_; }
    // Returns the Error of the first chunk that could not be read; heights are 0 after it.
    const std::optional<Error>& problem() const { return problem_; }

    // Returns a chunk of the level; null after a problem.
    const GridChunk* chunk(Face face, int column, int row) {
        const ChunkId id{face, static_cast<std::uint8_t>(level_), static_cast<std::uint32_t>(column),
                         static_cast<std::uint32_t>(row)};
        if (lastChunk_ && id == last_) return lastChunk_;
        const auto found = chunks_.find(id);
        last_ = id;
        lastChunk_ = found != chunks_.end() ? &found->second : read(id);
        return lastChunk_;
    }

    // Returns the height of a point on a face or beyond one of its edges, in steps.
    double step(const FaceGridPoint& point) {
        const FaceGridPoint on = foldedOver(point, cells());
        const int size = chunkCells(shape_);
        const int last = (1 << level_) - 1;
        const int column = std::min(on.column / size, last);
        const int row = std::min(on.row / size, last);
        const GridChunk* held = chunk(on.face, column, row);
        if (!held) return 0;
        return static_cast<double>(held->steps[static_cast<std::size_t>((on.row - row * size) * (size + 1) +
                                                                        on.column - column * size)]);
    }

private:
    const GridChunk* read(const ChunkId& id) {
        if (problem_) return nullptr;
        const Result<HeldChunk> held =
            heights_.chunkUnder(roots_[static_cast<std::size_t>(id.face)], id, ResidentBlocks{});
        if (!held) {
            problem_ = held.error();
            return nullptr;
        }
        if (held->heights->size() != static_cast<std::size_t>(chunkVertexCount(shape_))) {
            problem_ =
                Error{ErrorKind::BadInput, fmt::format("chunk {} has {} heights; expected {}", toString(id),
                                                       held->heights->size(), chunkVertexCount(shape_))};
            return nullptr;
        }
        GridChunk made;
        if (held->id == id) {
            made.steps.resize(held->heights->size());
            for (std::size_t i = 0; i < made.steps.size(); ++i)
                made.steps[i] = static_cast<float>((*held->heights)[i]);
            made.isRefined = held->children.exists();
        } else {
            made.steps = stepsUnder(*held, id, chunkCells(shape_));
        }
        return &chunks_.emplace(id, std::move(made)).first->second;
    }

    const PlanetShape& shape_;
    const int level_;
    const std::array<HeldChunk, faceCount>& roots_;
    FinestHeights& heights_;
    std::unordered_map<ChunkId, GridChunk> chunks_;
    ChunkId last_;
    const GridChunk* lastChunk_ = nullptr;
    std::optional<Error> problem_;
};

// The steps of a part of a face's grid.
struct Window {
    int firstColumn = 0;
    int firstRow = 0;
    int columns = 0;
    int rows = 0;
    std::vector<float> steps;

    double at(int column, int row) const {
        return static_cast<double>(
            steps[static_cast<std::size_t>(row - firstRow) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column - firstColumn)]);
    }
};

// The columns or rows [first, end) of a window that a chunk covers.
struct Covered {
    int first;
    int end;
};
Covered coveredBy(int chunk, int size, int first, int count) {
    return {std::max(chunk * size, first), std::min((chunk + 1) * size + 1, first + count)};
}

void copyChunk(LevelGrid& grid, Face face, int size, int column, int row, Window& window) {
    const GridChunk* chunk = grid.chunk(face, column, row);
    if (!chunk) return;
    const Covered columns = coveredBy(column, size, window.firstColumn, window.columns);
    const Covered rows = coveredBy(row, size, window.firstRow, window.rows);
    for (int r = rows.first; r < rows.end; ++r) {
        const float* from =
            chunk->steps.data() + (r - row * size) * (size + 1) + columns.first - column * size;
        const auto to = static_cast<std::ptrdiff_t>(r - window.firstRow) * window.columns + columns.first -
                        window.firstColumn;
        std::copy_n(from, columns.end - columns.first, window.steps.begin() + to);
    }
}

// Reads the part of a square of texels that lies on the face, and a margin of one vertex.
Window readWindow(LevelGrid& grid, Face face, int size, int firstColumn, int firstRow) {
    const auto clamped = [&](int vertex) { return std::clamp(vertex, 0, grid.cells()); };
    Window window;
    window.firstColumn = clamped(firstColumn - 1);
    window.firstRow = clamped(firstRow - 1);
    window.columns = clamped(firstColumn + tileTexels) + 1 - window.firstColumn;
    window.rows = clamped(firstRow + tileTexels) + 1 - window.firstRow;
    window.steps.resize(static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows));
    const int last = grid.cells() / size - 1;
    const auto lastChunk = [&](int vertex) { return std::min(vertex / size, last); };
    for (int row = lastChunk(window.firstRow); row <= lastChunk(window.firstRow + window.rows - 1); ++row) {
        for (int column = lastChunk(window.firstColumn);
             column <= lastChunk(window.firstColumn + window.columns - 1); ++column)
            copyChunk(grid, face, size, column, row, window);
    }
    return window;
}

// Returns the slope at a vertex on an edge of a face, from its neighbours on both faces.
Slope slopeOnEdge(LevelGrid& grid, const FaceGridPoint& point) {
    const int cells = grid.cells();
    const auto step = [&](int columnsOn, int rowsOn) {
        return grid.step({point.face, point.column + columnsOn, point.row + rowsOn});
    };
    const double perUnit = cells / 4.0;
    const double acrossU = (step(1, 0) - step(-1, 0)) * perUnit;
    const double acrossV = (step(0, 1) - step(0, -1)) * perUnit;
    const double u = 2.0 * point.column / cells - 1;
    const double v = 2.0 * point.row / cells - 1;
    const double bendU = std::abs(u) == 1 ? bendAt(u, v) : 0;
    const double bendV = std::abs(v) == 1 ? bendAt(v, u) : 0;
    const double both = 1 - bendU * bendV;
    return {(acrossU + bendU * acrossV) / both, (acrossV + bendV * acrossU) / both};
}

Slope slopeOnFace(LevelGrid& grid, const FaceGridPoint& point) {
    const bool onEdge =
        point.column == 0 || point.row == 0 || point.column == grid.cells() || point.row == grid.cells();
    if (onEdge) return slopeOnEdge(grid, point);
    const auto step = [&](int columnsOn, int rowsOn) {
        return grid.step({point.face, point.column + columnsOn, point.row + rowsOn});
    };
    const double perUnit = grid.cells() / 4.0;
    return {(step(1, 0) - step(-1, 0)) * perUnit, (step(0, 1) - step(0, -1)) * perUnit};
}

// Returns the slope at a texel beyond one edge, along the axes of the tile's own face, for filters that reach
// over the edge.
Slope slopeBeyondEdge(LevelGrid& grid, const FaceGridPoint& point) {
    const int cells = grid.cells();
    const FaceGridPoint on = foldedOver(point, cells);
    const Slope there = slopeOnFace(grid, on);
    const FaceAxes& own = faceAxes(point.face);
    const FaceAxes& next = faceAxes(on.face);
    const auto along = [&](const glm::dvec3& axis) {
        return glm::dot(axis, next.u) * there.alongU + glm::dot(axis, next.v) * there.alongV;
    };
    const bool overU = point.column < 0 || point.column > cells;
    const double side = (overU ? point.column : point.row) < 0 ? -1 : 1;
    const double across = along(-side * own.normal);
    if (overU) {
        const double alongV = along(own.v);
        return {across + 2 * bendAt(side, 2.0 * point.row / cells - 1) * alongV, alongV};
    }
    const double alongU = along(own.u);
    return {alongU, across + 2 * bendAt(side, 2.0 * point.column / cells - 1) * alongU};
}

// Returns the slope at a texel on an edge of a face or beyond it; slow. Beyond a corner of the cube, where
// there is no fourth face, it is the slope at the corner.
Slope slopeAround(LevelGrid& grid, FaceGridPoint point) {
    const int cells = grid.cells();
    const auto isOver = [&](int vertex) { return vertex < 0 || vertex > cells; };
    if (isOver(point.column) && isOver(point.row)) {
        point.column = std::clamp(point.column, 0, cells);
        point.row = std::clamp(point.row, 0, cells);
    }
    if (isOver(point.column) || isOver(point.row)) return slopeBeyondEdge(grid, point);
    return slopeOnFace(grid, point);
}

// Rounds to the nearest half float, ties to even (after Giesen, "Float->half variants", 2012): about ten
// times as fast as glm.
std::uint16_t halfOf(double value) {
    constexpr std::uint32_t smallestNormal = 0x38800000;  // 2^-14
    constexpr std::uint32_t subnormalStep = 0x3F000000;   // 0.5, whose last bit is worth 2^-24
    const auto bits =
        std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(value, -steepest, steepest)));
    const std::uint32_t sign = (bits & 0x80000000u) >> 16;
    std::uint32_t size = bits & 0x7FFFFFFFu;
    if (size < smallestNormal) {
        const float shifted = std::bit_cast<float>(size) + std::bit_cast<float>(subnormalStep);
        size = std::bit_cast<std::uint32_t>(shifted) - subnormalStep;
    } else {
        const std::uint32_t odd = (size >> 13) & 1u;
        size = (size - 0x38000000u + 0xFFFu + odd) >> 13;  // the exponent counts from 15, not 127
    }
    return static_cast<std::uint16_t>(sign | size);
}

void putTexel(TileData& tile, int column, int row, const Slope& slope, double scale) {
    const std::array<std::uint16_t, 2> halves = {halfOf(slope.alongU * scale), halfOf(slope.alongV * scale)};
    const std::size_t at = static_cast<std::size_t>(row) * tileTexels * sizeof halves +
                           static_cast<std::size_t>(column) * sizeof halves;
    std::memcpy(tile.texels.data() + at, halves.data(), sizeof halves);
}

// Returns whether finer heights exist somewhere on a tile's own square.
bool isRefined(LevelGrid& grid, const ChunkId& tile, int size) {
    const int chunks = tileCells / size;  // along the tile
    const int firstColumn = static_cast<int>(tile.x) * chunks;
    const int firstRow = static_cast<int>(tile.y) * chunks;
    for (int row = firstRow; row < firstRow + chunks; ++row) {
        for (int column = firstColumn; column < firstColumn + chunks; ++column) {
            const GridChunk* chunk = grid.chunk(tile.face, column, row);
            if (chunk && chunk->isRefined) return true;
        }
    }
    return false;
}

}  // namespace

int normalLeafLevel(const PlanetShape& shape) {
    return std::clamp(shape.faceCellsLog2 - tileCellsLog2, -1, maxTileLevel);
}

NormalDeriver::NormalDeriver(const PlanetShape& shape, const std::array<HeldChunk, faceCount>& roots,
                             LoadChildren load)
    : shape_(shape),
      roots_(roots),
      heights_(
          [this, load = std::move(load)](const ChunkId& parent, BlockLocation location,
                                         StepsView parentHeights) {
              bytesRead_ += location.size;
              return load(parent, location, parentHeights);
          },
          0) {}

Result<TileData> NormalDeriver::tile(const ChunkId& id) {
    assert(id.level <= normalLeafLevel(shape_));
    const int size = chunkCells(shape_);
    LevelGrid grid(shape_, id.level + tileCellsLog2 - shape_.chunkCellsLog2, roots_, heights_);
    const int cells = grid.cells();
    const int firstColumn = static_cast<int>(id.x) * tileCells - tileBorderBefore;
    const int firstRow = static_cast<int>(id.y) * tileCells - tileBorderBefore;
    const Window window = readWindow(grid, id.face, size, firstColumn, firstRow);
    const double scale = shape_.quantumM / shape_.radiusM;
    const double perUnit = cells / 4.0;
    TileData tile{id, {}, std::vector<std::byte>(normalTileBytes)};
    for (int j = 0; j < tileTexels && !grid.problem(); ++j) {
        const int row = firstRow + j;
        for (int i = 0; i < tileTexels; ++i) {
            const int column = firstColumn + i;
            const bool inside = column > 0 && column < cells && row > 0 && row < cells;
            const Slope slope =
                inside ? Slope{(window.at(column + 1, row) - window.at(column - 1, row)) * perUnit,
                               (window.at(column, row + 1) - window.at(column, row - 1)) * perUnit}
                       : slopeAround(grid, {id.face, column, row});
            putTexel(tile, i, j, slope, scale);
        }
    }
    if (grid.problem())
        return tl::unexpected(Error{grid.problem()->kind, fmt::format("normals of tile {}: {}", toString(id),
                                                                      grid.problem()->message)});
    tile.isRefined = isRefined(grid, id, size);
    return tile;
}

Result<TileBlock> NormalDeriver::childrenOf(const ChunkId& parent) {
    TileBlock block;
    for (int q = 0; q < quadrantCount; ++q) {
        TRY_ASSIGN(block[static_cast<std::size_t>(q)], tile(childOf(parent, q)));
    }
    return block;
}

}  // namespace planet
