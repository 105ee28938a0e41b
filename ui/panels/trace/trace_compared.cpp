#include "ui/panels/trace/trace_compared.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/columns.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/trace/trace_links.h"
#include "ui/panels/trace/what_if_tables.h"

namespace worldy::ui {

namespace {

using planet::TraceFrameDifference;
using planet::TraceReport;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// ---- controls ----

void progressLines(const TraceComparedView& compared, Commands& commands) {
    usageBar(compared.progress, compared.cancelling ? std::string("cancelling")
                                                    : fmt::format("{:.0f} %", 100 * compared.progress));
    beginGrey(compared.cancelling, "Cancelling.");
    if (button("Cancel", "Ends the comparison. The last result stays."))
        commands.push_back(CancelTraceCompare{});
    endGrey();
}

void controls(const EditorView& view, Commands& commands) {
    const TraceComparedView& compared = view.trace.compared;
    if (compared.running) return progressLines(compared, commands);
    traceCompareButton(view, commands);
    if (compared.fileB.empty()) return;
    sameLineForButton("Compare again");
    if (button("Compare again", "Reads both traces again, with what was written to them since."))
        commands.push_back(StartTraceCompare{compared.fileB, compared.match});
    const float width = 10 * ImGui::GetFontSize();
    sameLineIfRoom(width);
    ImGui::SetNextItemWidth(std::min(ImGui::GetContentRegionAvail().x, width));
    int match = static_cast<int>(compared.match);
    const bool isChosen = combo("Match", match, "by time\0by frame number\0");
    tooltip(
        "Which frames of A and B are compared: those with the same time of the engine's clock, or those with "
        "the same number. Another choice compares again.");
    if (isChosen)
        commands.push_back(StartTraceCompare{compared.fileB, static_cast<planet::TraceMatch>(match)});
}

void viewChoice(const EditorView& view, const TraceCompared& result, Commands& commands) {
    const std::vector<planet::TraceViewComparison>& views = result.found.views;
    if (views.size() < 2) return;
    std::string items;
    for (const planet::TraceViewComparison& each : views) items += fmt::format("view {}", each.view) + '\0';
    const auto shown = std::ranges::find(views, view.trace.view, &planet::TraceViewComparison::view);
    int chosen = shown == views.end() ? 0 : static_cast<int>(shown - views.begin());
    if (choiceIndex("View", chosen, 0, items.c_str(), "The view of the engine that the trace panels show."))
        commands.push_back(SelectTraceView{views[static_cast<std::size_t>(chosen)].view});
}

void caption(const TraceCompared& result) {
    const planet::TraceComparison& found = result.found;
    std::string text =
        fmt::format("A {}, B {}: {} frames are in both, {} of these differ; {} only in A, {} only in B",
                    result.request.fileA.filename().string(), result.request.fileB.filename().string(),
                    found.frames, found.framesThatDiffer, found.framesOnlyInA, found.framesOnlyInB);
    if (found.skippedFrames > 0)
        text += fmt::format("; {} that lost events are not compared", found.skippedFrames);
    wrappedText(text + ".", found.framesThatDiffer > 0 ? palette().text : palette().dim);
    tooltip(
        fmt::format("A: {}\nB: {}", result.request.fileA.string(), result.request.fileB.string()).c_str());
    for (const auto& problem : {found.problemA, found.problemB})
        if (problem) wrappedText(*problem, palette().warning);
}

// ---- totals ----

// A quantity of both traces. NaN: not known.
struct ComparedRow {
    std::string name;
    const char* key;  // in exports
    double a = unknown, b = unknown;
    std::string (*text)(double) = nullptr;
    const char* explanation = "";
};

std::string wholeText(double value) {
    return value < 1e4 ? fmt::format("{:.0f}", value) : countText(value);
}
std::string meanText(double value) {
    return value < 1e4 ? fmt::format("{:.1f}", value) : countText(value);
}
std::string secondsText(double value) {
    return millisecondsText(1e3 * value);
}

// Returns a number that is 0 only if the engine told nothing.
double told(double value) {
    return value > 0 ? value : unknown;
}
double told(std::uint64_t value) {
    return told(static_cast<double>(value));
}
double number(std::uint64_t value) {
    return static_cast<double>(value);
}

void addTotals(const planet::TraceViewComparison& view, std::vector<ComparedRow>& rows) {
    const planet::TraceSelectionTotals &a = view.a, &b = view.b;
    constexpr const char* frames = "Over the frames that both have.";
    rows.insert(
        rows.end(),
        {{"Drawn nodes, mean", "mean_drawn", a.meanDrawn, b.meanDrawn, meanText, frames},
         {"Drawn nodes, most", "max_drawn", number(a.mostDrawn), number(b.mostDrawn), wholeText, frames},
         {"Triangles, mean", "mean_triangles", told(a.meanTriangles), told(b.meanTriangles), countText,
          frames},
         {"Triangles, most", "max_triangles", told(a.mostTriangles), told(b.mostTriangles), countText,
          frames},
         {"Bytes, mean", "mean_bytes", told(a.meanBytes), told(b.meanBytes), megabytesText,
          "That the view needs, over the frames that both have; a MB is 10^6 bytes."},
         {"Bytes, most", "max_bytes", told(a.mostBytes), told(b.mostBytes), megabytesText,
          "That the view needs, over the frames that both have; a MB is 10^6 bytes."},
         {"Largest error, mean", "mean_error_px", a.meanErrorPx, b.meanErrorPx, whatIfPxText,
          "Mean over the frames that both have of the largest error on screen of a drawn node."},
         {"Largest error, most", "max_error_px", a.worstErrorPx, b.worstErrorPx, whatIfPxText,
          "The largest error on screen of a drawn node in a frame that both have."},
         {"Splits", "splits", number(a.splits), number(b.splits), wholeText, frames},
         {"Merges", "merges", number(a.merges), number(b.merges), wholeText, frames}});
}

const planet::TraceViewReport* viewOf(const TraceReport& report, int view) {
    const auto found = std::ranges::find(report.views, view, &planet::TraceViewReport::view);
    return found == report.views.end() ? nullptr : &*found;
}

void addReports(const TraceCompared& result, int view, std::vector<ComparedRow>& rows) {
    constexpr const char* whole = "Over each whole trace.";
    const planet::TraceViewReport *const a = viewOf(result.reportA, view), *const b =
                                                                               viewOf(result.reportB, view);
    const auto overTau = [](const planet::TraceViewReport* of) {
        return of && of->tauPx ? number(of->framesOverTau) : unknown;
    };
    rows.push_back({"Thrashes", "thrashes", a ? number(a->thrashes) : unknown,
                    b ? number(b->thrashes) : unknown, wholeText,
                    "Nodes that were split and merged again within 1 s, over each whole trace."});
    rows.push_back({"Frames over tolerance", "frames_over_tau", overTau(a), overTau(b), wholeText,
                    "Frames that draw a node whose error exceeds the tolerance, over each whole trace."});
    rows.push_back({"Faults", "faults", number(result.reportA.faults.size()),
                    number(result.reportB.faults.size()), wholeText, "Of all views, over each whole trace."});
    rows.push_back(
        {"Frames", "frames", number(result.reportA.frames), number(result.reportB.frames), wholeText, whole});
}

void addTimes(const planet::TraceComparison& found, std::vector<ComparedRow>& rows) {
    constexpr const char* of = "Of the frames that both have and whose time was told.";
    rows.insert(rows.end(), {{"CPU time, median", "cpu_ms_median", found.cpuMsA.median, found.cpuMsB.median,
                              millisecondsText, of},
                             {"CPU time, 99 %", "cpu_ms_p99", found.cpuMsA.p99, found.cpuMsB.p99,
                              millisecondsText, "99 % of these frames take at most this."},
                             {"GPU time, median", "gpu_ms_median", found.gpuMsA.median, found.gpuMsB.median,
                              millisecondsText, of},
                             {"GPU time, 99 %", "gpu_ms_p99", found.gpuMsA.p99, found.gpuMsB.p99,
                              millisecondsText, "99 % of these frames take at most this."}});
}

// Adds the paging of the kinds of data that either trace has.
void addPaging(const TraceCompared& result, std::vector<ComparedRow>& rows) {
    const auto find = [](const TraceReport& report, int kind) {
        const auto found = std::ranges::find(report.kinds, kind, &planet::TraceKindReport::kind);
        return found == report.kinds.end() ? planet::TraceKindReport{} : *found;
    };
    std::vector<int> kinds;
    for (const TraceReport* const report : {&result.reportA, &result.reportB})
        for (const planet::TraceKindReport& each : report->kinds) kinds.push_back(each.kind);
    std::ranges::sort(kinds);
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    for (const int kind : kinds) {
        const planet::TraceKindReport a = find(result.reportA, kind), b = find(result.reportB, kind);
        std::string name = a.name.empty() ? b.name : a.name;
        if (name.empty()) name = fmt::format("kind {}", kind);
        constexpr const char* latency = "From request to arrival, over each whole trace.";
        rows.insert(rows.end(), {{name + ", requests", "requested", number(a.requested), number(b.requested),
                                  wholeText, "Over each whole trace."},
                                 {name + ", failed", "failed", number(a.failed), number(b.failed), wholeText,
                                  "Requests that failed, over each whole trace."},
                                 {name + ", latency, median", "latency_s_median", a.latencyS.median,
                                  b.latencyS.median, secondsText, latency},
                                 {name + ", latency, 99 %", "latency_s_p99", a.latencyS.p99, b.latencyS.p99,
                                  secondsText, "99 % of the data that arrived came in at most this."}});
    }
}

std::vector<ComparedRow> comparedRows(const TraceCompared& result, int view) {
    std::vector<ComparedRow> rows;
    const auto found = std::ranges::find(result.found.views, view, &planet::TraceViewComparison::view);
    if (found != result.found.views.end()) addTotals(*found, rows);
    addTimes(result.found, rows);
    addReports(result, view, rows);
    addPaging(result, rows);
    std::erase_if(rows, [](const ComparedRow& row) { return std::isnan(row.a) && std::isnan(row.b); });
    return rows;
}

// Returns the change from A to B as a share of A; NaN if it is not known.
double changeOf(const ComparedRow& row) {
    if (row.a == row.b) return 0;
    return row.a > 0 && std::isfinite(row.a) ? row.b / row.a - 1 : unknown;
}

std::string changeText(const ComparedRow& row) {
    const double change = changeOf(row);
    if (std::isnan(change)) return "-";
    if (change == 0) return "0 %";
    return change < 10 ? fmt::format("{:+.{}f} %", 100 * change, std::abs(change) < 0.1 ? 1 : 0)
                       : fmt::format("{:.0f} times", change + 1);
}

void totals(const EditorView& view, const TraceCompared& result) {
    const std::vector<ComparedRow> rows = comparedRows(result, view.trace.view);
    std::vector<std::string> names;
    for (const ComparedRow& row : rows) names.push_back(row.name);
    const std::string widest = widestText(names);
    const std::array columns = {
        TableColumn{"Quantity", 0.5f, "Of the shown view, unless it says otherwise.", widest.c_str()},
        TableColumn{"A", 0.5f, "The open trace.", "123.4 ms"},
        TableColumn{"B", 0.5f, "The second trace.", "123.4 ms"},
        TableColumn{"Change", 0.5f, "From A to B.", "+12.3 %"}};
    if (!beginWideTable("compared totals", columns, 1)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        if (column == 0) return static_cast<double>(row);
        return column == 1 ? rows[row].a : column == 2 ? rows[row].b : changeOf(rows[row]);
    };
    tableRows(rows.size(), key, [&](std::size_t index) {
        const ComparedRow& row = rows[index];
        const auto text = [&](double value) { return std::isnan(value) ? "-" : row.text(value); };
        cell(row.name);
        tooltip(row.explanation);
        rightCell(text(row.a), palette().text);
        rightCell(text(row.b), palette().text);
        rightCell(changeText(row), row.a == row.b ? palette().dim : palette().text);
    });
    using Row = ComparedRow;
    endTable(exportTable<Row>("trace compared", rows.size(), [rows](std::size_t row) { return rows[row]; },
                              {{"quantity", [](const Row& row) { return row.name; }, true},
                               {"key", [](const Row& row) { return row.key; }},
                               {"a", [](const Row& row) { return row.a; }},
                               {"b", [](const Row& row) { return row.b; }}}));
}

// ---- frames ----

std::uint64_t shownFrame(const EditorView& view) {
    return view.trace.frame ? view.trace.frame->frame.number : view.trace.wanted;
}

std::string pxText(double px) {
    return std::isnan(px) ? std::string("-") : whatIfPxText(px);
}

void frameRow(const EditorView& view, const TraceFrameDifference& each, std::size_t row, Commands& commands) {
    ImGui::TableNextColumn();
    const std::string number = fmt::format("{}", each.frameA);
    highlightHits(number);
    if (ImGui::Selectable(number.c_str(), shownFrame(view) == each.frameA,
                          ImGuiSelectableFlags_SpanAllColumns)) {
        commands.push_back(SelectTraceView{each.view});
        commands.push_back(ShowTraceFrame{each.frameA});
    }
    noteItem(fmt::format("Differing frame {}", row));
    rightCell(fmt::format("{:.3f} s", each.timeS), palette().text);
    rightCell(fmt::format("{}", each.onlyInA), palette().text);
    rightCell(fmt::format("{}", each.onlyInB), palette().text);
    rightCell(fmt::format("{}", each.frameB), each.frameA == each.frameB ? palette().dim : palette().text);
    rightCell(fmt::format("{}", each.drawnA), palette().text);
    rightCell(fmt::format("{}", each.drawnB), palette().text);
    rightCell(pxText(each.worstErrorPxA), palette().text);
    rightCell(pxText(each.worstErrorPxB), palette().text);
}

SortKey keyOf(const TraceFrameDifference& each, std::size_t column) {
    switch (column) {
        case 0:
            return number(each.frameA);
        case 1:
            return each.timeS;
        case 2:
            return number(each.onlyInA);
        case 3:
            return number(each.onlyInB);
        case 4:
            return number(each.frameB);
        case 5:
            return number(each.drawnA);
        case 6:
            return number(each.drawnB);
        case 7:
            return each.worstErrorPxA;
        default:
            return each.worstErrorPxB;
    }
}

void frameTable(const EditorView& view, const std::vector<const TraceFrameDifference*>& rows,
                Commands& commands) {
    constexpr std::array columns = {
        TableColumn{"Frame", 0.5f, "Number in A. A click shows it.", "123456"},
        TableColumn{"Time", 0.5f, "Of A's clock.", "1234.567 s"},
        TableColumn{"Only A", 0.5f, "Nodes that only A draws.", "1234"},
        TableColumn{"Only B", 0.5f, "Nodes that only B draws.", "1234"},
        TableColumn{"In B", 0.5f, "Number in B.", "123456"},
        TableColumn{"Drawn A", 0.5f, "Nodes that A draws.", "12345"},
        TableColumn{"Drawn B", 0.5f, "Nodes that B draws.", "12345"},
        TableColumn{"Error A", 0.5f, "The largest error on screen of a node that A draws.", "> 10000 px"},
        TableColumn{"Error B", 0.5f, "The largest error on screen of a node that B draws.", "> 10000 px"}};
    if (!beginWideTable("differing frames", columns, 1)) return;
    const auto key = [&](std::size_t row, std::size_t column) { return keyOf(*rows[row], column); };
    tableRows(rows.size(), key, [&](std::size_t row) { frameRow(view, *rows[row], row, commands); });
    // The names are those of worldy trace A B --json.
    using Each = TraceFrameDifference;
    endTable(exportTable<Each>("differing frames", rows.size(),
                               [&](std::size_t row) -> const Each& { return *rows[row]; },
                               {{"frame_a", [](const Each& each) { return each.frameA; }, true},
                                {"frame_b", [](const Each& each) { return each.frameB; }},
                                {"time_s", [](const Each& each) { return each.timeS; }},
                                {"view", [](const Each& each) { return each.view; }, true},
                                {"only_in_a", [](const Each& each) { return each.onlyInA; }},
                                {"only_in_b", [](const Each& each) { return each.onlyInB; }},
                                {"drawn_a", [](const Each& each) { return each.drawnA; }},
                                {"drawn_b", [](const Each& each) { return each.drawnB; }},
                                {"triangles_a", [](const Each& each) { return each.trianglesA; }},
                                {"triangles_b", [](const Each& each) { return each.trianglesB; }},
                                {"max_error_px_a", [](const Each& each) { return each.worstErrorPxA; }},
                                {"max_error_px_b", [](const Each& each) { return each.worstErrorPxB; }}}));
}

void frames(const EditorView& view, const TraceCompared& result, TraceComparedState& state,
            Commands& commands) {
    const planet::TraceComparison& found = result.found;
    std::vector<const TraceFrameDifference*> rows;
    std::size_t ofView = 0;
    for (std::size_t i = 0; i < found.differences.size(); ++i) {
        if (found.differences[i].view != view.trace.view) continue;
        ++ofView;
        if (passes(state.filter.view(), {result.texts[i]})) rows.push_back(&found.differences[i]);
    }
    if (found.unlistedDifferences > 0)
        wrappedText(fmt::format("{} later differences are beyond the limit of the list.",
                                countText(number(found.unlistedDifferences))),
                    palette().warning);
    if (ofView == 0)
        return emptyState(found.frames == found.skippedFrames ? "No frame was compared."
                          : found.framesThatDiffer > 0        ? "Both draw the same nodes in this view."
                                                       : "Both draw the same nodes in all compared frames.");
    filterBox(state.filter, "differing frames, by number or node");
    if (rows.empty()) return emptyState("No frame matches the filter.");
    const HitHighlight highlight(state.filter);
    frameTable(view, rows, commands);
}

// ---- nodes of the shown frame ----

void nodeList(const char* name, const std::vector<std::uint64_t>& ids, std::uint64_t count,
              const EditorView& view, Commands& commands) {
    wrappedText(fmt::format("{} draws {}:", name,
                            count == 0   ? std::string("nothing")
                            : count == 1 ? std::string("1 node")
                                         : fmt::format("{} nodes", count)),
                count == 0 ? palette().dim : palette().accent);
    for (const std::uint64_t id : ids) traceNodeLink(id, view, commands);
    if (count > ids.size()) wrappedText(fmt::format("and {} more", count - ids.size()), palette().dim);
}

void nodes(const EditorView& view, const TraceCompared& result, const TraceComparedState& state,
           Commands& commands) {
    const std::uint64_t frame = shownFrame(view);
    const auto found = std::ranges::find_if(result.found.differences, [&](const auto& each) {
        return each.frameA == frame && each.view == view.trace.view;
    });
    if (found == result.found.differences.end()) {
        wrappedText(fmt::format("No difference is listed for frame {}.", frame), palette().dim);
        tooltip("Both traces draw the same nodes in it, or it was not compared.");
        return;
    }
    const HitHighlight highlight(state.filter);
    wrappedText(found->frameA == found->frameB
                    ? fmt::format("Frame {}", frame)
                    : fmt::format("Frame {}, which is {} of B", frame, found->frameB),
                palette().text);
    nodeList("Only A", found->nodesA, found->onlyInA, view, commands);
    nodeList("Only B", found->nodesB, found->onlyInB, view, commands);
}

}  // namespace

void traceCompareButton(const EditorView& view, Commands& commands) {
    beginGrey(view.trace.compared.running, "A comparison is running.");
    if (button(
            "Compare with...",
            "Asks for a second trace of the same flight, such as after a change of the engine, and compares "
            "the two frame by frame in the background. The Trace findings panel shows the result."))
        commands.push_back(AskForFile{FilePurpose::TraceB});
    endGrey();
}

const TraceCompared* traceComparedOf(const EditorView& view) {
    // A result of another trace says nothing about this one.
    const TraceCompared* const result = view.trace.compared.result;
    return result && result->request.fileA == view.trace.file ? result : nullptr;
}

void traceCompared(const EditorView& view, TraceComparedState& state, Commands& commands) {
    const TraceComparedView& compared = view.trace.compared;
    controls(view, commands);
    if (!compared.problem.empty()) wrappedText(compared.problem, palette().warning);
    const TraceCompared* const result = traceComparedOf(view);
    if (!result)
        return emptyState(compared.running
                              ? "Comparing."
                              : "Press \"Compare with...\" and choose a second trace of the same flight.");
    viewChoice(view, *result, commands);
    caption(*result);
    const float font = ImGui::GetFontSize();
    const std::array columns = {
        Column{"Totals", 1.2f, 12, [&] { totals(view, *result); }, 17 * font, 24 * font},
        Column{"Frames that differ", 1.6f, 12, [&] { frames(view, *result, state, commands); }, 18 * font,
               18 * font},
        Column{"Shown frame", 0.8f, 0, [&] { nodes(view, *result, state, commands); }, 9 * font}};
    drawColumns("compared", columns);
}

}  // namespace worldy::ui
