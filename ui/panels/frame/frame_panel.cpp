#include "ui/panels/frame/frame_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "app/measure/frame_times.h"
#include "ui/kit/columns.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/widgets.h"
#include "ui/model/figures.h"
#include "ui/model/history.h"
#include "ui/panels/frame/allocation_table.h"

namespace worldy::ui {

namespace {

// A part of the frame that is timed.
struct Stage {
    const char* name;
    const char* explanation;
    double (*ms)(const FrameStats&);
};

constexpr std::array<Stage, 7> cpuStages = {
    {{"upload", "Uploading loaded chunks; bounded by the upload limit in the Paging panel.",
      [](const FrameStats& s) { return s.stages.uploadMs; }},
     {"select", "LOD selection; grows with the number of visited nodes.",
      [](const FrameStats& s) { return s.stages.selectMs; }},
     {"paging", "Evicting chunks and requesting new ones.",
      [](const FrameStats& s) { return s.stages.pagingMs; }},
     {"draw", "Issuing the planet's draw calls on the CPU.", [](const FrameStats& s) { return s.drawCpuMs; }},
     {"overlays", "Drawing lines and labels over the planet.",
      [](const FrameStats& s) { return s.overlaysMs; }},
     {"panels", "Building the panels.", [](const FrameStats& s) { return s.panelsMs; }},
     {"present", "Presenting the picture, including the wait for the monitor.",
      [](const FrameStats& s) { return s.presentMs; }}}};

constexpr std::array<Stage, 4> gpuStages = {
    {{"chunks", "Drawing the ground, by a GPU timer query.",
      [](const FrameStats& s) { return s.render.chunksMs; }},
     {"sky", "Drawing the sky and the atmosphere, by a GPU timer query.",
      [](const FrameStats& s) { return s.render.skyMs; }},
     {"shadows", "Drawing the shadow maps, once per cascade, by a GPU timer query.",
      [](const FrameStats& s) { return s.render.shadowsMs; }},
     {"panels", "Drawing the panels, by a GPU timer query.",
      [](const FrameStats& s) { return s.panelsGpuMs; }}}};

void stagePlot(const EditorView& view, const char* id, const char* unit, std::span<const Stage> stages,
               std::span<const float> times, float lines) {
    std::vector<Series> series;
    series.reserve(stages.size());
    for (std::size_t i = 0; i < stages.size(); ++i)
        series.push_back({stages[i].name, seriesColour(i), historyValues(view.frames.history, stages[i].ms)});
    linePlot(id, times, series, unit, 0, lines, true);
}

void pauseControls(const EditorView& view, Commands& commands) {
    bool paused = view.frames.paused;
    if (ImGui::Checkbox("Pause", &paused)) commands.push_back(PauseFrames{paused});
    noteItem("Pause");
    tooltip("Pauses movement, LOD selection and loading; the panels stay active.");
    sameLineForButton("Step");
    beginGrey(!view.frames.paused, "Pause frames first.");
    if (button("Step", "While paused: runs one frame.")) commands.push_back(StepFrame{});
    endGrey();
}

std::vector<ValueRow> timeRows(const EditorView& view) {
    const FrameStats& stats = view.frames.stats;
    const FrameTimes lastTimes = frameTimesOf(
        historyValues<double>(view.frames.history, [](const FrameStats& s) { return s.frameMs; }));
    const double perSecond = stats.frameMs > 0 ? 1000 / stats.frameMs : 0;
    std::vector<ValueRow> rows = {
        {"Frame rate", fmt::format("{:.0f} FPS", perSecond), "Reciprocal of the last frame time."},
        {"Frame", millisecondsText(stats.frameMs),
         "Time from the start of one frame to the next, including the wait for the monitor, but not the rest "
         "while nothing "
         "changes."},
        {"p50, last 10 s", millisecondsText(lastTimes.p50Ms),
         "Half of the frames of the last 10 seconds took at most this. Percentiles are by nearest rank, so "
         "each is "
         "the time of a frame. The Timeline panel tells them of any range."},
        {"p95, last 10 s", millisecondsText(lastTimes.p95Ms),
         "95 % of the frames of the last 10 seconds took at most this."},
        {"p99, last 10 s", millisecondsText(lastTimes.p99Ms),
         "99 % of the frames of the last 10 seconds took at most this."},
        {"Longest, last 10 s", millisecondsText(lastTimes.maxMs),
         "Longest frame of the last 10 seconds. Switching a feature on may take one long frame."}};
    rows.push_back(
        {"Drawn because", view.frames.drawnBecause,
         "Why the last frame was drawn. If nothing changes, the window rests until there is input; "
         "View > Idle when still turns that off."});
    if (view.frames.limit > 0)
        rows.push_back({"Frame limit", fmt::format("{} FPS", view.frames.limit),
                        "Frames wait so that there are no more; View > Frame limit."});
    if (view.frames.fullSpeed)
        rows.push_back(
            {"Full speed", "on",
             "No idling, no frame limit, no wait for the monitor; View > Full speed turns it off."});
    for (const Stage& stage : cpuStages)
        rows.push_back(
            {fmt::format("CPU {}", stage.name), millisecondsText(stage.ms(stats)), stage.explanation});
    for (const Stage& stage : gpuStages)
        rows.push_back(
            {fmt::format("GPU {}", stage.name), millisecondsText(stage.ms(stats)), stage.explanation});
    return rows;
}

// Draws the stages of each frame stacked; time that no stage counts is left out. The results of GPU timer
// queries arrive some frames late, because the CPU does not wait for them.
void plots(const EditorView& view, bool wide) {
    const std::vector<float> sampleTimes = historyTimes(view.frames.history);
    // The other lines are the legends.
    const float lines = wide ? linesThatFit(2, 4, 12) : 4;
    stagePlot(view, "CPU stages", "ms CPU", cpuStages, sampleTimes, lines);
    stagePlot(view, "GPU stages", "ms GPU", gpuStages, sampleTimes, lines);
}

std::vector<ValueRow> countRows(const EditorView& view) {
    const FrameStats& stats = view.frames.stats;
    return {{terms::drawnChunks.name, countText(stats.selection.drawn), terms::drawnChunks.meaning},
            {terms::triangles.name, countText(static_cast<double>(stats.selection.triangles())),
             terms::triangles.meaning},
            {"Triangles, all pictures", countText(static_cast<double>(stats.render.triangles())),
             "Triangles drawn in this frame in all pictures of the planet, the observer's included."},
            {"Uploads", countText(stats.render.uploads), "Chunks uploaded since the previous frame."},
            {"Nodes visited", countText(stats.selection.visited),
             "Quadtree nodes visited by the LOD selection."}};
}

double asBytes(std::size_t bytes) {
    return static_cast<double>(bytes);
}

Bar memoryBar(const char* name, double bytes, std::size_t colour) {
    return {name, bytes, seriesColour(colour), bytesText(bytes)};
}

void memoryByKind(const EditorView& view) {
    const FrameStats& stats = view.frames.stats;
    const double chunksCpu = asBytes(stats.paging.residentBytesCpu);
    const double process = asBytes(stats.processBytes);
    const std::array cpu = {memoryBar("Resident chunks", chunksCpu, 0),
                            memoryBar("Other", std::max(process - chunksCpu, 0.0), 5)};
    ImGui::TextDisabled("CPU: %s", bytesText(process).c_str());
    tooltip("Resident memory of the whole program.");
    barList("CPU memory", cpu, "bytes");
    tooltip("Resident chunks: nodes and heights. Other: the program, its pictures and the driver.");

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
        memoryBar("Render targets", asBytes(stats.targetBytes), 4)};
    ImGui::TextDisabled("GPU: %s", bytesText(asBytes(gpu.total() + stats.targetBytes)).c_str());
    tooltip("Memory the program allocated from the driver.");
    barList("GPU memory", kinds, "bytes");
    tooltip(
        "Heights in use: pool slots with a resident chunk. Heights free: empty pool slots reserved by the "
        "budget. Meshes: grid and instance buffers. Textures: the colour image and similar. Colour tiles and "
        "clipmap: storage of streamed colours. Render targets: textures the program draws into.");
}

// Draws the button that measures features. Features within one draw call cannot be timed separately, so the
// view is drawn with and without each.
void partCosts(const EditorView& view, Commands& commands) {
    const bool measuring = view.instruments.light.measured < 1;
    beginGrey(measuring || !view.planet,
              view.planet ? "The measurement is running." : "Open a planet first.");
    if (button("Measure features",
               "Draws this view with and without each light and surface feature, each twice, five times, and "
               "shows medians. The window is slow meanwhile."))
        commands.emplace_back(MeasureCosts{});
    endGrey();
    if (measuring)
        usageBar(view.instruments.light.measured,
                 fmt::format("{:.0f} %", 100 * view.instruments.light.measured));
}

std::vector<ValueRow> partRows(const Figures& costs) {
    std::vector<ValueRow> rows;
    for (const Figure& cost : costs) rows.push_back({cost.name, cost.value, cost.explanation.c_str()});
    return rows;
}

}  // namespace

void framePanel(const EditorView& view, Commands& commands) {
    const std::vector<ValueRow> times = timeRows(view);
    const Figures costs = costFigures(view.instruments.light.costs);
    const std::vector<ValueRow> parts = partRows(costs);
    const std::vector<ValueRow> counts = countRows(view);
    const auto drawTimes = [&] {
        pauseControls(view, commands);
        valueRows("times", times);
        partCosts(view, commands);
        if (!parts.empty()) valueRows("parts", parts);
    };
    bool wide = false;
    const auto drawCounts = [&] {
        valueRows("counts", counts);
        memoryByKind(view);
        if (section("Allocations"))
            allocationTable(view.instruments.allocations, view.frames.timeS, commands);
    };
    float timesWidth = valuesWidth(times, "99.9 ms");
    if (!parts.empty()) timesWidth = std::max(timesWidth, valuesWidth(parts, "+99.9 ms, 1.23 x"));
    const float countsWidth = std::max(valuesWidth(counts, "99.9 M"), allocationTableWidth());
    const std::array columns = {
        Column{"Times", 0.8f, 0, drawTimes, timesWidth},
        Column{"Last 10 seconds", 1.7f, 0, [&] { plots(view, wide); }, leastPlotWidth()},
        Column{"Counts and memory", 1, 0, drawCounts, countsWidth}};
    wide = hasWideRoom(columns);
    drawColumns("frame", columns);
}

}  // namespace worldy::ui
