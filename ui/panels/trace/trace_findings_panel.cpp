#include "ui/panels/trace/trace_findings_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/base/text.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/trace_links.h"

namespace worldy::ui {

namespace {

using planet::TraceFaultKind;
using planet::TraceSwitchCause;

constexpr std::array faultKinds = {TraceFaultKind::DrawnTwice, TraceFaultKind::Hole,
                                   TraceFaultKind::Thrash,     TraceFaultKind::LatePage,
                                   TraceFaultKind::Starvation, TraceFaultKind::LevelStep,
                                   TraceFaultKind::TooCoarse,  TraceFaultKind::TooFine};
constexpr std::array causes = {TraceSwitchCause::Error,   TraceSwitchCause::Settings,
                               TraceSwitchCause::Arrival, TraceSwitchCause::Eviction,
                               TraceSwitchCause::Other,   TraceSwitchCause::Unknown};

const char* meaningOf(TraceSwitchCause cause) {
    constexpr std::array meanings = {
        "Its error crossed the limit because the view moved.",
        "Its error crossed the limit because the limit changed.",
        "Its error exceeded the limit before, and the data of its children came.",
        "The data of its children is gone.",
        "Its error did not ask for it in this frame: a fade, a neighbour, a budget or another rule of the "
        "engine.",
        "The error or the limit is not known."};
    return meanings[static_cast<std::size_t>(cause)];
}

// Shows the frame, the view and the node of a finding.
void goTo(std::uint64_t frame, int shownView, std::uint64_t node, Commands& commands) {
    if (shownView >= 0) commands.push_back(SelectTraceView{shownView});
    commands.push_back(ShowTraceFrame{frame});
    commands.push_back(SelectTraceNode{node});
}

// ---- faults ----

std::string faultItems(const planet::TraceReport& report) {
    std::string items = fmt::format("all ({})", report.faults.size()) + '\0';
    for (const TraceFaultKind kind : faultKinds)
        items += fmt::format("{} ({})", planet::traceFaultName(kind),
                             std::ranges::count(report.faults, kind, &planet::TraceFault::kind)) +
                 '\0';
    return items;
}

void faults(const EditorView& view, TraceFindingsPanelState& state, Commands& commands) {
    const planet::TraceReport& report = view.trace.history->report;
    if (report.faults.empty()) {
        wrappedText(
            view.trace.isReading ? "No fault so far; the trace is still being read." : "No fault was found.",
            palette().good);
        return;
    }
    choiceIndex(
        "Kind", state.fault, 0, faultItems(report).c_str(),
        "drawn_twice: a node and its ancestor are drawn. hole: a visible part of a split node is not drawn. "
        "thrash: a node splits and merges again and again. late_page: data arrives late or never. "
        "starvation: a node is drawn too coarse for long for want of data. level_step: neighbours differ by "
        "more than one level. too_coarse, too_fine: selection ignores its own tolerance.");
    filterBox(state.filter, "faults");
    std::vector<const planet::TraceFault*> rows;
    for (const planet::TraceFault& fault : report.faults) {
        const bool isKind =
            state.fault == 0 || fault.kind == faultKinds[static_cast<std::size_t>(state.fault) - 1];
        if (isKind && (state.filter.empty() ||
                       passes(state.filter.view(), {planet::traceFaultName(fault.kind), fault.sentence,
                                                    traceNodeName(view, fault.node)})))
            rows.push_back(&fault);
    }
    if (rows.empty()) return emptyState("No fault matches the filter.");
    const HitHighlight highlight(state.filter);
    constexpr std::array columns = {
        TableColumn{"Fault", 0.5f, "Kind of the fault.", "drawn_twice"},
        TableColumn{"Frame", 0.4f, "The first frame. A click shows the frame and selects the node.",
                    "123456"},
        TableColumn{"Frames", 0.4f, "In which it was seen.", "12345"},
        TableColumn{"Node", 0.7f, "The node at fault.", "z_pos/12/4095/4095"},
        TableColumn{"What is wrong", 4, "By the engine's own numbers.", nullptr}};
    if (!beginWideTable("faults", columns)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::TraceFault& fault = *rows[row];
        if (column == 0) return std::string(planet::traceFaultName(fault.kind));
        if (column == 1) return static_cast<double>(fault.firstFrame);
        if (column == 2) return static_cast<double>(fault.frames);
        return column == 3 ? traceNodeName(view, fault.node) : fault.sentence;
    };
    tableRows(rows.size(), key, [&](std::size_t row) {
        const planet::TraceFault& fault = *rows[row];
        ImGui::TableNextColumn();
        const bool isShown = view.trace.selected == fault.node && view.trace.frame &&
                             view.trace.frame->frame.number == fault.firstFrame;
        highlightHits(planet::traceFaultName(fault.kind));
        if (ImGui::Selectable(planet::traceFaultName(fault.kind), isShown,
                              ImGuiSelectableFlags_SpanAllColumns))
            goTo(fault.firstFrame, fault.view, fault.node, commands);
        noteItem(fmt::format("Fault {}", row));
        tooltip(inFont(fault.sentence).c_str());
        cell(fmt::format("{}", fault.firstFrame));
        cell(fmt::format("{}", fault.frames));
        cell(traceNodeName(view, fault.node));
        cell(inFont(fault.sentence));
    });
    // The names are those of worldy trace --json.
    using Fault = planet::TraceFault;
    endTable(exportTable<Fault>(
        "trace faults", rows.size(), [&](std::size_t row) { return *rows[row]; },
        {{"kind", [](const Fault& fault) { return planet::traceFaultName(fault.kind); }, true},
         {"first_frame", [](const Fault& fault) { return fault.firstFrame; }, true},
         {"last_frame", [](const Fault& fault) { return fault.lastFrame; }},
         {"frames", [](const Fault& fault) { return fault.frames; }},
         {"node", [&](const Fault& fault) { return traceNodeName(view, fault.node); }, true},
         {"value", [](const Fault& fault) { return fault.value; }},
         {"limit", [](const Fault& fault) { return fault.limit; }},
         {"sentence", [](const Fault& fault) { return fault.sentence; }}}));
}

// ---- switches ----

void switches(const EditorView& view, TraceFindingsPanelState& state, Commands& commands) {
    const TraceHistory& history = *view.trace.history;
    std::vector<const planet::TraceSwitch*> ofView, rows;
    for (const planet::TraceSwitch& one : history.switches)
        if (one.view == view.trace.view) ofView.push_back(&one);
    if (ofView.empty()) {
        wrappedText("No node was split or merged so far.", palette().dim);
        return;
    }
    std::string items = fmt::format("all ({})", ofView.size()) + '\0';
    for (const TraceSwitchCause cause : causes)
        items += fmt::format("{} ({})", planet::traceSwitchCauseName(cause),
                             std::ranges::count(ofView, cause, &planet::TraceSwitch::cause)) +
                 '\0';
    choiceIndex("Cause", state.cause, 0, items.c_str(),
                "error, settings: the node's error crossed the limit because the view or the limit changed. "
                "arrival, eviction: data came or went. other: the numbers did not ask for it in this frame. "
                "unknown: the error or the limit is not known.");
    checkbox("Jumps only", state.jumpsOnly, false,
             "Leaves out the switches of nodes that were morphed into the other level's surface.");
    filterBox(state.filter, "switches");
    for (const planet::TraceSwitch* const one : ofView) {
        const bool isCause =
            state.cause == 0 || one->cause == causes[static_cast<std::size_t>(state.cause) - 1];
        if (!isCause || (state.jumpsOnly && one->isMorphed)) continue;
        if (state.filter.empty() ||
            passes(state.filter.view(), {traceNodeName(view, one->node), one->isSplit ? "split" : "merged",
                                         planet::traceSwitchCauseName(one->cause)}))
            rows.push_back(one);
    }
    if (rows.empty() && !state.filter.empty()) return emptyState("No switch matches the filter.");
    const HitHighlight highlight(state.filter);
    if (history.unlistedSwitches > 0)
        wrappedText(fmt::format("{} later switches are beyond the limit of the list.",
                                countText(static_cast<double>(history.unlistedSwitches))),
                    palette().warning);
    constexpr std::array columns = {
        TableColumn{"Frame", 0.6f, "The first one with the new level. A click shows it and selects the node.",
                    "123456"},
        TableColumn{"Node", 1, "The node that was split or merged.", "z_pos/12/4095/4095"},
        TableColumn{"Switch", 0.6f, "Split into its children, or merged from them.", "merged"},
        TableColumn{"Change", 0.7f,
                    "The node's error on screen. The surface jumps by at most this, if the error is a bound.",
                    "123.45 px"},
        TableColumn{"Limit", 0.6f,
                    "The tolerance for a split; the tolerance times (1 - hysteresis) for a merge.",
                    "12.34 px"},
        TableColumn{"Size", 0.7f, "Diameter of the node's bounds on screen.", "12345 px"},
        TableColumn{"Morphed", 0.6f,
                    "All nodes that take part had the surface of the other level, so that nothing jumps."},
        TableColumn{"Cause", 0.8f, "Why, by the engine's own numbers.", "settings"}};
    if (!beginWideTable("switches", columns)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::TraceSwitch& one = *rows[row];
        switch (column) {
            case 0:
                return static_cast<double>(one.frame);
            case 1:
                return traceNodeName(view, one.node);
            case 2:
                return static_cast<double>(one.isSplit);
            case 3:
                return one.errorPx;
            case 4:
                return one.limitPx;
            case 5:
                return one.sizePx;
            case 6:
                return static_cast<double>(one.isMorphed);
            default:
                return std::string(planet::traceSwitchCauseName(one.cause));
        }
    };
    const auto px = [](double value) {
        if (std::isnan(value)) return std::string("-");
        return std::isinf(value) ? std::string("inside") : pixelsText(value);
    };
    tableRows(rows.size(), key, [&](std::size_t row) {
        const planet::TraceSwitch& one = *rows[row];
        ImGui::TableNextColumn();
        const bool isShown = view.trace.selected == one.node && view.trace.frame &&
                             view.trace.frame->frame.number == one.frame;
        if (ImGui::Selectable(fmt::format("{}", one.frame).c_str(), isShown,
                              ImGuiSelectableFlags_SpanAllColumns))
            goTo(one.frame, one.view, one.node, commands);
        noteItem(fmt::format("Switch {}", row));
        tooltip(meaningOf(one.cause));
        cell(traceNodeName(view, one.node));
        cell(one.isSplit ? "split" : "merged", one.isSplit ? palette().accent : palette().warning);
        cell(px(one.errorPx));
        cell(px(one.limitPx));
        cell(px(one.sizePx));
        cell(one.isMorphed ? "yes" : "no", one.isMorphed ? palette().dim : palette().text);
        cell(planet::traceSwitchCauseName(one.cause));
    });
    using Switch = planet::TraceSwitch;
    endTable(exportTable<Switch>(
        "trace switches", rows.size(), [&](std::size_t row) { return *rows[row]; },
        {{"frame", [](const Switch& one) { return one.frame; }, true},
         {"time_s", [](const Switch& one) { return one.timeS; }},
         {"node", [&](const Switch& one) { return traceNodeName(view, one.node); }, true},
         {"switch", [](const Switch& one) { return one.isSplit ? "split" : "merged"; }},
         {"error_px", [](const Switch& one) { return one.errorPx; }},
         {"limit_px", [](const Switch& one) { return one.limitPx; }},
         {"size_px", [](const Switch& one) { return one.sizePx; }},
         {"morphed", [](const Switch& one) { return one.isMorphed; }},
         {"cause", [](const Switch& one) { return planet::traceSwitchCauseName(one.cause); }}}));
}

// ---- the comparison with another trace ----

void comparedTab(const EditorView& view, TraceComparedState& state, Commands& commands) {
    // A short comparison ends before a frame shows it as running.
    const int runs = view.trace.compared.runs;
    const bool begins = std::exchange(state.runs, runs) != runs && runs > 0;
    const TraceCompared* const result = traceComparedOf(view);
    const std::string label = result ? fmt::format("Compared ({})###compared", result->found.framesThatDiffer)
                                     : std::string("Compared###compared");
    const bool isOpen = ImGui::BeginTabItem(label.c_str(), nullptr,
                                            begins ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None);
    noteItem("Compared");
    if (!isOpen) return;
    traceCompared(view, state, commands);
    ImGui::EndTabItem();
}

}  // namespace

void traceFindingsPanel(const EditorView& view, TraceFindingsPanelState& state, Commands& commands) {
    if (traceEmptyState(view)) return;
    if (!view.trace.history) return emptyState("Reading the trace...");
    if (!ImGui::BeginTabBar("findings")) return;
    const std::size_t count = view.trace.history->report.faults.size();
    if (ImGui::BeginTabItem(fmt::format("Faults ({})###faults", count).c_str())) {
        faults(view, state, commands);
        ImGui::EndTabItem();
    }
    noteItem("Faults");
    if (ImGui::BeginTabItem("Switches###switches")) {
        switches(view, state, commands);
        ImGui::EndTabItem();
    }
    noteItem("Switches");
    comparedTab(view, state.compared, commands);
    ImGui::EndTabBar();
}

}  // namespace worldy::ui
