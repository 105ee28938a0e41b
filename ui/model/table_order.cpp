#include "ui/model/table_order.h"

#include <fmt/format.h>

#include <charconv>

namespace worldy::ui {

SortKey textSortKey(const std::string& text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && last == end) return number;
    return text;
}

SortKey sortKey(const planet::ChunkId& id) {
    return fmt::format("{} {:02} {:010} {:010}", static_cast<int>(id.face), id.level, id.x, id.y);
}

}  // namespace worldy::ui
