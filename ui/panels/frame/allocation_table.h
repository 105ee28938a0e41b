// The Frame panel's table of allocations: current values and their change since a mark, so that leaks show.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ui/model/allocations_view.h"
#include "ui/model/commands.h"
#include "ui/model/export_table.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

struct AllocationRow {
    const char* name;
    const char* explanation;
    double (*value)(const Allocations&);
    bool bytes;         // bytes; otherwise a count
    const char* group;  // heading above the first row of a group; null: same group
};
std::span<const AllocationRow> allocationRows();

// Returns the key by which a row is sorted by a column. view.now must be set.
enum class AllocationColumn : std::uint8_t { Kind, Now, Change, Mark };
SortKey allocationSortKey(std::size_t row, AllocationColumn column, const AllocationsView& view);

std::string allocationText(const AllocationRow& row, const Allocations& held);
// Returns for example "+1.2 MiB", "-3" or "=".
std::string allocationChange(const AllocationRow& row, const Allocations& before, const Allocations& now);
// Returns the rows with unrounded values. view: as long as the table is used; view.now must be set.
ExportTable allocationExport(const AllocationsView& view);

// Returns the width at which the table shows all columns but Mark, pixels.
float allocationTableWidth();
// Fills the current column.
void allocationTable(const AllocationsView& view, double timeS, Commands& commands);

}  // namespace worldy::ui
