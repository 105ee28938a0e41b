#include "ui/model/compare_order.h"

#include <limits>
#include <string>

namespace worldy::ui {

SortKey figureSortKey(const CompareRow& row, FigureColumn column,
                      const std::array<ComparedFigures, 2>& figures) {
    constexpr double unknown = -1;
    const auto& a = figures[0].*row.value;
    const auto& b = figures[1].*row.value;
    switch (column) {
        case FigureColumn::Name:
            return std::string(row.name);
        case FigureColumn::A:
            return a.value_or(unknown);
        case FigureColumn::B:
            return b.value_or(unknown);
        case FigureColumn::Change:
            break;
    }
    if (!a || !b) return unknown;
    if (*a == *b) return 1.0;
    return *a == 0 ? std::numeric_limits<double>::infinity() : *b / *a;
}

}  // namespace worldy::ui
