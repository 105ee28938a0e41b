#include "ui/panels/flight/flight_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr float timelineLines = 3.2f;

// Recording.

void runningRecording(const RecordingNow& recording, Commands& commands) {
    wrappedText(fmt::format("Recording \"{}\"", recording.name), palette().bad);
    ImGui::TextWrapped("%.1f s, %zu frames, %s", recording.seconds, recording.frames,
                       bytesText(recording.bytes).c_str());
    tooltip(
        "Simulated or real seconds, frames, and size before compression. Recording stops after 216,000 "
        "frames or 64 MiB.");
    if (button("Stop and save", "Stops the recording and writes its file."))
        commands.push_back(StopRecording{});
}

void recordControl(FlightPanelState& state, Commands& commands) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::CalcTextSize("Record").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    const float fontPx = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(std::clamp(ImGui::GetContentRegionAvail().x - room, 4 * fontPx, 24 * fontPx));
    ImGui::InputTextWithHint("##name", "Name (optional)", state.name.data(), state.name.size());
    noteItem("Name");
    tooltip("Used as the file name, up to 60 bytes. Empty: the next free \"flight 1\", \"flight 2\", ...");
    ImGui::SameLine();
    if (!button("Record",
                "Records the camera, changed settings, drawn chunks, and requested and loaded blocks for "
                "each frame. All chunks except the six roots are evicted first, so that a replay starts from "
                "the same state; they load again within moments."))
        return;
    commands.push_back(StartRecording{state.name.data()});
    state.name.fill(0);
}

// Selects a recording when it starts, and again if it is saved under another name.
void selectLatest(const RecordingView& recording, FlightPanelState& state) {
    const std::string& latest = recording.recording ? recording.recording->name : recording.saved;
    if (latest == state.latest) return;
    state.latest = latest;
    if (!latest.empty()) state.selected = latest;
}

// The list.

void deletePopup(const RecordedFlight& flight, Commands& commands) {
    if (!ImGui::BeginPopup("delete")) return;
    ImGui::Text("Delete \"%s\" permanently?", flight.name.c_str());
    if (button("Delete", "Deletes the file.")) {
        commands.push_back(DeleteRecording{flight.file});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (button("Cancel", "Keeps the file.")) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void flightRow(const RecordedFlight& flight, FlightPanelState& state, Commands& commands) {
    ImGui::TableNextColumn();
    ImGui::PushID(flight.file.c_str());
    if (ImGui::Selectable(flight.name.c_str(), flight.name == state.selected,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        state.selected = flight.name;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) commands.push_back(StartReplay{flight.file});
    }
    noteItem(flight.name);
    tooltip(fmt::format("{}\nDouble-click to replay it. worldy replay does the same without a window.",
                        flight.file.string())
                .c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", bytesText(flight.bytes).c_str());
    ImGui::PopID();
}

void flightList(const EditorView& view, FlightPanelState& state, Commands& commands) {
    const auto& flights = view.recording.flights;
    if (flights.empty()) {
        wrappedText("No recorded flights. Press Record, fly, then stop and save.", palette().dim);
        return;
    }
    constexpr std::array columns = {TableColumn{"Name", 6}, TableColumn{"Size", 1, nullptr, "12.3 MiB"}};
    if (beginListTable("flights", columns, flights.size(), 7)) {
        const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
            if (column == 0) return flights[row].name;
            return flights[row].bytes;
        };
        tableRows(flights.size(), key, [&](std::size_t row) { flightRow(flights[row], state, commands); });
        endTable(exportTable<RecordedFlight>(
            "recorded flights", flights.size(), [&](std::size_t row) { return flights[row]; },
            {{"name", [](const RecordedFlight& flight) { return flight.name; }, true},
             {"file", [](const RecordedFlight& flight) { return flight.file.string(); }},
             {"size_bytes", [](const RecordedFlight& flight) { return flight.bytes; }}}));
    }
    const auto chosen = std::find_if(flights.begin(), flights.end(),
                                     [&](const RecordedFlight& f) { return f.name == state.selected; });
    beginGrey(chosen == flights.end(), "Select a flight first.");
    if (button("Replay",
               "Replays the flight from the start. Camera and settings come from the recording until you end "
               "the replay."))
        commands.push_back(StartReplay{chosen->file});
    sameLineForButton("Delete...");
    if (button("Delete...", "Deletes the file after confirmation.")) ImGui::OpenPopup("delete");
    endGrey();
    if (chosen != flights.end()) deletePopup(*chosen, commands);
}

// Replaying.

void drawTicks(const ReplayNow& replay, ImVec2 from, ImVec2 size) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    int most = 1;
    for (const FlightTick& tick : replay.ticks) most = std::max({most, tick.splits, tick.merges});
    const float middle = from.y + size.y / 2;
    const auto heightOf = [&](int count) {
        return size.y / 2 * (0.2f + 0.7f * static_cast<float>(count) / static_cast<float>(most));
    };
    for (const FlightTick& tick : replay.ticks) {
        const float x = from.x + size.x * static_cast<float>(tick.timeS / replay.durationS);
        if (tick.splits > 0)
            list.AddLine({x, middle - heightOf(tick.splits)}, {x, middle}, packed(palette().accent));
        if (tick.merges > 0)
            list.AddLine({x, middle}, {x, middle + heightOf(tick.merges)}, packed(palette().warning));
    }
}

std::string ticksText(const ReplayNow& replay, double timeS) {
    const auto nearest = std::min_element(replay.ticks.begin(), replay.ticks.end(),
                                          [&](const FlightTick& a, const FlightTick& b) {
                                              return std::abs(a.timeS - timeS) < std::abs(b.timeS - timeS);
                                          });
    if (nearest == replay.ticks.end()) return "No chunk is split or merged.";
    return fmt::format("Nearest: {} splits and {} merges at {:.2f} s.", nearest->splits, nearest->merges,
                       nearest->timeS);
}

// Returns the time to which keys lead.
std::optional<double> soughtS(const ReplayNow& replay, const PlotKeys& keys) {
    if (keys.toFirst) return 0.0;
    if (keys.toLast) return replay.durationS;
    if (keys.right == 0 && keys.pagesDown == 0) return std::nullopt;
    const double moved = (0.01 * keys.right + 0.1 * keys.pagesDown) * replay.durationS;
    return std::clamp(replay.timeS + moved, 0.0, replay.durationS);
}

// Dragging scrubs. Time runs evenly over its width.
void timeline(const ReplayNow& replay, Commands& commands) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 10.0f),
                      timelineLines * ImGui::GetTextLineHeight()};
    plotItem("timeline", size);
    noteItem("Timeline");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                       ImGui::GetStyle().FrameRounding);
    const double durationS = std::max(replay.durationS, 1e-9);
    drawTicks(replay, from, size);
    const float now = from.x + size.x * static_cast<float>(std::min(replay.timeS / durationS, 1.0));
    list.AddLine({now, from.y}, {now, from.y + size.y}, packed(palette().text),
                 std::max(1.0f, ImGui::GetFontSize() / 8));
    const double share =
        std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - from.x) / size.x), 0.0, 1.0);
    const bool elsewhere = ImGui::IsItemActivated() || ImGui::GetIO().MouseDelta.x != 0;
    const PlotKeys keys = takePlotKeys(PlotReads::Samples);
    const std::optional<double> sought = soughtS(replay, keys);
    if (sought) commands.push_back(MoveReplayTo{*sought});
    if (ImGui::IsItemActive() && elsewhere) commands.push_back(MoveReplayTo{share * durationS});
    tooltip(fmt::format("{:.2f} s. {}\nRecorded splits (up) and merges (down) per frame. Drag to seek; going "
                        "back replays the flight from the start. With the focus: Left, Right seek by a "
                        "hundredth, PageUp, "
                        "PageDown by a tenth, Home, End to the ends.",
                        share * durationS, ticksText(replay, share * durationS))
                .c_str());
    exportPlot("level changes", exportTable<FlightTick>(
                                    "level changes", replay.ticks.size(),
                                    [&](std::size_t row) -> const FlightTick& { return replay.ticks[row]; },
                                    {{"time_s", [](const FlightTick& tick) { return tick.timeS; }, true},
                                     {"splits", [](const FlightTick& tick) { return tick.splits; }},
                                     {"merges", [](const FlightTick& tick) { return tick.merges; }}}));
}

void transport(const ReplayNow& replay, Commands& commands) {
    ReplayControls controls = replay.controls;
    const bool pressed = ImGui::Button(controls.playing ? "Pause###play" : "Play###play");
    noteItem("Play");
    tooltip("Plays or pauses the replay. At its end it starts again.");
    if (pressed) {
        controls.playing = !controls.playing;
        commands.push_back(SetReplay{controls});
    }
    const auto hold = [&] {
        controls.playing = false;
        commands.push_back(SetReplay{controls});
    };
    sameLineForButton("< Step");
    if (button("< Step", "One frame back. Replays the flight from the start up to that frame.")) {
        hold();
        commands.push_back(MoveReplay{std::max<std::size_t>(replay.frame, 2) - 1});
    }
    sameLineForButton("Step >");
    if (button("Step >", "One frame forward.")) {
        hold();
        commands.push_back(MoveReplay{replay.frame + 1});
    }
    sameLineIfRoom(ImGui::CalcTextSize("End replay").x + 2 * ImGui::GetStyle().FramePadding.x);
    if (button("End replay", "Ends the replay and restores the previous camera and settings."))
        commands.push_back(StopReplay{});
}

void eventButtons(const ReplayNow& replay, Commands& commands) {
    const auto go = [&](bool forward) {
        const double timeS = nextTickS(replay.ticks, replay.timeS, forward);
        ReplayControls controls = replay.controls;
        controls.playing = false;
        commands.push_back(SetReplay{controls});
        commands.push_back(MoveReplayTo{timeS});
    };
    const ImGuiStyle& style = ImGui::GetStyle();
    sameLineIfRoom(ImGui::CalcTextSize("< ChangeChange >").x + 4 * style.FramePadding.x +
                   style.ItemSpacing.x);
    beginGrey(replay.ticks.empty(), "The recording has no split and no merge.");
    if (button("< Change", "Goes to the previous frame with a split or merge.")) go(false);
    sameLineForButton("Change >");
    if (button("Change >", "Goes to the next frame with a split or merge.")) go(true);
    endGrey();
}

void replayControls(const ReplayNow& replay, Commands& commands) {
    ReplayControls controls = replay.controls;
    const ReplayControls defaults;
    bool changed = slider(
        "Speed", controls.speed, defaults.speed, 0.1, 10.0, "%.2f x",
        "Playback speed in recorded seconds per second. No frame is skipped; slow frames delay the playback.",
        ImGuiSliderFlags_Logarithmic);
    int arrivals = controls.simulated ? 1 : 0;
    if (choiceIndex(
            "Arrivals", arrivals, 0, "as recorded\0simulated\0",
            "As recorded: each block arrives in its recorded frame. Simulated: blocks arrive according to "
            "the recorded fault-injection settings and seed; exact only for a flight recorded with simulated "
            "paging. A change restarts the replay and seeks to the same frame.")) {
        controls.simulated = arrivals == 1;
        changed = true;
    }
    changed |= checkbox("Loop", controls.loop, defaults.loop, "Starts again at the end.");
    if (changed) commands.push_back(SetReplay{controls});
}

void runningReplay(const ReplayNow& replay, Commands& commands) {
    ImGui::TextWrapped("\"%s\"  frame %zu of %zu, %.2f of %.2f s%s", replay.name.c_str(), replay.frame,
                       replay.frames, replay.timeS, replay.durationS, replay.seeking ? ", seeking" : "");
    wrappedText(replayStatus(replay), replay.framesDifferent > 0 ? palette().bad : palette().good);
    tooltip(
        "Compares each frame with the recording bit by bit: drawn chunks with their order and morph, "
        "requested blocks, and loaded blocks.");
    timeline(replay, commands);
    transport(replay, commands);
    eventButtons(replay, commands);
    replayControls(replay, commands);
}

}  // namespace

std::string replayStatus(const ReplayNow& replay) {
    if (replay.frame == 0) return "No frame replayed yet";
    if (replay.framesDifferent > 0) {
        return fmt::format("{} of {} frames differ from the recording. The first: {}", replay.framesDifferent,
                           replay.frame, replay.difference);
    }
    if (replay.frame == replay.frames)
        return fmt::format("Exact: all {} frames match the recording", replay.frames);
    return fmt::format("Exact so far: {} frames match the recording", replay.frame);
}

double nextTickS(std::span<const FlightTick> ticks, double timeS, bool forward) {
    if (forward) {
        const auto after = std::upper_bound(ticks.begin(), ticks.end(), timeS,
                                            [](double t, const FlightTick& tick) { return t < tick.timeS; });
        return after == ticks.end() ? timeS : after->timeS;
    }
    const auto here = std::lower_bound(ticks.begin(), ticks.end(), timeS,
                                       [](const FlightTick& tick, double t) { return tick.timeS < t; });
    return here == ticks.begin() ? timeS : std::prev(here)->timeS;
}

void flightPanel(const EditorView& view, FlightPanelState& state, ViewSettings& settings,
                 Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to record or replay flights.");
    if (view.recording.replay) {
        runningReplay(*view.recording.replay, commands);
        return;
    }
    selectLatest(view.recording, state);
    if (view.recording.recording) {
        runningRecording(*view.recording.recording, commands);
    } else {
        recordControl(state, commands);
    }
    SettingControls{settings}(settings.paging.simulated);
    if (section("Recorded flights")) flightList(view, state, commands);
}

}  // namespace worldy::ui
