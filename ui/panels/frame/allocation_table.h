// The Frame panel's table of what the program holds: now, and against a mark, so that a leak shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ui/model/allocations_view.h"
#include "ui/model/commands.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

struct AllocationRow {
    const char* name;
    const char* explanation;
    double (*value)(const Allocations&);
    bool bytes;         // else a number
    const char* group;  // a heading over the first of a group; null: goes on
};
std::span<const AllocationRow> allocationRows();

// Sorts a row by a column of the table; view.now must be set.
enum class AllocationColumn : std::uint8_t { Kind, Now, Change, Mark };
SortKey allocationSortKey(std::size_t row, AllocationColumn column, const AllocationsView& view);

std::string allocationText(const AllocationRow& row, const Allocations& held);
// "+1.2 MiB", "-3", "=".
std::string allocationChange(const AllocationRow& row, const Allocations& before, const Allocations& now);
// All rows with tabs between, to be put beside another day's.
std::string allocationsText(const AllocationsView& view);

// Returns the width at which the table shows all columns but the one of the mark, pixels.
float allocationTableWidth();
// Fills the current column.
void allocationTable(const AllocationsView& view, double timeS, Commands& commands);

}  // namespace worldy::ui
