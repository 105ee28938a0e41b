// Copies and saves what tables and plots show: one call after a table or a plot adds a menu to it, on a right click and by
// a small button in its corner while the pointer is over it.
//
// Rows can be selected, to copy or save only these. Ctrl+click adds a row or takes it away, Shift+click selects from the
// row clicked last to this one; neither does what a plain click on the row does. A plain click selects a row only where
// it has no other meaning. Ctrl+C over a table copies the selected rows, or all if none is.
//
// The state of the frame is global, like Dear ImGui's own. One thread.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ui/model/commands.h"
#include "ui/model/export_table.h"

namespace worldy::ui {

// The rows that the user has selected in a table, by rowKey().
struct RowSelection {
    std::unordered_set<std::size_t> rows;
    std::optional<std::size_t> last;  // clicked last
};

// A plot whose picture the user wants. It is taken in a later frame, without the menu and without tooltips.
struct WantedPicture {
    ImGuiID plot = 0;
    int frames = 0;  // since it was asked for
};

// The state of a window's exports between frames.
struct ExportState {
    std::unordered_map<ImGuiID, RowSelection> selections;  // by table
    std::optional<WantedPicture> picture;
};

// From here to endExports(), tables and plots have their menus, which append to commands. Without these calls, for
// example in pictures of single panels, they have none. While a picture is wanted, nothing is hovered.
void beginExports(ExportState& state, Commands& commands);
void endExports();

// Ends the table that tables.h has begun, in place of ImGui::EndTable(), and adds the menu. Rows are numbered as in
// tableRows() and tableRow().
void endTable(const ExportTable& table);

// Adds the menu to the plot that is ImGui's last item: its samples, one row each, and its picture. id: unique in the
// window. byRightClick: false for a plot in which the right button has another meaning.
void exportPlot(const char* id, const ExportTable& samples, bool byRightClick = true);

namespace detail {

// Functions with which tables.h describes the table that is being drawn.
void beginRows();                               // a new table
void noteOrder(std::vector<std::size_t> rows);  // in which rows are shown, if it is not that of their numbers
void beginRow(std::size_t row);                 // after ImGui::TableNextRow()
void endRow();

}  // namespace detail

}  // namespace worldy::ui
