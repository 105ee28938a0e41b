#include "ui/flight_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/item_map.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

constexpr float timelineLines = 3.2f;

// Recording.

void runningRecording(const RecordingNow& recording, Commands& commands) {
    wrappedText(fmt::format("Recording \"{}\"", recording.name), palette().bad);
    ImGui::TextWrapped("%.1f s, %zu frames, %s", recording.seconds, recording.frames,
                       bytesText(recording.bytes).c_str());
    tooltip(
        "Simulated or real seconds, frames, and bytes before compression. It ends by itself after 216000 "
        "frames or 64 MiB.");
    if (button("Stop and keep", "Ends the recording and writes its file."))
        commands.push_back(StopRecording{});
}

void recordControl(FlightPanelState& state, Commands& commands) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::CalcTextSize("Record").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    const float fontPx = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(std::clamp(ImGui::GetContentRegionAvail().x - room, 4 * fontPx, 24 * fontPx));
    ImGui::InputTextWithHint("##name", "name, or none", state.name.data(), state.name.size());
    noteItem("Name");
    tooltip("A file's name too, up to 60 bytes. Empty: the next free \"flight 1\", \"flight 2\" ...");
    ImGui::SameLine();
    if (!button(
            "Record",
            "Keeps, frame by frame, the camera, changed settings, what is drawn, and which blocks are asked "
            "for and arrive. The planet drops all but its six root chunks first, so that a replay can "
            "begin at the same place; it loads again within moments."))
        return;
    commands.push_back(StartRecording{state.name.data()});
    state.name.fill(0);
}

// The list.

void deletePopup(const RecordedFlight& flight, Commands& commands) {
    if (!ImGui::BeginPopup("delete")) return;
    ImGui::Text("Delete \"%s\" for good?", flight.name.c_str());
    if (button("Delete", "Removes the file.")) {
        commands.push_back(DeleteRecording{flight.file});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (button("Keep", "Leaves it.")) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void flightRow(const RecordedFlight& flight, FlightPanelState& state, Commands& commands) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(flight.file.c_str());
    if (ImGui::Selectable(flight.name.c_str(), flight.name == state.selected,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        state.selected = flight.name;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) commands.push_back(StartReplay{flight.file});
    }
    noteItem(flight.name);
    tooltip(fmt::format("{}\nA double click replays it. worldy replay does the same without a window.",
                        flight.file.string())
                .c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", bytesText(flight.bytes).c_str());
    ImGui::PopID();
}

void flightList(const EditorView& view, FlightPanelState& state, Commands& commands) {
    const auto& flights = view.recording.flights;
    if (flights.empty()) {
        wrappedText("No flight is recorded yet. Press Record, fly, and stop.", palette().dim);
        return;
    }
    const float most = 6 * ImGui::GetTextLineHeightWithSpacing();
    const float wanted = (static_cast<float>(flights.size()) + 0.5f) * ImGui::GetTextLineHeightWithSpacing();
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                  ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersOuter;
    if (ImGui::BeginTable("flights", 2, flags, {0, std::min(most, wanted)})) {
        ImGui::TableSetupColumn("Name", 0, 3);
        ImGui::TableSetupColumn("Size", 0, 1);
        for (const RecordedFlight& flight : flights) flightRow(flight, state, commands);
        ImGui::EndTable();
    }
    const auto chosen = std::find_if(flights.begin(), flights.end(),
                                     [&](const RecordedFlight& f) { return f.name == state.selected; });
    ImGui::BeginDisabled(chosen == flights.end());
    if (button("Replay", "From its beginning. Camera and settings are the recording's until you stop it."))
        commands.push_back(StartReplay{chosen->file});
    ImGui::SameLine();
    if (button("Delete...", "Removes the file, once you have said so again.")) ImGui::OpenPopup("delete");
    ImGui::EndDisabled();
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
    if (nearest == replay.ticks.end()) return "Nothing is split or merged.";
    return fmt::format("Nearest: {} splits and {} merges at {:.2f} s.", nearest->splits, nearest->merges,
                       nearest->timeS);
}

// Dragging scrubs. Time runs evenly over its width.
void timeline(const ReplayNow& replay, Commands& commands) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 10.0f),
                      timelineLines * ImGui::GetTextLineHeight()};
    ImGui::InvisibleButton("timeline", size);
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
    if (ImGui::IsItemActive() && elsewhere) commands.push_back(MoveReplayTo{share * durationS});
    tooltip(fmt::format("{:.2f} s. {}\nUpwards splits, downwards merges, by frame, as recorded. Drag to look "
                        "at any moment; going back makes the flight again from its beginning.",
                        share * durationS, ticksText(replay, share * durationS))
                .c_str());
}

void transport(const ReplayNow& replay, Commands& commands) {
    ReplayControls controls = replay.controls;
    const bool pressed = ImGui::Button(controls.playing ? "Pause###play" : "Play###play");
    noteItem("Play");
    tooltip("Lets the replay go on, or holds it. At its end: from the beginning.");
    if (pressed) {
        controls.playing = !controls.playing;
        commands.push_back(SetReplay{controls});
    }
    const auto hold = [&] {
        controls.playing = false;
        commands.push_back(SetReplay{controls});
    };
    ImGui::SameLine();
    if (button("< Step", "One frame back. Makes the flight again from its beginning up to there.")) {
        hold();
        commands.push_back(MoveReplay{std::max<std::size_t>(replay.frame, 2) - 1});
    }
    ImGui::SameLine();
    if (button("Step >", "One frame on.")) {
        hold();
        commands.push_back(MoveReplay{replay.frame + 1});
    }
    sameLineIfRoom(ImGui::CalcTextSize("End replay").x + 2 * ImGui::GetStyle().FramePadding.x);
    if (button("End replay", "Gives back the camera and the settings of before."))
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
    ImGui::BeginDisabled(replay.ticks.empty());
    if (button("< Change", "Back to the frame of the last split or merge before this one.")) go(false);
    ImGui::SameLine();
    if (button("Change >", "On to the frame of the next split or merge.")) go(true);
    ImGui::EndDisabled();
}

void replayKnobs(const ReplayNow& replay, Commands& commands) {
    ReplayControls controls = replay.controls;
    const ReplayControls defaults;
    bool changed =
        slider("Speed", controls.speed, defaults.speed, 0.1, 10.0, "%.2f x",
               "Recorded seconds a second. What does not fit into the time is made later; no frame "
               "is left out.",
               ImGuiSliderFlags_Logarithmic);
    int arrivals = controls.simulated ? 1 : 0;
    if (choiceIndex(
            "Arrivals", arrivals, 0, "as recorded\0simulated\0",
            "As recorded: each block arrives in the frame in which it did. Simulated: when the recorded "
            "bad disk and seed say; exact only for a flight recorded with simulated paging. A change "
            "begins anew and goes to the same frame.")) {
        controls.simulated = arrivals == 1;
        changed = true;
    }
    changed |= checkbox("Loop", controls.loop, defaults.loop, "Begins anew at its end.");
    if (changed) commands.push_back(SetReplay{controls});
}

void runningReplay(const ReplayNow& replay, Commands& commands) {
    ImGui::TextWrapped("\"%s\"  frame %zu of %zu, %.2f of %.2f s%s", replay.name.c_str(), replay.frame,
                       replay.frames, replay.timeS, replay.durationS, replay.seeking ? ", on its way" : "");
    wrappedText(replayStatus(replay), replay.framesDifferent > 0 ? palette().bad : palette().good);
    tooltip(
        "Compares with the recording in each frame: chunks drawn with their order and morphs to the last "
        "bit, blocks asked for, and blocks that arrived.");
    timeline(replay, commands);
    transport(replay, commands);
    eventButtons(replay, commands);
    replayKnobs(replay, commands);
}

}  // namespace

std::string replayStatus(const ReplayNow& replay) {
    if (replay.frame == 0) return "Nothing is replayed yet";
    if (replay.framesDifferent > 0) {
        return fmt::format("{} of {} frames differ from the recording. The first: {}", replay.framesDifferent,
                           replay.frame, replay.difference);
    }
    if (replay.frame == replay.frames) return fmt::format("Exact: all {} frames as recorded", replay.frames);
    return fmt::format("Exact so far: {} frames as recorded", replay.frame);
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
    if (!view.planet) return emptyState("No planet is open to be flown over.");
    if (view.recording.replay) {
        runningReplay(*view.recording.replay, commands);
        return;
    }
    if (view.recording.recording)
        runningRecording(*view.recording.recording, commands);
    else
        recordControl(state, commands);
    checkbox(
        "Simulated paging", settings.paging.simulated, PagingKnobs().simulated,
        "Reads last as long as the bad disk's settings and seed say, in the time of frames instead of by "
        "the clock. A flight recorded so is the same on any machine. Without a bad disk a read takes no "
        "time.");
    if (section("Recorded flights")) flightList(view, state, commands);
}

}  // namespace ui
