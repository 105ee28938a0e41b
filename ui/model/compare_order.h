// Sorts the figures of two compared planets. Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>

#include "app/measure/compare_table.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

// Returns the key by which a row of figures of A and B is sorted. Unknown figures come first. The column
// Change sorts by the ratio B / A: 1 if both are equal, infinity if only A is 0.
enum class FigureColumn : std::uint8_t { Name, Change, A, B };
SortKey figureSortKey(const CompareRow& row, FigureColumn column,
                      const std::array<ComparedFigures, 2>& figures);

}  // namespace worldy::ui
