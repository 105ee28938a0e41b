#include "ui/kit/exports.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"

namespace worldy::ui {

namespace {

// A drawn row and its place on the screen.
struct DrawnRow {
    std::size_t row = 0;
    float top = 0;
    float bottom = 0;
};

// Belongs to the frame.
struct {
    ExportState* state = nullptr;
    Commands* commands = nullptr;
} exportFrame;

// Belongs to the table that is being drawn.
struct {
    std::vector<DrawnRow> rows;
    std::optional<std::vector<std::size_t>> order;
} drawnTable;

bool selectsRows() {
    const ImGuiIO& io = ImGui::GetIO();
    return exportFrame.state && (io.KeyCtrl || io.KeyShift);
}

// Items that are drawn over a table or a plot must not change the layout, nor what ImGui takes for the last item.
class KeptLayout {
public:
    KeptLayout() : window_(*ImGui::GetCurrentWindow()), item_(GImGui->LastItemData) {
        const ImGuiWindowTempData& dc = window_.DC;
        places_ = {dc.CursorPos,   dc.CursorPosPrevLine, dc.CursorMaxPos,
                   dc.IdealMaxPos, dc.CurrLineSize,      dc.PrevLineSize};
        baselines_ = {dc.CurrLineTextBaseOffset, dc.PrevLineTextBaseOffset};
    }
    ~KeptLayout() {
        ImGuiWindowTempData& dc = window_.DC;
        dc.CursorPos = places_[0];
        dc.CursorPosPrevLine = places_[1];
        dc.CursorMaxPos = places_[2];
        dc.IdealMaxPos = places_[3];
        dc.CurrLineSize = places_[4];
        dc.PrevLineSize = places_[5];
        dc.CurrLineTextBaseOffset = baselines_[0];
        dc.PrevLineTextBaseOffset = baselines_[1];
        GImGui->LastItemData = item_;
    }
    KeptLayout(const KeptLayout&) = delete;
    KeptLayout& operator=(const KeptLayout&) = delete;

private:
    ImGuiWindow& window_;
    ImGuiLastItemData item_;
    std::array<ImVec2, 6> places_{};
    std::array<float, 2> baselines_{};
};

// Draws the button in the top right corner of an area. Returns true if it is pressed. It is a window of its own, so that
// it is pressed rather than what lies under it.
bool cornerButton(const ImRect& area, const std::string& name) {
    const float side = std::min(std::round(ImGui::GetFontSize() * 1.1f), area.GetHeight());
    const ImVec2 at(area.Max.x - side, area.Min.y);
    const ImRect clip = ImGui::GetCurrentWindow()->ClipRect;
    if (clip.Contains(at)) noteRect(name + " menu", {at.x, at.y, side, side});
    // The button stays while it is held down, when it is the active item itself.
    const bool isOver = ImGui::IsMouseHoveringRect(area.Min, area.Max) &&
                        ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows |
                                               ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    if (!isOver) return false;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::SetCursorScreenPos(at);
    ImGui::BeginChild("##corner", {side, side}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                          ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings);
    const bool pressed = ImGui::InvisibleButton("menu", {side, side});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 ground =
        ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_ButtonHovered : ImGuiCol_PopupBg);
    list.AddRectFilled(at, {at.x + side, at.y + side}, ground, ImGui::GetStyle().FrameRounding);
    for (const float share : {0.3f, 0.5f, 0.7f}) {
        const float y = std::round(at.y + share * side);
        list.AddLine({at.x + 0.25f * side, y}, {at.x + 0.75f * side, y}, packed(palette().text));
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Copy or save what is shown here.");
    ImGui::EndChild();
    ImGui::PopStyleVar();
    return pressed;
}

// Draws the menu of an area, and its button if name is not empty. Exports stay possible where a panel greys its results as
// out of date.
template <class DrawItems>
void menuOver(ImGuiID id, const ImRect& area, const std::string& name, bool rightClicked,
              const DrawItems& items) {
    const KeptLayout kept;
    ImGui::PushItemFlag(ImGuiItemFlags_Disabled, false);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1);
    ImGui::PushOverrideID(id);
    const bool pressed = !name.empty() && cornerButton(area, name);
    // A name with a menu of its own has already opened that.
    const bool hasOther = GImGui->OpenPopupStack.Size > GImGui->BeginPopupStack.Size;
    if (pressed || (rightClicked && !hasOther)) ImGui::OpenPopup("exports");
    if (ImGui::BeginPopup("exports")) {
        items();
        ImGui::EndPopup();
    }
    ImGui::PopID();
    ImGui::PopStyleVar();
    ImGui::PopItemFlag();
}

bool menuItem(const std::string& label, const char* shortcut = nullptr) {
    const bool chosen = ImGui::MenuItem(label.c_str(), shortcut);
    noteItem(label);
    return chosen;
}

void save(const ExportTable& table, const char* extension, std::string text) {
    exportFrame.commands->push_back(SaveExport{table.name, extension, std::move(text)});
}

void copy(const ExportTable& table, std::span<const std::size_t> rows, const char* what) {
    exportFrame.commands->push_back(
        CopyText{tsvOf(table, rows, false), "Copied " + countedText(rows.size(), what)});
}

std::vector<std::size_t> allRows(const ExportTable& table) {
    std::vector<std::size_t> rows(table.rows);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return rows;
}

// The selection of one table in this frame.
class TableRows {
public:
    TableRows(const ExportTable& table, ImGuiID id)
        : table_(table), selection_(exportFrame.state->selections[id]) {}

    bool isSelected(std::size_t row) const {
        return !selection_.rows.empty() && selection_.rows.contains(rowKey(table_, row));
    }
    bool hasSelection() const { return !selection_.rows.empty(); }

    // Returns all rows in the order in which they are shown.
    std::vector<std::size_t> all() const {
        if (table_.sortAll) table_.sortAll();
        if (drawnTable.order && drawnTable.order->size() == table_.rows) return *drawnTable.order;
        if (drawnTable.rows.size() != table_.rows) return allRows(table_);
        std::vector<std::size_t> rows;
        for (const DrawnRow& row : drawnTable.rows) rows.push_back(row.row);
        return rows;
    }
    std::vector<std::size_t> selected() const {
        std::vector<std::size_t> rows = all();
        std::erase_if(rows, [&](std::size_t row) { return !isSelected(row); });
        return rows;
    }
    // Returns the selected rows, or all if none is selected.
    std::vector<std::size_t> wanted() const {
        std::vector<std::size_t> rows = hasSelection() ? selected() : all();
        return rows.empty() ? all() : rows;
    }

    void click(std::size_t row) {
        const std::size_t key = rowKey(table_, row);
        const ImGuiIO& io = ImGui::GetIO();
        if (io.KeyShift && selection_.last) return selectTo(key);
        const bool wasOnlyOne = selection_.rows.size() == 1 && selection_.rows.contains(key);
        if (!io.KeyCtrl) selection_.rows.clear();
        if (!wasOnlyOne && !(io.KeyCtrl && selection_.rows.erase(key) > 0)) selection_.rows.insert(key);
        if (io.KeyCtrl && wasOnlyOne) selection_.rows.clear();
        selection_.last = key;
    }
    void selectAll() {
        selection_.rows.clear();
        for (const std::size_t row : all()) selection_.rows.insert(rowKey(table_, row));
    }
    void clear() { selection_ = {}; }

private:
    void selectTo(std::size_t key) {
        std::vector<std::size_t> keys;
        for (const std::size_t row : all()) keys.push_back(rowKey(table_, row));
        auto from = std::find(keys.begin(), keys.end(), *selection_.last);
        auto to = std::find(keys.begin(), keys.end(), key);
        if (from == keys.end()) from = to;  // the row clicked last is gone
        if (to < from) std::swap(from, to);
        if (!ImGui::GetIO().KeyCtrl) selection_.rows.clear();
        if (to != keys.end()) selection_.rows.insert(from, to + 1);
    }

    const ExportTable& table_;
    RowSelection& selection_;
};

void rowItems(const ExportTable& table, const std::vector<std::size_t>& rows, const std::string& which,
              const char* shortcut) {
    if (menuItem(fmt::format("Copy {}", which), shortcut)) copy(table, rows, "row");
    if (menuItem(fmt::format("Save {} as CSV", which))) save(table, "csv", csvOf(table, rows));
    if (menuItem(fmt::format("Save {} as TSV", which))) save(table, "tsv", tsvOf(table, rows, true));
}

void tableMenu(const ExportTable& table, TableRows& rows) {
    const bool some = rows.hasSelection();
    const std::vector<std::size_t> selected = some ? rows.selected() : std::vector<std::size_t>();
    if (!selected.empty()) {
        rowItems(table, selected, "selected", "Ctrl+C");
        ImGui::Separator();
    }
    rowItems(table, rows.all(), "all", selected.empty() ? "Ctrl+C" : nullptr);
    ImGui::Separator();
    if (menuItem("Select all rows")) rows.selectAll();
    if (some && menuItem(fmt::format("Clear selection ({})", selected.size()))) rows.clear();
    ImGui::TextDisabled("Ctrl+click, Shift+click: select rows");
}

bool copyKeyPressed() {
    const ImGuiIO& io = ImGui::GetIO();
    return io.KeyCtrl && !io.KeyShift && !io.KeyAlt && !io.WantTextInput &&
           ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_C), false);
}

// The parts of a table that are needed after its end.
struct TablePlace {
    ImGuiID id;
    ImGuiWindow* inner;
    ImRect outer;  // with the scroll bars
    ImRect body;   // the rows, without the header
    bool isHovered;
    bool scrolls;
};

TablePlace endOfTable() {
    ImGuiTable& table = *ImGui::GetCurrentTable();
    TablePlace place{table.ID,
                     table.InnerWindow,
                     table.OuterRect,
                     table.InnerClipRect,
                     ImGui::IsWindowHovered(),
                     (table.Flags & ImGuiTableFlags_ScrollY) != 0};
    place.body.Min.y = std::max(place.body.Min.y, table.BgClipRect.Min.y);
    ImGui::EndTable();
    if (place.scrolls) return place;
    place.outer = table.OuterRect;  // a table that does not scroll has its height only now
    return place;
}

void showSelection(const TablePlace& place, const TableRows& rows) {
    if (!rows.hasSelection()) return;
    ImDrawList& list = *place.inner->DrawList;
    list.PushClipRect(place.body.Min, place.body.Max);
    for (const DrawnRow& row : drawnTable.rows) {
        if (rows.isSelected(row.row))
            list.AddRectFilled({place.body.Min.x, row.top}, {place.body.Max.x, row.bottom},
                               packed(palette().accent, 0.25f));
    }
    list.PopClipRect();
}

void clickRows(const TablePlace& place, TableRows& rows) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool pressed =
        place.isHovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && place.body.Contains(mouse);
    if (!pressed || (!selectsRows() && ImGui::IsAnyItemHovered())) return;
    const auto row = std::find_if(drawnTable.rows.begin(), drawnTable.rows.end(), [&](const DrawnRow& each) {
        return each.top <= mouse.y && mouse.y < each.bottom;
    });
    if (row != drawnTable.rows.end()) rows.click(row->row);
}

}  // namespace

void beginExports(ExportState& state, Commands& commands) {
    exportFrame.state = &state;
    exportFrame.commands = &commands;
    if (!state.picture) return;
    // The menu closed in the frame before. Without a pointer no plot shows a tooltip or a value.
    ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
    // A plot that is no longer drawn has no picture.
    if (++state.picture->frames > 3) state.picture.reset();
}

void endExports() {
    exportFrame.state = nullptr;
    exportFrame.commands = nullptr;
}

void endTable(const ExportTable& table) {
    if (!exportFrame.state) return ImGui::EndTable();
    const TablePlace place = endOfTable();
    TableRows rows(table, place.id);
    clickRows(place, rows);
    showSelection(place, rows);
    const bool isOver = place.isHovered && ImGui::IsMouseHoveringRect(place.outer.Min, place.outer.Max);
    if (isOver && copyKeyPressed()) copy(table, rows.wanted(), "row");
    const bool rightClicked = isOver && ImGui::IsMouseReleased(ImGuiMouseButton_Right) &&
                              place.body.Contains(ImGui::GetIO().MousePos);
    ImRect area = place.outer;
    if (place.inner->ScrollbarY) area.Max.x -= ImGui::GetStyle().ScrollbarSize;
    // A button would cover a value or a switch of a short list, which is as wide as the panel.
    const std::string buttonName = place.scrolls ? table.name : "";
    menuOver(place.id, area, buttonName, rightClicked, [&] { tableMenu(table, rows); });
}

void exportPlot(const char* id, const ExportTable& samples, bool byRightClick) {
    if (!exportFrame.state) return;
    const ImRect area(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    const ImGuiID plot = ImGui::GetID(id);
    std::optional<WantedPicture>& picture = exportFrame.state->picture;
    if (picture && picture->plot == plot) {
        // A plot that is partly out of sight is scrolled into it first.
        const bool isWhole = ImGui::GetCurrentWindow()->ClipRect.Contains(area);
        if (!isWhole && picture->frames < 3) {
            ImGui::ScrollToRect(ImGui::GetCurrentWindow(), area, ImGuiScrollFlags_KeepVisibleEdgeY);
        } else {
            ImRect seen = area;
            seen.ClipWith(ImGui::GetCurrentWindow()->ClipRect);
            exportFrame.commands->push_back(
                SavePlotPicture{samples.name, {seen.Min.x, seen.Min.y, seen.GetWidth(), seen.GetHeight()}});
            picture.reset();
        }
    }
    const bool isOver = ImGui::IsItemHovered(ImGuiHoveredFlags_RectOnly) && ImGui::IsWindowHovered();
    if (isOver && copyKeyPressed()) copy(samples, allRows(samples), "sample");
    const bool rightClicked = byRightClick && isOver && ImGui::IsMouseReleased(ImGuiMouseButton_Right);
    menuOver(plot, area, samples.name, rightClicked, [&] {
        if (menuItem("Copy samples", "Ctrl+C")) copy(samples, allRows(samples), "sample");
        if (menuItem("Save samples as CSV")) save(samples, "csv", csvOf(samples, allRows(samples)));
        if (menuItem("Save picture as PNG")) picture = WantedPicture{plot, 0};
    });
}

namespace detail {

void beginRows() {
    drawnTable.rows.clear();
    drawnTable.order.reset();
}

void noteOrder(std::vector<std::size_t> rows) {
    drawnTable.order = std::move(rows);
}

void beginRow(std::size_t row) {
    drawnTable.rows.push_back({row, ImGui::GetCurrentTable()->RowPosY1, 0});
    // Selecting a row with Ctrl or Shift must not also press what lies in it.
    ImGui::PushItemFlag(ImGuiItemFlags_Disabled,
                        selectsRows() || (GImGui->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0);
}

void endRow() {
    ImGui::PopItemFlag();
    const ImGuiTable& table = *ImGui::GetCurrentTable();
    drawnTable.rows.back().bottom =
        std::max(table.RowPosY2, table.InnerWindow->DC.CursorMaxPos.y + table.CellPaddingY);
}

}  // namespace detail

}  // namespace worldy::ui
