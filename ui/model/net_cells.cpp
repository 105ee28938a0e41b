#include "ui/model/net_cells.h"

#include <cmath>

namespace worldy::ui {

NetSquare netSquare(const planet::ChunkId& id) {
    const NetCell& cell = cellOf(id.face);
    const double side = std::ldexp(1.0, -id.level);
    return {cell.column + id.x * side, cell.row + 1 - (id.y + 1.0) * side, side};
}

std::optional<planet::ChunkId> steppedChunk(const std::optional<planet::ChunkId>& from, const PlotKeys& keys,
                                            const planet::FacePoint& point, int deepestLevel) {
    if (keys.right == 0 && keys.up == 0 && keys.pagesDown == 0) return std::nullopt;
    if (!from) return planet::chunkAt(point, 0);
    planet::ChunkId at = *from;
    if (keys.right != 0)
        at = planet::neighbourOf(at, keys.right > 0 ? planet::Edge::East : planet::Edge::West);
    if (keys.up != 0) at = planet::neighbourOf(at, keys.up > 0 ? planet::Edge::North : planet::Edge::South);
    if (keys.pagesDown < 0 && at.level > 0) at = planet::parentOf(at);
    if (keys.pagesDown > 0 && at.level < deepestLevel) {
        const planet::ChunkId towards = planet::chunkAt(point, at.level + 1);
        at = planet::parentOf(towards) == at ? towards : planet::childOf(at, 0);
    }
    return at;
}

}  // namespace worldy::ui
