#include "ui/model/net_cells.h"

#include <cmath>

namespace worldy::ui {

NetSquare netSquare(const planet::ChunkId& id) {
    const NetCell& cell = cellOf(id.face);
    const double side = std::ldexp(1.0, -id.level);
    return {cell.column + id.x * side, cell.row + 1 - (id.y + 1.0) * side, side};
}

}  // namespace worldy::ui
