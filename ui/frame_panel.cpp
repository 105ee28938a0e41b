#include "ui/frame_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "ui/allocation_table.h"
#include "ui/columns.h"
#include "ui/history.h"
#include "ui/item_map.h"
#include "ui/plots.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace ui {

namespace {

// A part of the frame that is timed.
struct Stage {
    const char* name;
    const char* explanation;
    double (*ms)(const FrameStats&);
};

constexpr std::array<Stage, 7> cpuStages = {
    {{"upload", "Making loaded chunks drawable; the upload limit of the Paging panel bounds it.",
      [](const FrameStats& s) { return s.stages.uploadMs; }},
     {"select", "Choosing what to draw: grows with the nodes visited.",
      [](const FrameStats& s) { return s.stages.selectMs; }},
     {"paging", "Dropping chunks and asking for new ones.",
      [](const FrameStats& s) { return s.stages.pagingMs; }},
     {"draw", "Making the planet's draw calls, on the CPU.", [](const FrameStats& s) { return s.drawCpuMs; }},
     {"overlays", "Lines and labels over the planet.", [](const FrameStats& s) { return s.overlaysMs; }},
     {"panels", "Making the panels.", [](const FrameStats& s) { return s.panelsMs; }},
     {"present", "Handing the picture to the monitor; waiting for it is counted in.",
      [](const FrameStats& s) { return s.presentMs; }}}};

constexpr std::array<Stage, 4> gpuStages = {
    {{"chunks", "The planet's ground, by a timer query.",
      [](const FrameStats& s) { return s.render.chunksMs; }},
     {"sky", "The sky and its air, by a timer query.", [](const FrameStats& s) { return s.render.skyMs; }},
     {"shadows", "The ground as the sun sees it, once a cascade, by a timer query.",
      [](const FrameStats& s) { return s.render.shadowsMs; }},
     {"panels", "The panels, by a timer query.", [](const FrameStats& s) { return s.panelsGpuMs; }}}};

void stagePlot(const EditorView& view, const char* id, const char* unit, std::span<const Stage> stages,
               std::span<const float> times, float lines) {
    std::vector<Series> series;
    series.reserve(stages.size());
    for (std::size_t i = 0; i < stages.size(); ++i)
        series.push_back({stages[i].name, seriesColour(i), historyValues(view.history, stages[i].ms)});
    linePlot(id, times, series, unit, 0, lines, true);
}

void pauseControls(const EditorView& view, Commands& commands) {
    bool paused = view.framesPaused;
    if (ImGui::Checkbox("Pause", &paused)) commands.push_back(PauseFrames{paused});
    noteItem("Pause");
    tooltip("Nothing moves, is chosen or loaded any more; the panels go on.");
    ImGui::SameLine();
    ImGui::BeginDisabled(!view.framesPaused);
    if (button("Step", "While paused: one frame, as if none had been missed."))
        commands.push_back(StepFrame{});
    ImGui::EndDisabled();
}

void times(const EditorView& view, Commands& commands) {
    pauseControls(view, commands);
    const FrameStats& stats = view.stats;
    if (!beginValues("times")) return;
    const double perSecond = stats.frameMs > 0 ? 1000 / stats.frameMs : 0;
    valueRow("Frame rate", fmt::format("{:.0f}/s", perSecond),
             "As many as the last would fit into a second.");
    valueRow("Frame", millisecondsText(stats.frameMs),
             "From one frame's start to the next one's, waiting for the monitor included.");
    for (const Stage& stage : cpuStages)
        valueRow(fmt::format("CPU {}", stage.name).c_str(), millisecondsText(stage.ms(stats)),
                 stage.explanation);
    for (const Stage& stage : gpuStages)
        valueRow(fmt::format("GPU {}", stage.name).c_str(), millisecondsText(stage.ms(stats)),
                 stage.explanation);
    endValues();
}

// Of each frame, one stage on the other; times that no stage counts are left out. Timer queries answer some
// frames late, since the CPU does not wait for them.
void plots(const EditorView& view, bool wide) {
    const std::vector<float> sampleTimes = historyTimes(view.history);
    // The others: the legends.
    const float lines = wide ? linesThatFit(2, 4, 12) : 4;
    stagePlot(view, "cpu", "ms CPU", cpuStages, sampleTimes, lines);
    stagePlot(view, "gpu", "ms GPU", gpuStages, sampleTimes, lines);
}

void counts(const EditorView& view) {
    const FrameStats& stats = view.stats;
    if (!beginValues("counts")) return;
    valueRow("Chunks drawn", countText(stats.render.chunks), "Instances of the one instanced draw.");
    valueRow("Triangles", countText(static_cast<double>(stats.render.triangles)), "Skirts included.");
    valueRow("Uploads", countText(stats.render.uploads), "Chunks uploaded since the frame before.");
    valueRow("Nodes visited", countText(stats.selection.visited), "By selection.");
    endValues();
}

double asBytes(std::size_t bytes) {
    return static_cast<double>(bytes);
}

Bar memoryBar(const char* name, double bytes, std::size_t colour) {
    return {name, bytes, seriesColour(colour), bytesText(bytes)};
}

void memoryByKind(const EditorView& view) {
    const FrameStats& stats = view.stats;
    const double chunksCpu = asBytes(stats.paging.residentBytesCpu);
    const double process = asBytes(stats.processBytes);
    const std::array cpu = {memoryBar("Resident chunks", chunksCpu, 0),
                            memoryBar("All else", std::max(process - chunksCpu, 0.0), 5)};
    ImGui::TextDisabled("CPU: %s", bytesText(process).c_str());
    tooltip("The whole program's resident memory.");
    barList("cpu", cpu);
    tooltip("Resident chunks: nodes and heights. All else: the program, its pictures, the driver.");

    const planet::gl::GpuMemory& gpu = stats.gpuMemory;
    const double heightsUsed = asBytes(stats.paging.residentBytesGpu);
    const std::array kinds = {
        memoryBar("Heights in use", heightsUsed, 0),
        memoryBar("Heights free", std::max(asBytes(gpu.heightPool) - heightsUsed, 0.0), 7),
        memoryBar("Meshes", asBytes(gpu.meshes), 2),
        memoryBar("Textures", asBytes(gpu.textures - gpu.colourTiles - gpu.colourClipmap), 1),
        memoryBar("Colour tiles", asBytes(gpu.colourTiles), 3),
        memoryBar("Colour clipmap", asBytes(gpu.colourClipmap), 6),
        memoryBar("Shadow maps", asBytes(gpu.shadowMaps), 5),
        memoryBar("Pictures", asBytes(stats.targetBytes), 4)};
    ImGui::TextDisabled("GPU: %s", bytesText(asBytes(gpu.total() + stats.targetBytes)).c_str());
    tooltip("What the program asked the driver for.");
    barList("gpu", kinds);
    tooltip(
        "Heights in use: slots of the pool that hold a resident chunk. Heights free: slots that the budget "
        "pays for, but nothing fills. Meshes: the grid and the instances. Textures: the colour image and its "
        "like. Colour tiles and clipmap: what streamed colours are drawn from. Pictures: what is drawn "
        "into.");
}

// Stages that one draw call does together cannot be timed in it: they are drawn with and without.
void partCosts(const EditorView& view, Commands& commands) {
    const bool measuring = view.light.measured < 1;
    ImGui::BeginDisabled(measuring || !view.planet);
    if (button(
            "Measure parts",
            "Draws this view with each part of light and surface and without it, in turn, each twice, five "
            "times, and takes medians. The window is slow for as long."))
        commands.emplace_back(MeasureCosts{});
    ImGui::EndDisabled();
    if (measuring) usageBar(view.light.measured, fmt::format("{:.0f} %", 100 * view.light.measured));
    if (view.light.costs.empty()) return;
    if (!beginValues("parts")) return;
    for (const PartCost& cost : view.light.costs)
        valueRow(cost.part.c_str(),
                 fmt::format("{:+.1f} ms, x {:.2f}", cost.withMs - cost.withoutMs,
                             cost.withMs / std::max(cost.withoutMs, 1e-6)),
                 "What the picture takes longer than nothing but the lit ground, which is 1.");
    endValues();
}

}  // namespace

void framePanel(const EditorView& view, ViewSettings&, Commands& commands) {
    const bool wide = hasWideRoom();
    const std::array columns = {Column{"Times", 0.8f, 0,
                                       [&] {
                                           times(view, commands);
                                           partCosts(view, commands);
                                       }},
                                Column{"Last 10 seconds", 1.7f, 0, [&] { plots(view, wide); }},
                                Column{"Counts and memory", 1, 0, [&] {
                                           counts(view);
                                           memoryByKind(view);
                                           if (section("Allocations"))
                                               allocationTable(view.allocations, view.timeS, commands);
                                       }}};
    drawColumns("frame", columns);
}

}  // namespace ui
