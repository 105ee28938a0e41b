#include "ui/table_order.h"

#include <fmt/format.h>

namespace ui {

SortKey sortKey(const planet::ChunkId& id) {
    return fmt::format("{} {:02} {:010} {:010}", static_cast<int>(id.face), id.level, id.x, id.y);
}

}  // namespace ui
