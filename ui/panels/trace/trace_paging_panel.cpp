#include "ui/panels/trace/trace_paging_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/columns.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/trace/trace_links.h"

namespace worldy::ui {

namespace {

std::string kindName(const EditorView& view, std::size_t kind) {
    const auto description = traceDescription(view);
    if (description && !description->kinds[kind].empty()) return description->kinds[kind];
    return fmt::format("kind {}", kind);
}

std::string traceSecondsText(double seconds) {
    return std::isnan(seconds) ? "-" : millisecondsText(1000 * seconds);
}

void queueTable(const EditorView& view, TracePagingPanelState& state, Commands& commands) {
    const TracedFrame& frame = *view.trace.frame;
    wrappedText(fmt::format("{} requests wait or are being loaded", frame.queued), palette().dim);
    if (frame.queue.empty()) return;
    filterBox(state.filter, "requests");
    std::vector<const TracedRequest*> rows;
    for (const TracedRequest& of : frame.queue) {
        if (state.filter.empty() ||
            passes(state.filter.view(), {traceNodeName(view, of.node.id), kindName(view, of.kind),
                                         of.isStarted ? "being loaded" : "requested"}))
            rows.push_back(&of);
    }
    if (rows.empty()) return emptyState("No request matches the filter.");
    const HitHighlight highlight(state.filter);
    constexpr std::array columns = {
        TableColumn{"Node", 1.4f, "The node that was requested.", "z_pos/12/4095/4095"},
        TableColumn{"Kind", 0.8f, "Kind of data, as the engine named it."},
        TableColumn{"State", 0.8f, "Requested, or being loaded.", "being loaded"},
        TableColumn{"Age", 0.7f, "Since the request, by the monotonic clock.", "12.34 s"},
        TableColumn{"Priority", 0.7f, "As the engine told it; larger is more urgent."}};
    if (!beginWideTable("queue", columns)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const TracedRequest& of = *rows[row];
        if (column == 0) return traceNodeName(view, of.node.id);
        if (column == 1) return static_cast<double>(of.kind);
        if (column == 2) return static_cast<double>(of.isStarted);
        return column == 3 ? of.ageS : static_cast<double>(of.priority);
    };
    tableRows(rows.size(), key, [&](std::size_t row) {
        const TracedRequest& of = *rows[row];
        ImGui::TableNextColumn();
        traceNodeLink(of.node.id, view, commands, ImGuiSelectableFlags_SpanAllColumns);
        cell(kindName(view, of.kind));
        cell(of.isStarted ? "being loaded" : "requested", of.isStarted ? palette().accent : palette().text);
        cell(traceSecondsText(of.ageS));
        cell(std::isnan(of.priority) ? "-" : fmt::format("{:.3g}", static_cast<double>(of.priority)));
    });
    using Request = TracedRequest;
    endTable(exportTable<Request>(
        "trace queue", rows.size(), [&](std::size_t row) { return *rows[row]; },
        {{"node", [&](const Request& of) { return traceNodeName(view, of.node.id); }, true},
         {"kind", [&](const Request& of) { return kindName(view, of.kind); }, true},
         {"state", [](const Request& of) { return of.isStarted ? "being loaded" : "requested"; }},
         {"age_s", [](const Request& of) { return of.ageS; }},
         {"priority", [](const Request& of) { return of.priority; }}}));
}

const char* stepText(planet::TraceStep step) {
    constexpr std::array texts = {"requested", "started", "arrived", "cancelled", "failed", "evicted"};
    return texts[static_cast<std::size_t>(step)];
}

// The steps of paging since the frame before.
void stepTable(const EditorView& view, TracePagingPanelState& state, Commands& commands) {
    const TracedFrame& frame = *view.trace.frame;
    wrappedText(fmt::format("{} steps since the frame before", frame.frame.paged.size()), palette().dim);
    if (frame.frame.paged.empty()) return;
    filterBox(state.filter, "steps");
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < frame.frame.paged.size(); ++row) {
        const planet::TracePagedStep& step = frame.frame.paged[row];
        if (state.filter.empty() ||
            passes(state.filter.view(), {traceNodeName(view, frame.pagedIds[row]), stepText(step.event.step),
                                         kindName(view, step.event.kind), frame.reasons[row]}))
            rows.push_back(row);
    }
    if (rows.empty()) return emptyState("No step matches the filter.");
    const HitHighlight highlight(state.filter);
    constexpr std::array columns = {TableColumn{"Node", 1.4f, "The node.", "z_pos/12/4095/4095"},
                                    TableColumn{"Step", 0.8f, "What happened.", "cancelled"},
                                    TableColumn{"Kind", 0.8f, "Kind of data, as the engine named it."},
                                    TableColumn{"Latency", 0.7f, "From the request to this step.", "12.34 s"},
                                    TableColumn{"Thread", 0.8f, "That told it."},
                                    TableColumn{"Reason", 1, "Why it failed."}};
    if (!beginWideTable("steps", columns)) return;
    const auto latencyS = [&](const planet::TracePagedStep& step) {
        if (step.event.step == planet::TraceStep::Requested || step.before.requestedNs == 0)
            return std::numeric_limits<double>::quiet_NaN();
        return static_cast<double>(static_cast<std::int64_t>(step.event.ns - step.before.requestedNs)) * 1e-9;
    };
    const auto thread = [&](const planet::TracePagedStep& step) {
        const auto name = frame.threads.find(step.event.thread);
        return name == frame.threads.end() ? fmt::format("{}", step.event.thread) : name->second;
    };
    tableRows(rows.size(), [&](std::size_t shownRow) {
        const std::size_t row = rows[shownRow];
        const planet::TracePagedStep& step = frame.frame.paged[row];
        ImGui::TableNextColumn();
        traceNodeLink(frame.pagedIds[row], view, commands, ImGuiSelectableFlags_SpanAllColumns);
        const bool hasFailed = step.event.step == planet::TraceStep::Failed;
        cell(stepText(step.event.step), hasFailed ? palette().bad : palette().text);
        cell(kindName(view, step.event.kind));
        cell(traceSecondsText(latencyS(step)));
        cell(thread(step));
        cell(frame.reasons[row], palette().bad);
    });
    const std::vector<planet::TracePagedStep>& steps = frame.frame.paged;
    ExportTable table{.name = "trace steps",
                      .columns = {{"node"}, {"step"}, {"kind"}, {"latency_s"}, {"thread"}, {"reason"}},
                      .rows = rows.size()};
    table.cell = [&](std::size_t shownRow, std::size_t column) -> ExportCell {
        const std::size_t row = rows[shownRow];
        switch (column) {
            case 0:
                return traceNodeName(view, frame.pagedIds[row]);
            case 1:
                return stepText(steps[row].event.step);
            case 2:
                return kindName(view, steps[row].event.kind);
            case 3:
                return latencyS(steps[row]);
            case 4:
                return thread(steps[row]);
            default:
                return frame.reasons[row];
        }
    };
    endTable(table);
}

void kindTable(const EditorView& view) {
    const std::vector<planet::TraceKindReport>& kinds = view.trace.history->report.kinds;
    if (kinds.empty())
        return wrappedText("The engine told no paging, so all data counts as resident.", palette().dim);
    constexpr std::array columns = {
        TableColumn{"Kind", 1, "Kind of data, as the engine named it.", "upsampled mesh"},
        TableColumn{"Requested", 0.7f, "In the whole trace, as far as it is read."},
        TableColumn{"Arrived", 0.7f},
        TableColumn{"Cancelled", 0.7f},
        TableColumn{"Failed", 0.7f},
        TableColumn{"Evicted", 0.7f},
        TableColumn{"Resident", 0.7f, "Nodes whose data is there in the shown frame."},
        TableColumn{"Median", 0.7f, "Median latency, from request to arrival, by the monotonic clock.",
                    "12.3 ms"},
        TableColumn{"99 %", 0.7f, "99 % of the latencies are at most this.", "12.3 ms"}};
    if (!beginListTable("kinds", columns, kinds.size(), 4)) return;
    tableRows(kinds.size(), [&](std::size_t row) {
        const planet::TraceKindReport& of = kinds[row];
        cell(kindName(view, static_cast<std::size_t>(of.kind)));
        for (const std::uint64_t count : {of.requested, of.arrived, of.cancelled})
            cell(countText(static_cast<double>(count)));
        cell(countText(static_cast<double>(of.failed)), of.failed > 0 ? palette().bad : palette().text);
        cell(countText(static_cast<double>(of.evicted)));
        const auto resident = view.trace.frame->resident[static_cast<std::size_t>(of.kind)];
        cell(countText(static_cast<double>(resident)));
        cell(traceSecondsText(of.latencyS.median));
        cell(traceSecondsText(of.latencyS.p99));
    });
    using Kind = planet::TraceKindReport;
    endTable(exportTable<Kind>(
        "trace paging", kinds.size(), [&](std::size_t row) { return kinds[row]; },
        {{"kind", [&](const Kind& of) { return kindName(view, static_cast<std::size_t>(of.kind)); }, true},
         {"requested", [](const Kind& of) { return of.requested; }},
         {"arrived", [](const Kind& of) { return of.arrived; }},
         {"cancelled", [](const Kind& of) { return of.cancelled; }},
         {"failed", [](const Kind& of) { return of.failed; }},
         {"evicted", [](const Kind& of) { return of.evicted; }},
         {"resident",
          [&](const Kind& of) { return view.trace.frame->resident[static_cast<std::size_t>(of.kind)]; }},
         {"median_latency_ms", [](const Kind& of) { return 1000 * of.latencyS.median; }},
         {"p99_latency_ms", [](const Kind& of) { return 1000 * of.latencyS.p99; }}}));
}

void latencies(const EditorView& view, TracePagingPanelState& state) {
    const TraceHistory& history = *view.trace.history;
    const auto& kinds = history.report.kinds;
    if (kinds.size() > 1) {
        std::string items;
        int chosen = 0;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            items += kindName(view, static_cast<std::size_t>(kinds[i].kind)) + '\0';
            if (kinds[i].kind == state.kind) chosen = static_cast<int>(i);
        }
        choiceIndex("Latencies of", chosen, 0, items.c_str(), "Kind of data.");
        // A name with a zero would be two items.
        state.kind = kinds[std::min(static_cast<std::size_t>(chosen), kinds.size() - 1)].kind;
    } else if (kinds.size() == 1) {
        state.kind = kinds[0].kind;
    }
    const auto& counts = history.latencies[static_cast<std::size_t>(state.kind)];
    const bool isAny = std::ranges::any_of(counts, [](float count) { return count > 0; });
    if (!isAny) return wrappedText("No latency is known yet.", palette().dim);
    histogram("trace latencies", counts, "0.1 ms", "100 s", {}, 4, [](double position) {
        return millisecondsText(1000 *
                                logarithmicValue(position, fastestTracedLatencyS, slowestTracedLatencyS));
    });
    tooltip("Requests by the time from request to arrival, on a logarithmic axis.");
}

void starvationTable(const EditorView& view, Commands& commands) {
    const TraceHistory& history = *view.trace.history;
    std::vector<const TracedStarvation*> rows;
    double totalS = 0;
    for (const TracedStarvation& starvation : history.starvations) {
        if (starvation.view != view.trace.view) continue;
        rows.push_back(&starvation);
        totalS += starvation.untilS - starvation.fromS;
    }
    if (rows.empty())
        return wrappedText("This view was always sharp: no node waited for data.", palette().good);
    wrappedText(fmt::format("This view waited for data {} times, {} of {} in all.", rows.size(),
                            durationText(totalS), durationText(history.report.durationS)),
                palette().warning);
    constexpr std::array columns = {
        TableColumn{
            "From", 0.8f,
            "First frame in which a node was drawn coarser than the tolerance because data was missing."},
        TableColumn{"Until sharp", 0.8f, "Time until no node waited for data, by the engine's clock.",
                    "12.34 s"},
        TableColumn{"Nodes", 0.7f, "Most nodes in a frame."},
        TableColumn{"Largest error", 0.8f, "On screen, of these nodes.", "123.4 px"}};
    if (!beginWideTable("starvations", columns)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const TracedStarvation& of = *rows[row];
        if (column == 0) return static_cast<double>(of.firstFrame);
        if (column == 1) return of.untilS - of.fromS;
        return column == 2 ? static_cast<double>(of.mostNodes) : of.worstErrorPx;
    };
    tableRows(rows.size(), key, [&](std::size_t row) {
        const TracedStarvation& of = *rows[row];
        ImGui::TableNextColumn();
        traceFrameLink(of.firstFrame, view, commands);
        cell((of.isOver ? "" : "> ") + traceSecondsText(of.untilS - of.fromS));
        cell(fmt::format("{}", of.mostNodes));
        cell(fmt::format("{:.2f} px", of.worstErrorPx));
    });
    using Starvation = TracedStarvation;
    endTable(
        exportTable<Starvation>("time until sharp", rows.size(), [&](std::size_t row) { return *rows[row]; },
                                {{"first_frame", [](const Starvation& of) { return of.firstFrame; }, true},
                                 {"last_frame", [](const Starvation& of) { return of.lastFrame; }},
                                 {"until_sharp_s", [](const Starvation& of) { return of.untilS - of.fromS; }},
                                 {"over", [](const Starvation& of) { return of.isOver; }},
                                 {"max_nodes", [](const Starvation& of) { return of.mostNodes; }},
                                 {"max_error_px", [](const Starvation& of) { return of.worstErrorPx; }}}));
}

void queueTabs(const EditorView& view, TracePagingPanelState& state, Commands& commands) {
    if (!ImGui::BeginTabBar("queue tabs")) return;
    if (ImGui::BeginTabItem("Queue")) {
        queueTable(view, state, commands);
        ImGui::EndTabItem();
    }
    noteItem("Queue");
    if (ImGui::BeginTabItem("Steps")) {
        stepTable(view, state, commands);
        ImGui::EndTabItem();
    }
    noteItem("Steps");
    ImGui::EndTabBar();
}

}  // namespace

void tracePagingPanel(const EditorView& view, TracePagingPanelState& state, Commands& commands) {
    if (traceEmptyState(view)) return;
    if (!view.trace.history) return emptyState("Reading the trace...");
    const float font = ImGui::GetFontSize();
    const std::array columns = {
        Column{"Queue", 1, 12, [&] { queueTabs(view, state, commands); }, 22 * font},
        Column{"Latencies", 1, 0,
               [&] {
                   kindTable(view);
                   latencies(view, state);
               },
               24 * font},
        Column{"Time until sharp", 1, 12, [&] { starvationTable(view, commands); }, 20 * font}};
    drawColumns("trace paging", columns);
}

}  // namespace worldy::ui
