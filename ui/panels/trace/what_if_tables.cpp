#include "ui/panels/trace/what_if_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/text.h"
#include "ui/kit/front_chart.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/trace_links.h"

namespace worldy::ui {

namespace {

constexpr double uselessPx = 1e4;  // only inside a node's bounds or close to it
constexpr std::size_t measuredNames = 100;

bool isBound(const WhatIfEntry& entry) {
    return entry.totals->unknownFrames > 0;
}

// Triangles and the like are lower bounds where selection ends at nodes that the trace does not describe.
std::string atLeast(const WhatIfEntry& entry, const std::string& text) {
    return entry.row && isBound(entry) && text != "-" ? inFont("\u2265 " + text) : text;
}

std::string countOrNone(std::uint64_t count) {
    return count == 0 ? "-" : countText(static_cast<double>(count));
}

struct WhatIfColumn {
    const char* title;
    float share;
    const char* widest;
    const char* explanation;
    std::string (*text)(const WhatIfEntry&);
    double (*value)(const WhatIfEntry&);
};

double numberOf(std::uint64_t count) {
    return static_cast<double>(count);
}

// The columns beside the name. The frame and the node of the largest error are drawn as links.
constexpr std::size_t frameColumn = 4, nodeColumn = 5;
constexpr std::array<WhatIfColumn, 11> whatIfColumns = {{
    {"Drawn", 0.8f, "\u2265 1234.5", "Drawn nodes, mean over the frames.", whatIfDrawnText,
     [](const WhatIfEntry& e) { return e.totals->meanDrawn; }},
    {"Triangles", 0.8f, "\u2265 12.3 k", "Most triangles of a frame, of nodes that told them.",
     whatIfTrianglesText, [](const WhatIfEntry& e) { return numberOf(e.totals->mostTriangles); }},
    {"Bytes", 0.8f, "\u2265 12.3 MB", "Most bytes that the view needs in a frame, of nodes that told them.",
     whatIfBytesText, [](const WhatIfEntry& e) { return numberOf(e.totals->mostBytes); }},
    {"Max error", 0.8f, "\u2264 12.34 px", "Largest error on screen of a drawn node in any frame.",
     whatIfErrorText, [](const WhatIfEntry& e) { return std::fmax(e.totals->worstErrorPx, -1.0); }},
    {"Frame", 0.6f, "100000", "Frame of the largest error. Click: show it.",
     [](const WhatIfEntry& e) { return fmt::format("{}", e.totals->worstFrame); },
     [](const WhatIfEntry& e) { return numberOf(e.totals->worstFrame); }},
    {"Node", 1.0f, nullptr, "Node of the largest error. Click: select it.", nullptr,
     [](const WhatIfEntry& e) { return numberOf(e.totals->worstNode); }},
    {"Switches", 0.6f, "12.3 k", "Splits and merges of all frames.",
     [](const WhatIfEntry& e) { return countOrNone(e.totals->splits + e.totals->merges); },
     [](const WhatIfEntry& e) { return numberOf(e.totals->splits + e.totals->merges); }},
    {"Unknown", 0.6f, "12.3 k",
     "Nodes that are drawn because the trace does not describe their children or does not tell their "
     "errors, summed over the frames. The other values are then bounds.",
     [](const WhatIfEntry& e) { return countOrNone(e.totals->unknown); },
     [](const WhatIfEntry& e) { return numberOf(e.totals->unknown); }},
    {"Waiting", 0.6f, "12.3 k",
     "Nodes that are drawn because their children's data is not there, summed over the frames.",
     [](const WhatIfEntry& e) { return countOrNone(e.totals->waiting); },
     [](const WhatIfEntry& e) { return numberOf(e.totals->waiting); }},
    {"Limited", 0.6f, "12.3 k", "Nodes that are drawn because of the budget, summed over the frames.",
     [](const WhatIfEntry& e) { return countOrNone(e.totals->limited); },
     [](const WhatIfEntry& e) { return numberOf(e.totals->limited); }},
    {"Differ", 0.6f, "12.3 k", "Frames in which other nodes are drawn than the engine drew.",
     [](const WhatIfEntry& e) { return e.row ? countOrNone(e.row->framesThatDiffer) : std::string("-"); },
     [](const WhatIfEntry& e) { return e.row ? numberOf(e.row->framesThatDiffer) : -1.0; }},
}};

std::string totalsTip(const WhatIfEntry& entry) {
    const planet::TraceSelectionTotals& t = *entry.totals;
    std::string tip = fmt::format(
        "{}, {} frames\ndrawn: mean {:.1f}, most {}\ntriangles: mean {}, most {}\nbytes: mean {}, most {}\n"
        "largest error of a frame: mean {}, most {}\nsplits {}, merges {}",
        entry.name, t.frames, t.meanDrawn, t.mostDrawn, countText(t.meanTriangles),
        countText(numberOf(t.mostTriangles)), megabytesText(t.meanBytes),
        megabytesText(numberOf(t.mostBytes)), whatIfPxText(t.meanErrorPx), whatIfPxText(t.worstErrorPx),
        t.splits, t.merges);
    if (const std::string reason = whatIfBoundReason(entry); !reason.empty()) tip += "\n" + reason;
    if (t.worstErrorPx >= uselessPx)
        tip += "\nThe eye is inside the bounds of a node or close to them, where its error has no limit.";
    if (entry.onFront) tip += "\nOn the Pareto front: no other row is both cheaper and more accurate.";
    return tip;
}

void nameCell(const WhatIfEntry& entry, std::size_t index, std::optional<std::size_t>& selected) {
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool isChosen =
        ImGui::Selectable("##row", selected == index,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
    if (isChosen) selected = selected == index ? std::nullopt : std::optional(index);
    noteItem(fmt::format("Row {}", index));
    tooltip([&] { return totalsTip(entry); });
    const float line = ImGui::GetTextLineHeight();
    frontMark({at.x + line * 0.5f, at.y + line * 0.5f}, entry.colour, entry.onFront);
    ImGui::SameLine(line * 1.2f);
    ImGui::TextUnformatted(entry.name.c_str());
}

void entryRow(const WhatIfEntry& entry, std::size_t index, const EditorView& view,
              std::optional<std::size_t>& selected, Commands& commands) {
    nameCell(entry, index, selected);
    const bool hasError = !std::isnan(entry.totals->worstErrorPx);
    for (std::size_t column = 0; column < whatIfColumns.size(); ++column) {
        const bool isLink = column == frameColumn || column == nodeColumn;
        if (!isLink) {
            rightCell(whatIfColumns[column].text(entry), palette().text);
            continue;
        }
        ImGui::TableNextColumn();
        if (!hasError)
            ImGui::TextUnformatted("-");
        else if (column == frameColumn)
            traceFrameLink(entry.totals->worstFrame, view, commands);
        else
            traceNodeLink(entry.totals->worstNode, view, commands);
        if (hasError) noteItem(fmt::format("{} {}", whatIfColumns[column].title, index));
    }
}

// ---- disagreements ----

bool isCoarse(const planet::TraceDisagreement& each) {
    return each.kind == planet::TraceDisagreementKind::TooCoarse;
}

SortKey disagreementKey(const planet::TraceDisagreement& each, std::size_t column) {
    switch (column) {
        case 0:
            return isCoarse(each) ? 0.0 : 1.0;
        case 1:
            return numberOf(each.node);
        case 2:
            return numberOf(each.firstFrame);
        case 3:
            return numberOf(each.frames);
        case 4:
            return each.errorPx;
        case 5:
            return each.limitPx;
        default:
            return each.sentence;
    }
}

void disagreementRow(const planet::TraceDisagreement& each, const EditorView& view, Commands& commands) {
    const ImVec4 colour = each.isFade ? palette().dim : palette().text;
    cell(isCoarse(each) ? "too coarse" : "too fine", each.isFade ? palette().dim : palette().warning);
    tooltip([&] {
        return each.sentence + (each.isFade
                                    ? ".\nThe engine tells fade_s, and this may be a switch that waits "
                                      "for a fade."
                                    : ".");
    });
    ImGui::TableNextColumn();
    traceNodeLink(each.node, view, commands);
    noteItem("Disagreeing node");
    ImGui::TableNextColumn();
    traceFrameLink(each.firstFrame, view, commands);
    noteItem("Disagreeing frame");
    rightCell(fmt::format("{}", each.frames), colour);
    rightCell(whatIfPxText(each.errorPx), colour);
    rightCell(whatIfPxText(each.limitPx), colour);
    cell(each.sentence, colour);
}

// Returns what was found, a sentence or two.
std::string disagreementSummary(const planet::TraceWhatIfReport& report, const planet::TraceWhatIfView& view,
                                std::size_t real, std::size_t fades) {
    if (view.own.totals.frames == 0) return inFont("The engine told no \u03c4, so its choice is not judged.");
    if (planet::whyTraceIsNotJudged(view))
        return "No error of a drawn node is known, so the engine's choice is not judged.";
    std::string text = real == 0
                           ? "The engine's choice is what its own numbers say."
                           : fmt::format("The engine's choice is not what its own numbers say, {} time{}.",
                                         real, real == 1 ? "" : "s");
    if (fades > 0)
        text += fmt::format(" {} switch{} may have waited for fades.", fades, fades == 1 ? "" : "es");
    if (report.unlistedDisagreements > 0)
        text += fmt::format(" {} more are beyond the limit of the list.", report.unlistedDisagreements);
    return text;
}

}  // namespace

std::vector<WhatIfEntry> whatIfEntries(const TraceWhatIfResult& result, std::size_t view,
                                       planet::TraceCost cost) {
    const planet::TraceWhatIfView& report = result.report.views[view];
    const TraceWhatIfSeries& series = result.series[view];
    const TraceWhatIfFronts& fronts = result.fronts[view];
    const std::vector<bool>& front = cost == planet::TraceCost::Bytes ? fronts.bytes : fronts.triangles;
    std::vector<WhatIfEntry> entries;
    entries.push_back({"engine", palette().text, &report.engine, nullptr, &series.engine, false});
    if (report.own.totals.frames > 0)
        entries.push_back(
            {"its settings", palette().dim, &report.own.totals, &report.own, &series.own, false});
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        const planet::TraceWhatIfRow& row = report.rows[i];
        const std::string name = row.settings.tauPx
                                     ? fmt::format("{} {:g} px", tauSymbol(), *row.settings.tauPx)
                                     : fmt::format("{} as told", tauSymbol());
        entries.push_back({name, seriesColour(i), &row.totals, &row, &series.rows[i], front[i]});
    }
    return entries;
}

std::string whatIfPxText(double px) {
    if (std::isnan(px)) return "-";
    if (px >= uselessPx) return fmt::format("> {:.0f} px", uselessPx);
    return px < 10 ? fmt::format("{:.2f} px", px) : fmt::format("{:.{}f} px", px, px < 100 ? 1 : 0);
}

std::string megabytesText(double bytes) {
    if (bytes <= 0) return "-";
    const double megabytes = bytes / 1e6;
    if (megabytes < 0.1) return fmt::format("{:.3g} kB", bytes / 1e3);
    return megabytes < 10 ? fmt::format("{:.2f} MB", megabytes)
                          : fmt::format("{:.{}f} MB", megabytes, megabytes < 100 ? 1 : 0);
}

std::string whatIfDrawnText(const WhatIfEntry& entry) {
    return atLeast(entry, fmt::format("{:.1f}", entry.totals->meanDrawn));
}

std::string whatIfTrianglesText(const WhatIfEntry& entry) {
    return atLeast(entry, countOrNone(entry.totals->mostTriangles));
}

std::string whatIfBytesText(const WhatIfEntry& entry) {
    return atLeast(entry, megabytesText(numberOf(entry.totals->mostBytes)));
}

std::string whatIfErrorText(const WhatIfEntry& entry) {
    const std::string text = whatIfPxText(entry.totals->worstErrorPx);
    if (!isBound(entry) || text == "-" || text.starts_with('>')) return text;
    return inFont((entry.row ? "\u2264 " : "\u2265 ") + text);
}

std::string whatIfBoundReason(const WhatIfEntry& entry) {
    if (!isBound(entry)) return {};
    if (!entry.row)
        return fmt::format(
            "In {} frames the errors of some drawn nodes are not known, so the largest error is at "
            "least this.",
            entry.totals->unknownFrames);
    return fmt::format(
        "In {} frames the trace does not describe the children of some nodes that should be split, or does "
        "not "
        "tell errors. They are drawn themselves, so drawn nodes, triangles and bytes are at least these, and "
        "the "
        "error at most this.",
        entry.totals->unknownFrames);
}

void whatIfTable(std::span<const WhatIfEntry> entries, const EditorView& view,
                 std::optional<std::size_t>& selected, Commands& commands) {
    std::vector<std::string> names, nodes;
    for (const WhatIfEntry& entry : entries) {
        names.push_back(entry.name + "mm");  // with the mark before it
        nodes.push_back(traceNodeName(view, entry.totals->worstNode));
    }
    const std::string widestName = widestText(names), widestNode = widestText(nodes);
    std::vector<TableColumn> columns;
    columns.push_back(
        {"Selection", 0.6f,
         "What the engine drew, what its own settings say, and each tolerance. Ringed: on the Pareto "
         "front of the cost in the plot.",
         widestName.c_str()});
    for (const WhatIfColumn& column : whatIfColumns)
        columns.push_back({column.title, column.share, column.explanation,
                           column.text ? column.widest : widestNode.c_str()});
    if (!beginWideTable("selections", columns, 1)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        return column == 0 ? static_cast<double>(row) : whatIfColumns[column - 1].value(entries[row]);
    };
    tableRows(entries.size(), key,
              [&](std::size_t row) { entryRow(entries[row], row, view, selected, commands); });
    // The names are those of worldy trace --what-if --json.
    using Entry = WhatIfEntry;
    const auto differ = [](const Entry& e) {
        return e.row ? ExportCell(e.row->framesThatDiffer) : ExportCell();
    };
    endTable(exportTable<Entry>(
        "what if", entries.size(), [&](std::size_t row) -> const Entry& { return entries[row]; },
        {{"selection", [](const Entry& e) { return e.name; }, true},
         {"mean_drawn", [](const Entry& e) { return e.totals->meanDrawn; }},
         {"max_triangles", [](const Entry& e) { return e.totals->mostTriangles; }},
         {"max_bytes", [](const Entry& e) { return e.totals->mostBytes; }},
         {"max_error_px", [](const Entry& e) { return e.totals->worstErrorPx; }},
         {"max_error_frame", [](const Entry& e) { return e.totals->worstFrame; }},
         {"max_error_node", [&](const Entry& e) { return traceNodeName(view, e.totals->worstNode); }},
         {"splits", [](const Entry& e) { return e.totals->splits; }},
         {"merges", [](const Entry& e) { return e.totals->merges; }},
         {"unknown_nodes", [](const Entry& e) { return e.totals->unknown; }},
         {"unknown_frames", [](const Entry& e) { return e.totals->unknownFrames; }},
         {"waiting_nodes", [](const Entry& e) { return e.totals->waiting; }},
         {"limited_nodes", [](const Entry& e) { return e.totals->limited; }},
         {"frames_that_differ", differ},
         {"on_front", [](const Entry& e) { return e.onFront; }}}));
}

void disagreementTable(const planet::TraceWhatIfReport& report, std::size_t view, const EditorView& editor,
                       bool& showsFades, Commands& commands) {
    const planet::TraceWhatIfView& shown = report.views[view];
    std::vector<const planet::TraceDisagreement*> listed;
    std::size_t real = 0, fades = 0;
    for (const planet::TraceDisagreement& each : report.disagreements) {
        if (each.view != shown.view) continue;
        ++(each.isFade ? fades : real);
        if (!each.isFade || showsFades) listed.push_back(&each);
    }
    wrappedText(disagreementSummary(report, shown, real, fades),
                real > 0 ? palette().warning : palette().dim);
    if (fades > 0)
        checkbox(
            "Show waits for fades", showsFades, false,
            "Also lists switches that may have waited for a fade. They are not counted as disagreements.");
    if (listed.empty()) return;
    std::ranges::stable_sort(listed, std::greater(), [](const auto* each) { return each->frames; });
    // Of thousands of names some are measured, and of the sentences the longest one.
    std::vector<std::string> nodes;
    for (std::size_t i = 0; i < std::min(listed.size(), measuredNames); ++i)
        nodes.push_back(traceNodeName(editor, listed[i]->node));
    const std::string widestNode = widestText(nodes);
    const auto longest =
        std::ranges::max_element(listed, {}, [](const auto* each) { return each->sentence.size(); });
    const std::array columns = {
        TableColumn{"Kind", 0,
                    "Too coarse: drawn although its error exceeds the limit and its children are there. "
                    "Too fine: split although its error does not exceed the limit.",
                    "too coarse"},
        TableColumn{"Node", 0, "Click: select it.", widestNode.c_str()},
        TableColumn{"From frame", 0, "Click: show it.", "100000"},
        TableColumn{"Frames", 0, "Frames that follow each other in which it was seen.", "10000"},
        TableColumn{"Error", 0, "Of the frame in which it is furthest from the limit.", "> 10000 px"},
        TableColumn{"Limit", 0,
                    "The tolerance, or for nodes that were split before, the tolerance less hysteresis.",
                    "12.34 px"},
        TableColumn{"What is wrong", 1, nullptr, (*longest)->sentence.c_str()}};
    if (!beginWideTable("disagreements", columns, 2)) return;
    const auto key = [&](std::size_t row, std::size_t column) {
        return disagreementKey(*listed[row], column);
    };
    tableRows(listed.size(), key, [&](std::size_t row) { disagreementRow(*listed[row], editor, commands); });
    using Each = planet::TraceDisagreement;
    endTable(exportTable<Each>(
        "disagreements", listed.size(), [&](std::size_t row) { return *listed[row]; },
        {{"kind", [](const Each& each) { return isCoarse(each) ? "too coarse" : "too fine"; }, true},
         {"node", [&](const Each& each) { return traceNodeName(editor, each.node); }, true},
         {"first_frame", [](const Each& each) { return each.firstFrame; }, true},
         {"last_frame", [](const Each& each) { return each.lastFrame; }},
         {"frames", [](const Each& each) { return each.frames; }},
         {"error_px", [](const Each& each) { return each.errorPx; }},
         {"limit_px", [](const Each& each) { return each.limitPx; }},
         {"fade", [](const Each& each) { return each.isFade; }},
         {"sentence", [](const Each& each) { return each.sentence; }}}));
}

}  // namespace worldy::ui
