#include "ui/panels/trace/trace_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/text.h"
#include "ui/kit/columns.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/trace/trace_compared.h"
#include "ui/panels/trace/trace_links.h"

namespace worldy::ui {

namespace {

constexpr int leastPort = 1;
constexpr int mostPort = 65535;

// ---- where it comes from ----

void attachControls(const TraceLinkView& link, TracePanelState& state, Commands& commands) {
    const float font = ImGui::GetFontSize();
    if (link.isOn) {
        if (button("Detach", "Leaves the engine. What has arrived stays open and is kept as a file."))
            commands.push_back(DetachTrace{});
    } else if (button("Attach",
                      "Waits for an engine on this machine that traces itself to \"tcp:127.0.0.1:PORT\", and "
                      "shows it live. Each connection is kept as a file.")) {
        commands.push_back(AttachTrace{state.port});
    }
    ImGui::SameLine();
    beginGrey(link.isOn, "Detach first.");
    ImGui::SetNextItemWidth(4.5f * font);
    if (ImGui::InputInt("##port", &state.port, 0)) state.port = std::clamp(state.port, leastPort, mostPort);
    noteItem("Port");
    tooltip("The port at which the engine listens, [1, 65535].");
    endGrey();
}

void sourceRow(const EditorView& view, TracePanelState& state, Commands& commands) {
    if (button("Open...", "Opens a trace file. Dropping one onto the window does the same."))
        commands.push_back(AskForFile{});
    sameLineForButton("Attach");
    attachControls(view.trace.link, state, commands);
    if (view.trace.file.empty()) return;
    sameLineForButton("Close");
    if (button("Close", "Closes the trace.")) commands.push_back(CloseTrace{});
    sameLineForButton("Compare with...");
    traceCompareButton(view, commands);
}

void messages(const EditorView& view) {
    const TraceView& trace = view.trace;
    if (trace.link.isOn)
        wrappedText(trace.link.message, trace.link.isReceiving ? palette().good : palette().warning);
    if (!trace.problem.empty()) wrappedText(trace.problem, palette().bad);
    const bool isDropped = trace.history && trace.history->report.droppedEvents > 0;
    if (isDropped)
        wrappedText(fmt::format("The engine dropped {} events. Frames that lost some are not judged.",
                                countText(static_cast<double>(trace.history->report.droppedEvents))),
                    palette().warning);
}

std::string nameOfTrace(const EditorView& view) {
    const auto description = traceDescription(view);
    const std::string engine =
        description && !description->name.empty() ? description->name : "unnamed engine";
    return fmt::format("{} ({})", engine, view.trace.file.filename().string());
}

void facts(const EditorView& view) {
    const TraceView& trace = view.trace;
    wrappedText(nameOfTrace(view), palette().text);
    tooltip(trace.file.string().c_str());
    if (!trace.history) return;
    const planet::TraceReport& report = trace.history->report;
    wrappedText(fmt::format("{} frames, {}, {} nodes{}", countText(static_cast<double>(report.frames)),
                            durationText(report.durationS), countText(static_cast<double>(report.nodes)),
                            trace.isReading ? ", reading..." : ""),
                palette().dim);
}

void viewChoice(const EditorView& view, Commands& commands) {
    if (!view.trace.history || view.trace.history->views.size() < 2) return;
    std::string items;
    int chosen = 0, place = 0;
    std::vector<int> views;
    for (const auto& [number, samples] : view.trace.history->views) {
        items += fmt::format("view {}", number) + '\0';
        if (number == view.trace.view) chosen = place;
        views.push_back(number);
        ++place;
    }
    if (choiceIndex("View", chosen, 0, items.c_str(), "The view of the engine that the trace panels show."))
        commands.push_back(SelectTraceView{views[static_cast<std::size_t>(chosen)]});
}

void counterChoice(const EditorView& view, TraceTimelineState& timeline) {
    if (!view.trace.history || view.trace.history->counters.empty()) return;
    std::string items = std::string("none") + '\0';
    std::vector<std::string> names{""};
    int chosen = 0;
    for (const auto& [name, values] : view.trace.history->counters) {
        if (name == timeline.counter) chosen = static_cast<int>(names.size());
        names.push_back(name);
        items += name + '\0';
    }
    const bool isChosen =
        choiceIndex("Counter", chosen, 0, items.c_str(), "A counter of the engine, as a strip of its own.");
    // A name with a zero would be two items.
    if (isChosen && static_cast<std::size_t>(chosen) < names.size())
        timeline.counter = names[static_cast<std::size_t>(chosen)];
}

// ---- frames ----

void transport(const EditorView& view, TracePanelState& state, Commands& commands) {
    const TraceView& trace = view.trace;
    const PlayTrace now{trace.playing, trace.speed, trace.newest};
    const auto send = [&](auto change) {
        PlayTrace next = now;
        change(next);
        commands.push_back(next);
    };
    if (button("First", "Shows the first frame.")) commands.push_back(ShowTraceFrame{0});
    sameLineForButton("Back");
    if (button("Back", "Shows the frame before.")) commands.push_back(StepTrace{-1});
    sameLineForButton("Pause");
    beginGrey(trace.newest, "The newest frame of a running engine is shown.");
    const bool pressed = ImGui::Button(trace.playing ? "Pause###play" : "Play###play");
    noteItem("Play");
    tooltip("Plays or stops at the speed of the engine's clock.");
    if (pressed) send([&](PlayTrace& next) { next.playing = !trace.playing; });
    endGrey();
    sameLineForButton("Next");
    if (button("Next", "Shows the next frame.")) commands.push_back(StepTrace{1});
    sameLineForButton("Last");
    if (button("Last", "Shows the last frame.") && trace.history)
        commands.push_back(ShowTraceFrame{trace.history->report.lastFrame});
    constexpr std::array speeds = {0.1, 0.25, 0.5, 1.0, 2.0, 4.0};
    int speed = static_cast<int>(std::ranges::find(speeds, trace.speed) - speeds.begin());
    if (choiceIndex("Speed", speed, 3,
                    "0.1\0"
                    "0.25\0"
                    "0.5\0"
                    "1\0"
                    "2\0"
                    "4\0",
                    "Relative to the engine's clock."))
        send([&](PlayTrace& next) { next.speed = speeds[static_cast<std::size_t>(speed)]; });
    if (trace.link.isReceiving) {
        bool newest = trace.newest;
        if (checkbox("Newest", newest, true, "Shows each frame as it arrives."))
            send([&](PlayTrace& next) { next.newest = newest; });
    }
    if (trace.hasPlace) {
        bool onPlanet = trace.onPlanet;
        if (checkbox(
                "On the planet", onPlanet, true,
                "Draws the bounds of the drawn nodes and the camera's frustum over the open planet, scaled "
                "to its radius, in the colours of the Overlay panel's tint by level, error or morph."))
            commands.push_back(ShowTraceOnPlanet{onPlanet});
        sameLineForButton("Look as engine");
        if (button("Look as engine", "Moves the camera to that of the traced view."))
            commands.push_back(LookAsTrace{});
    }
    viewChoice(view, commands);
    counterChoice(view, state.timeline);
}

void frameRows(const EditorView& view) {
    if (!view.trace.frame || !beginValues("frame")) return;
    const TracedFrame& frame = *view.trace.frame;
    const auto ms = [](double value) {
        return value < 0 ? std::string("not told") : millisecondsText(value);
    };
    valueRow("Frame", fmt::format("{}", frame.frame.number), "Number of the shown frame, from 1.");
    valueRow("Time", fmt::format("{:.3f} s", frame.frame.timeS), "The engine's clock.");
    valueRow("CPU", ms(frame.frame.cpuMs), "As the engine told it.");
    valueRow("GPU", ms(frame.frame.gpuMs), "As the engine told it.");
    if (const TracedView* const shown = shownTraceView(view)) {
        valueRow("Drawn nodes", fmt::format("{}", shown->drawn), "Nodes that are drawn twice count once.");
        valueRow("Triangles",
                 shown->triangles == 0 ? "not told" : countText(static_cast<double>(shown->triangles)),
                 "Of drawn nodes that told them.");
        const bool isOver = shown->worstErrorPx > shown->tauPx;
        valueRow("Largest error",
                 std::isnan(shown->worstErrorPx) ? "unknown" : fmt::format("{:.3f} px", shown->worstErrorPx),
                 "Of the drawn nodes, on screen.", isOver ? &palette().bad : nullptr);
        valueRow("Tolerance", std::isnan(shown->tauPx) ? "not told" : fmt::format("{:g} px", shown->tauPx),
                 "The engine's setting \"tau\".");
        valueRow("Over tolerance", fmt::format("{}", shown->overTau),
                 "Drawn nodes whose error exceeds the tolerance.");
        valueRow("Waiting for data", fmt::format("{}", shown->starved),
                 "Of these, nodes whose children's data is missing.",
                 shown->starved > 0 ? &palette().warning : nullptr);
    }
    if (!frame.frame.isComplete())
        valueRow("Lost events", fmt::format("{}", frame.frame.dropped), "The frame is not complete.",
                 &palette().bad);
    endValues();
}

std::string textOf(const planet::TraceSettingValue& value) {
    if (const double* const number = std::get_if<double>(&value)) return fmt::format("{:g}", *number);
    return std::get<std::string>(value);
}

void settingRows(const EditorView& view) {
    if (!view.trace.frame) return;
    const TracedFrame& frame = *view.trace.frame;
    if (!frame.counters.empty() && section("Counters")) {
        std::vector<ValueRow> rows;
        for (const auto& [name, value] : frame.counters)
            rows.push_back({name, fmt::format("{:g}", value), "A counter of the engine."});
        valueRows("counters", rows);
    }
    if (!frame.settings.empty() && section("Settings")) {
        std::vector<ValueRow> rows;
        for (const auto& [name, value] : frame.settings)
            rows.push_back({name, textOf(value), "A setting of the engine."});
        valueRows("settings", rows);
    }
    for (const planet::TraceMessage& message : frame.frame.messages)
        wrappedText(message.text, message.severity == planet::TraceSeverity::Failure   ? palette().bad
                                  : message.severity == planet::TraceSeverity::Warning ? palette().warning
                                                                                       : palette().dim);
}

}  // namespace

void tracePanel(const EditorView& view, TracePanelState& state, Commands& commands) {
    sourceRow(view, state, commands);
    messages(view);
    if (view.trace.file.empty()) {
        if (!view.trace.link.isOn)
            wrappedText(
                "A trace tells frame by frame what an engine's level of detail did. Engines write one with "
                "the C header planet/trace/lod_trace.h; Worldy writes one with \"worldy fly --trace\".",
                palette().dim);
        return;
    }
    const float font = ImGui::GetFontSize();
    const std::array columns = {
        Column{"Trace", 1, 0,
               [&] {
                   facts(view);
                   transport(view, state, commands);
               },
               16 * font},
        Column{"Timeline", 4, 18, [&] { traceTimeline(view, state.timeline, commands); }, 18 * font},
        Column{"Frame", 1, 0,
               [&] {
                   frameRows(view);
                   settingRows(view);
               },
               13 * font}};
    drawColumns("trace", columns);
}

}  // namespace worldy::ui
