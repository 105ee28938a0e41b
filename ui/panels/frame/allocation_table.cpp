#include "ui/panels/frame/allocation_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/text.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

using Held = Allocations;

constexpr std::array allocationColumns = {
    TableColumn{"Kind", 1.8f, nullptr, "Finished requests"},
    TableColumn{"Now", 1, "Values in the last frame.", "99.9 MiB"},
    TableColumn{"Change", 1, "Now minus Mark. Sort by it to see what grows.", "+99.9 MiB"},
    TableColumn{"Mark", 1, "Values when Mark was pressed.", "99.9 MiB"}};
constexpr std::span<const TableColumn> withoutMark =
    std::span(allocationColumns).first(allocationColumns.size() - 1);

double asNumber(std::size_t value) {
    return static_cast<double>(value);
}

constexpr std::array<AllocationRow, 30> kindRows = {{
    {"Resident",
     "Resident memory of the process reported by the system. It may stay high after a peak, because the "
     "allocator keeps freed memory.",
     [](const Held& h) { return asNumber(h.process.residentBytes); }, true, "Process"},
    {"Heap in use", "Memory allocated and not freed. Watch this value for leaks.",
     [](const Held& h) { return asNumber(h.process.heapBytes); }, true, nullptr},
    {"Open files",
     "File descriptors: files, sockets and pipes. One per chunk file, regardless of the loaders.",
     [](const Held& h) { return asNumber(h.process.openFiles); }, false, nullptr},
    {"Threads", "Threads of loaders, bakes, measurements and the graphics driver.",
     [](const Held& h) { return asNumber(h.process.threads); }, false, nullptr},
    {"Jobs", "Bakes, estimates, previews and measurements running in the background.",
     [](const Held& h) { return asNumber(h.process.jobs); }, false, nullptr},
    {"Heights", "Height pools reserved by the budget, including free slots.",
     [](const Held& h) { return asNumber(h.gpu.heightPool); }, true, "GPU memory"},
    {"Meshes", "Grid and instance buffers.", [](const Held& h) { return asNumber(h.gpu.meshes); }, true,
     nullptr},
    {"Textures", "Colour image, atmosphere tables, layers and similar; without the entries below.",
     [](const Held& h) { return asNumber(h.gpu.textures - h.gpu.colourTiles - h.gpu.colourClipmap); }, true,
     nullptr},
    {"Colour tiles", "Tile pools and their page tables.",
     [](const Held& h) { return asNumber(h.gpu.colourTiles); }, true, nullptr},
    {"Colour clipmap", "Clipmap levels around the camera.",
     [](const Held& h) { return asNumber(h.gpu.colourClipmap); }, true, nullptr},
    {"Shadow maps", "One shadow map per cascade.", [](const Held& h) { return asNumber(h.gpu.shadowMaps); },
     true, nullptr},
    {"Render targets", "Textures the program draws into.",
     [](const Held& h) { return asNumber(h.targetBytes); }, true, nullptr},
    {"Buffers", "GL buffer objects.", [](const Held& h) { return asNumber(h.objects.buffers); }, false,
     "GL objects"},
    {"Textures##objects", "GL texture objects.", [](const Held& h) { return asNumber(h.objects.textures); },
     false, nullptr},
    {"Vertex arrays", "GL vertex array objects.",
     [](const Held& h) { return asNumber(h.objects.vertexArrays); }, false, nullptr},
    {"Framebuffers", "GL framebuffer objects.",
     [](const Held& h) { return asNumber(h.objects.framebuffers); }, false, nullptr},
    {"Renderbuffers", "GL renderbuffer objects.",
     [](const Held& h) { return asNumber(h.objects.renderbuffers); }, false, nullptr},
    {"Queries", "GL query objects, mostly timers.", [](const Held& h) { return asNumber(h.objects.queries); },
     false, nullptr},
    {"Shaders", "GL shader objects; deleted once their programs are linked.",
     [](const Held& h) { return asNumber(h.objects.shaders); }, false, nullptr},
    {"Programs", "GL program objects.", [](const Held& h) { return asNumber(h.objects.programs); }, false,
     nullptr},
    {"Planets", "Open planets: the one shown, the previous bake, and B during a comparison.",
     [](const Held& h) { return asNumber(h.planets.count); }, false, "Planets"},
    {"Chunks", "Resident chunks of all planets.", [](const Held& h) { return asNumber(h.planets.chunks); },
     false, nullptr},
    {"Chunk slots", "Chunk slots reserved by the budgets.",
     [](const Held& h) { return asNumber(h.planets.chunkSlots); }, false, nullptr},
    {"Colour tiles##resident", "Resident colour tiles.",
     [](const Held& h) { return asNumber(h.planets.colourTiles); }, false, nullptr},
    {"Normal tiles", "Resident normal tiles.", [](const Held& h) { return asNumber(h.planets.normalTiles); },
     false, nullptr},
    {"Requests", "Blocks queued or being read.", [](const Held& h) { return asNumber(h.planets.requests); },
     false, nullptr},
    {"Finished requests", "Finished requests kept for the Paging panel, at most 1000 per planet.",
     [](const Held& h) { return asNumber(h.history.rememberedEnds); }, false, "History"},
    {"Log lines", "Lines in the Log panel.", [](const Held& h) { return asNumber(h.history.logLines); },
     false, nullptr},
    {"Frame samples", "Frame samples of the last 10 seconds, for the plots.",
     [](const Held& h) { return asNumber(h.history.frameSamples); }, false, nullptr},
    {"Recording", "Size of the current flight recording; it grows until the recording stops.",
     [](const Held& h) { return asNumber(h.history.recordedBytes); }, true, nullptr},
}};

std::string textOf(const AllocationRow& row, double value) {
    return row.bytes ? bytesText(value) : fmt::format("{:.0f}", value);
}

// Returns the name without the suffix that tells two rows of the same name apart.
std::string shownName(const AllocationRow& row) {
    const std::string name = row.name;
    return name.substr(0, name.find("##"));
}

std::string agoText(double seconds) {
    return seconds < 1 ? "now" : durationText(seconds) + " ago";
}

void drawRow(const AllocationRow& row, const AllocationsView& view, bool withMark) {
    cell(shownName(row), palette().dim);
    const std::string marked = allocationText(row, view.mark);
    tooltip(fmt::format("{} At the mark: {}.", row.explanation, marked).c_str());
    rightCell(allocationText(row, *view.now), palette().text);
    const std::string change = allocationChange(row, view.mark, *view.now);
    rightCell(change, change == "=" ? palette().dim : palette().text);
    if (withMark) rightCell(marked, palette().dim);
}

void drawTable(const AllocationsView& view) {
    const bool withMark = ImGui::GetContentRegionAvail().x >= listTableWidth(allocationColumns);
    const std::span<const TableColumn> shown = withMark ? std::span(allocationColumns) : withoutMark;
    const auto groups = static_cast<std::size_t>(std::count_if(
        kindRows.begin(), kindRows.end(), [](const AllocationRow& row) { return row.group != nullptr; }));
    if (!beginListTable("allocations", shown, kindRows.size() + groups, kindRows.size() + groups + 1)) return;
    const std::optional<TableSort> sort = chosenSort();
    const auto key = [&](std::size_t row, std::size_t column) {
        return allocationSortKey(row, static_cast<AllocationColumn>(column), view);
    };
    // Groups have headings only in the unsorted table, where their rows are together.
    for (const std::size_t i : tableOrder(kindRows.size(), sort, key)) {
        const AllocationRow& row = kindRows[i];
        if (!sort && row.group) {
            ImGui::TableNextRow();
            cell(row.group);
        }
        tableRow(i, [&] { drawRow(row, view, withMark); });
    }
    endTable(allocationExport(view));
}

}  // namespace

SortKey allocationSortKey(std::size_t row, AllocationColumn column, const AllocationsView& view) {
    const AllocationRow& kind = kindRows[row];
    switch (column) {
        case AllocationColumn::Kind:
            return shownName(kind);
        case AllocationColumn::Now:
            return kind.value(*view.now);
        case AllocationColumn::Change:
            return kind.value(*view.now) - kind.value(view.mark);
        case AllocationColumn::Mark:
            break;
    }
    return kind.value(view.mark);
}

std::span<const AllocationRow> allocationRows() {
    return kindRows;
}

std::string allocationText(const AllocationRow& row, const Allocations& held) {
    return textOf(row, row.value(held));
}

std::string allocationChange(const AllocationRow& row, const Allocations& before, const Allocations& now) {
    const double change = row.value(now) - row.value(before);
    if (change == 0) return "=";
    return (change > 0 ? "+" : "-") + textOf(row, std::abs(change));
}

ExportTable allocationExport(const AllocationsView& view) {
    ExportTable table{.name = "allocations",
                      .columns = {{"group"}, {"kind"}, {"unit"}, {"now"}, {"mark"}, {"change"}},
                      .rows = kindRows.size()};
    table.cell = [&](std::size_t row, std::size_t column) -> ExportCell {
        const AllocationRow& kind = kindRows[row];
        const double now = kind.value(*view.now), mark = kind.value(view.mark);
        switch (column) {
            case 0:
                while (!kindRows[row].group) --row;
                return kindRows[row].group;
            case 1:
                return shownName(kind);
            case 2:
                return kind.bytes ? "bytes" : "count";
            case 3:
                return now;
            case 4:
                return mark;
            default:
                return now - mark;
        }
    };
    return table;
}

float allocationTableWidth() {
    return listTableWidth(withoutMark);
}

void allocationTable(const AllocationsView& view, double timeS, Commands& commands) {
    if (!view.now) {
        ImGui::TextDisabled("No planet is open.");
        return;
    }
    if (button("Mark",
               "Stores the current values as the reference for the change column. To find leaks, do "
               "something, undo it, and check that the changes are 0."))
        commands.emplace_back(MarkAllocations{});
    const std::string marked = "marked " + agoText(timeS - view.mark.atS);
    sameLineIfRoom(ImGui::CalcTextSize(marked.c_str()).x);
    ImGui::TextDisabled("%s", marked.c_str());
    tooltip("Time of the mark; initially the time when the first planet was opened.");
    drawTable(view);
}

}  // namespace worldy::ui
