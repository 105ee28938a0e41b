// Sorts tables by the column the user chose. Pure functions, any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planet/sphere/chunk_id.h"

namespace worldy::ui {

// The value by which a cell is sorted: numbers by value, texts alphabetically.
using SortKey = std::variant<double, std::string>;

struct TableSort {
    std::size_t column = 0;
    bool descending = false;
};

// Returns a key that sorts texts with numbers by value, before other texts.
SortKey textSortKey(const std::string& text);
// Returns a key that sorts chunks by face, then level, x and y.
SortKey sortKey(const planet::ChunkId& id);

// Returns the row numbers [0, rows) in display order. key(row, column) is a cell's SortKey. The sort is
// stable; without one, rows keep their order.
template <class Key>
std::vector<std::size_t> tableOrder(std::size_t rows, const std::optional<TableSort>& sort, const Key& key) {
    std::vector<std::size_t> order(rows);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!sort) return order;
    std::vector<SortKey> keys;
    keys.reserve(rows);
    for (std::size_t row = 0; row < rows; ++row) keys.push_back(key(row, sort->column));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sort->descending ? keys[b] < keys[a] : keys[a] < keys[b];
    });
    return order;
}

}  // namespace worldy::ui
