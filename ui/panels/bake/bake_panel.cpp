#include "ui/panels/bake/bake_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr double estimateAfterS = 0.5;  // since the last edit
constexpr int smallestFaceLog2 = 4;
constexpr int largestFaceLog2 = 16;

bool sameFile(const BakeRequest& a, const BakeRequest& b) {
    return a.source == b.source && a.settings.faceSize == b.settings.faceSize &&
           a.settings.chunkSize == b.settings.chunkSize && a.settings.radiusM == b.settings.radiusM &&
           a.settings.quantumM == b.settings.quantumM &&
           a.settings.finestQuantumM == b.settings.finestQuantumM &&
           a.settings.compressionLevel == b.settings.compressionLevel && a.colour == b.colour &&
           (a.colour.empty() || a.settings.colour == b.settings.colour);
}

// Resets the edited settings when another file is open than the one they were made for.
void followOpenFile(const EditorView& view, BakePanelState& state) {
    if (state.editedOf == view.data.chunkFile) return;
    state.editedOf = view.data.chunkFile;
    state.edited.reset();
    state.estimateAtS.reset();
    setSource(view.bake.current.source, state.source);
    setColour(view.bake.current, state.colour);
}

void edited(const BakeRequest& request, double timeS, BakePanelState& state) {
    state.edited = request;
    state.estimateAtS = timeS + estimateAfterS;
}

struct Parameter {
    const char* name;
    std::string value;
    bool live;  // set in another panel; otherwise stored in the file
    std::string explanation;
};
using Parameters = std::vector<Parameter>;

void parameterRow(const Parameter& row) {
    cell(row.name, palette().dim);
    tooltip(row.explanation.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(row.value.c_str());
    ImGui::PopTextWrapPos();
    tooltip(row.explanation.c_str());
    cell(row.live ? "live" : "baked", row.live ? palette().good : palette().dim);
    tooltip(row.live ? "Takes effect immediately; change it in the panel named here."
                     : "Stored in the chunk file. Change it below and bake again.");
}

std::string bakedColours(const EditorView& view) {
    const std::optional<planet::ColourPyramid>& colour = view.planet->colour();
    return colour ? colourText(view.bake.current.settings.colour) : "none";
}

void addBaked(const EditorView& view, Parameters& rows) {
    const planet::BakeSettings& baked = view.bake.current.settings;
    rows.push_back(
        {"Source", view.bake.current.source.empty() ? "unknown" : sourceName(view.bake.current.source), false,
         view.bake.current.source.empty() ? "The file does not record the path of its source."
                                          : view.bake.current.source.string().c_str()});
    rows.push_back({"Face size", fmt::format("{} samples", baked.faceSize.value_or(0)), false,
                    "Samples along a side of each of the six cube faces at the finest level."});
    rows.push_back({"Chunk size", fmt::format("{} vertices", baked.chunkSize), false,
                    "Vertices along a side of a chunk, the same at every level."});
    rows.push_back({"Radius", fmt::format("{:.1f} km", baked.radiusM / 1000), false,
                    "Radius of the sphere that heights are measured from."});
    const std::string finest =
        baked.finestQuantumM ? fmt::format(", finest {:g} m", *baked.finestQuantumM) : "";
    rows.push_back({"Quantum", fmt::format("{:g} m{}", baked.quantumM.value_or(0), finest), false,
                    "Height of one of the 65536 quantisation steps of the file. Finest: where the source is "
                    "finer, heights have steps of a power-of-two fraction, down to this one."});
    rows.push_back(
        {"Compression",
         view.bake.compressionKnown ? fmt::format("level {}", baked.compressionLevel) : "unknown", false,
         "Compression level of the encoder. Files of level 3 are read at about half the speed. Older files "
         "do not record it."});
    rows.push_back({"Colours", bakedColours(view), false,
                    view.planet->colour() ? view.planet->colour()->source.c_str()
                                          : "The file contains no colour tiles."});
}

void addLive(const ViewSettings& settings, Parameters& rows) {
    rows.push_back({"Tolerance", fmt::format("{:.2f} px", settings.lod.tauPx), true,
                    "Screen-space error threshold, set in the LOD panel."});
    rows.push_back({"Exaggeration", fmt::format("{:.2f} x", settings.surface.exaggeration), true,
                    "Factor applied to heights when drawing, set in the Surface panel."});
    rows.push_back({"Sea level", fmt::format("{:.0f} m", settings.surface.seaLevelM), true,
                    "Set in the Surface panel."});
    rows.push_back({"Memory", fmt::format("{} MiB", settings.paging.budgetMB), true,
                    "Budget for resident chunks and colour tiles, set in the Paging panel."});
}

void openFileSection(const EditorView& view, const ViewSettings& settings) {
    if (!view.planet || !section("Open file")) return;
    Parameters rows;
    addBaked(view, rows);
    addLive(settings, rows);
    constexpr std::array columns = {TableColumn{"Parameter", 0.2f, nullptr, "Exaggeration"},
                                    TableColumn{"Value", 5, nullptr, "1025 samples"},
                                    TableColumn{"Set", 0.2f, nullptr, "baked"}};
    if (!beginListTable("parameters", columns, rows.size() + 1, rows.size() + 2)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        if (column == 0) return std::string(rows[row].name);
        if (column == 1) return textSortKey(rows[row].value);
        return std::string(rows[row].live ? "live" : "baked");
    };
    for (const std::size_t row : tableOrder(rows.size(), chosenSort(), key))
        tableRow(row, [&] { parameterRow(rows[row]); });
    endTable(
        exportTable<Parameter>("bake", rows.size(), [&](std::size_t row) { return rows[row]; },
                               {{"parameter", [](const Parameter& row) { return row.name; }},
                                {"value", [](const Parameter& row) { return row.value; }},
                                {"set", [](const Parameter& row) { return row.live ? "live" : "baked"; }}}));
}

bool chunkSizeControl(const BakeRequest& current, BakeRequest& request) {
    constexpr const char* explanation =
        "Vertices along a side of a chunk. Larger: fewer draw calls and nodes and better compression, but "
        "more triangles than the tolerance needs. Smaller: the opposite.";
    int index = static_cast<int>(
        std::find(planet::chunkSizes.begin(), planet::chunkSizes.end(), request.settings.chunkSize) -
        planet::chunkSizes.begin());
    litLabel("Chunk size", request.settings.chunkSize != current.settings.chunkSize, explanation);
    const bool changed =
        combo("Chunk size", index, "17 vertices\00033 vertices\00065 vertices\000129 vertices\0");
    tooltip(explanation);
    if (changed) request.settings.chunkSize = planet::chunkSizes[static_cast<std::size_t>(index)];
    return changed;
}

bool faceSizeControl(const BakeRequest& current, BakeRequest& request) {
    constexpr const char* explanation =
        "Samples along a side of each of the six faces, 2^n + 1. Natural: the smallest size that keeps all "
        "detail of the source. Smaller: less detail. Larger: a bigger file without more detail.";
    const std::optional<int> size = request.settings.faceSize;
    const auto text = [](int samples) { return fmt::format("{} samples", samples); };
    litLabel("Face size", size != current.settings.faceSize, explanation);
    bool changed = false;
    const bool open = ImGui::BeginCombo("##face", size ? text(*size).c_str() : "natural");
    if (!open) noteItem("Face size");
    tooltip(explanation);
    if (!open) return false;
    if (ImGui::Selectable("natural", !size)) {
        request.settings.faceSize.reset();
        changed = true;
    }
    for (int log2 = smallestFaceLog2; log2 <= largestFaceLog2; ++log2) {
        const int samples = (1 << log2) + 1;
        if (samples < request.settings.chunkSize) continue;
        const bool chosen = ImGui::Selectable(text(samples).c_str(), size == samples);
        noteItem("Face size: " + text(samples));
        if (!chosen) continue;
        request.settings.faceSize = samples;
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

bool radiusControl(const BakeRequest& current, BakeRequest& request) {
    constexpr const char* explanation =
        "Radius of the sphere that heights are measured from, in kilometres: Earth 6371, Mars 3389.5, Moon "
        "1737.4. With a wrong radius, mountains look too steep or too flat.";
    litLabel("Radius", request.settings.radiusM != current.settings.radiusM, explanation);
    double radiusKm = request.settings.radiusM / 1000;
    const bool changed = numberField("##radius", radiusKm, "%.3f km");
    tooltip(explanation);
    if (changed) request.settings.radiusM = 1000 * std::clamp(radiusKm, 1e-3, 1e6);
    return changed;
}

// Draws the number of a quantum that is set, beside its checkbox.
bool quantumField(const char* id, const char* explanation, std::optional<double>& quantumM) {
    if (!quantumM) return false;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    double metres = *quantumM;
    const bool changed = numberField(id, metres, "%g m");
    tooltip(explanation);
    if (changed) quantumM = std::clamp(metres, 1e-6, 1e6);
    return changed;
}

bool quantumControl(const BakeRequest& current, BakeRequest& request) {
    constexpr const char* explanation =
        "Height in metres of one of the file's 65536 quantisation steps. Automatic: the source's own step, "
        "or for floating-point sources the smallest step that covers the range. Larger: a smaller file, but "
        "terraces on flat ground. Too small: the heights do not fit, and the bake stops with an error.";
    std::optional<double>& quantum = request.settings.quantumM;
    litLabel("Quantum", quantum != current.settings.quantumM, explanation);
    bool automatic = !quantum;
    const bool changed = ImGui::Checkbox("automatic", &automatic);
    tooltip(explanation);
    if (changed) {
        quantum = automatic ? std::nullopt : std::optional(current.settings.quantumM.value_or(1));
        request.settings.finestQuantumM.reset();
    }
    return quantumField("##quantum", explanation, quantum) || changed;
}

bool finestQuantumControl(const BakeRequest& current, BakeRequest& request) {
    constexpr const char* explanation =
        "Limit of the quantum where a part of the source needs finer steps than the file's quantum, as "
        "centimetre lidar in a coarse planet does. Steps are power-of-two fractions of the file's quantum. "
        "Automatic: as fine as the source needs, or only the file's quantum if that is set. Finer: more "
        "bytes "
        "there.";
    std::optional<double>& finest = request.settings.finestQuantumM;
    litLabel("Finest quantum", finest != current.settings.finestQuantumM, explanation);
    bool automatic = !finest;
    const bool changed = ImGui::Checkbox("automatic##finest", &automatic);
    tooltip(explanation);
    if (changed) {
        const double proposedM = request.settings.quantumM.value_or(1) / 64;
        finest =
            automatic ? std::nullopt : std::optional(current.settings.finestQuantumM.value_or(proposedM));
    }
    return quantumField("##finest_quantum", explanation, finest) || changed;
}

bool effortControls(const EditorView& view, BakeRequest& request) {
    const planet::BakeSettings& current = view.bake.current.settings;
    const bool packed =
        slider("Compression", request.settings.compressionLevel,
               view.bake.compressionKnown ? current.compressionLevel : planet::defaultCompressionLevel,
               planet::minCompressionLevel, planet::maxCompressionLevel, "level %d",
               "Compression level of the encoder. 0: uncompressed, 2 bytes per sample; 2: default; 3: fifty "
               "times slower for 1 to 9 % fewer bytes, which are read at about half the speed.");
    const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
    const bool threads = slider("Threads", request.settings.threads, 0, 0, cores,
                                request.settings.threads == 0 ? "one per core" : "%d",
                                "Number of threads for baking. Fewer: slower, but the window stays more "
                                "responsive. The file is the same.");
    return packed || threads;
}

void launcherControl(BakePanelState& state) {
    constexpr const char* explanation =
        "A command that bakes on several processes or machines, such as \"mpirun -n 4\" or \"srun -N 8\". "
        "The bake is "
        "started after it, by a shell. The file is the same. It needs a build with MPI, and on several "
        "machines a file "
        "system that they share. Empty: the bake runs in this program.";
    labelledControl("Run with", explanation);
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##launcher", "this program; or mpirun -n 4", state.launcher.data(),
                             state.launcher.size());
    noteItem("Run with");
    tooltip(state.launcher[0] == 0 ? explanation
                                   : fmt::format("{}\n\n{}", state.launcher.data(), explanation).c_str());
}

// Draws the controls of the source. A new source may bring other colours, which follow it.
bool sourceSection(const EditorView& view, BakePanelState& state, BakeRequest& request) {
    const std::filesystem::path colour = request.colour;
    if (!sourceControls(view, state.source, request)) return false;
    if (request.colour != colour)
        setColour(request, state.colour);
    else
        followSource(request, state.colour);
    state.preview.open = true;
    return true;
}

void requestSection(const EditorView& view, BakePanelState& state, Commands& commands) {
    if (!section("Bake settings")) return;
    BakeRequest request = state.edited.value_or(view.bake.current);
    beginGrey(view.bake.running.has_value(), "A bake is running; wait or cancel it.");
    bool changed = sourceSection(view, state, request);
    changed |= chunkSizeControl(view.bake.current, request);
    changed |= faceSizeControl(view.bake.current, request);
    changed |= radiusControl(view.bake.current, request);
    changed |= quantumControl(view.bake.current, request);
    changed |= finestQuantumControl(view.bake.current, request);
    changed |= colourControls(view, state.colour, request, commands);
    changed |= effortControls(view, request);
    launcherControl(state);
    endGrey();
    if (changed) edited(request, view.frames.timeS, state);
}

// Returns true unless a chosen image is missing. If the source's own image is missing, the bake has no
// colours.
bool mayBake(const ColourEdit& colour) {
    return colour.problem.empty() || colour.from == ColourEdit::From::Own;
}

void askForEstimate(const EditorView& view, BakePanelState& state, Commands& commands) {
    if (!state.estimateAtS || view.frames.timeS < *state.estimateAtS || view.bake.running) return;
    state.estimateAtS.reset();
    if (state.edited && state.source.problem.empty() && mayBake(state.colour))
        commands.push_back(EstimateBake{*state.edited});
}

// Returns the estimated size and its ratio to the open file's: "12.3 MiB, 1.40 x current".
std::string sizeText(const EditorView& view, double bytes) {
    if (!view.planet) return bytesText(bytes);
    const double open = static_cast<double>(view.planet->file().sizeBytes());
    return fmt::format("{}, {:.2f} x current", bytesText(bytes), bytes / open);
}

std::string colourTilesText(const std::optional<planet::ColourEstimate>& colour) {
    if (!colour) return {};
    return fmt::format("{} tiles, {}", countText(static_cast<double>(colour->tiles)),
                       bytesText(colour->fileBytes));
}

std::string colourMemoryText(const std::optional<planet::ColourEstimate>& colour) {
    if (!colour) return {};
    return fmt::format("{} baking, {} resident", bytesText(static_cast<double>(colour->bakeBytes)),
                       bytesText(static_cast<double>(colour->residentBytes)));
}

void estimateValues(const EditorView& view, const BakePanelState& state) {
    if (!state.edited) return;
    const BakeView& bake = view.bake;
    const bool waiting = state.estimateAtS || bake.estimating;
    if (!waiting && !bake.estimateProblem.empty()) {
        ImGui::PushTextWrapPos(0);
        ImGui::TextColored(palette().bad, "%s", bake.estimateProblem.c_str());
        ImGui::PopTextWrapPos();
        return;
    }
    if ((!waiting && !bake.estimate) || !beginValues("estimate")) return;
    const auto value = [&](const auto& text) {
        return waiting || !bake.estimate ? std::string("...") : text(*bake.estimate);
    };
    using Estimate = planet::BakeEstimate;
    valueRow("Expected size", value([&](const Estimate& e) { return sizeText(view, e.fileBytes); }),
             "Estimated file size, from a sample of blocks baked in memory; accurate to about 10 %.");
    valueRow("Expected time", value([](const Estimate& e) { return durationText(e.seconds); }),
             "Estimated time on this machine with these threads and no other load.");
    valueRow(
        "Expected memory",
        value([](const Estimate& e) { return bytesText(static_cast<double>(e.bakeBytes)); }),
        "Estimated peak memory of the bake besides the program's own, including colours; accurate to about a "
        "factor of two.");
    valueRow("Chunks", value([](const Estimate& e) {
                 return fmt::format("{} on {} levels", countText(static_cast<double>(e.chunks)),
                                    planet::deepestLevelOf(e.shape) + 1);
             }),
             "Number of chunks in all levels.");
    valueRow("Samples", value([](const Estimate& e) {
                 const bool sparse = e.coarsestLeafLevel < planet::deepestLevelOf(e.shape);
                 return fmt::format("{}, {}{} per face side", countText(static_cast<double>(e.samples)),
                                    sparse ? "up to " : "", planet::faceCells(e.shape) + 1);
             }),
             "Number of samples of all leaves. A place is baked only as finely as the sources there.");
    if (!state.edited->colour.empty()) {
        valueRow("Colours", value([](const Estimate& e) { return colourTilesText(e.colour); }),
                 "Number of colour tiles of 256 x 256 texels in all levels, and their estimated share of the "
                 "file size.");
        valueRow("Colour time", value([](const Estimate& e) {
                     return e.colour ? durationText(e.colour->seconds) : std::string();
                 }),
                 "Part of the expected time that reads the image and packs tiles.");
        valueRow("Colour memory", value([](const Estimate& e) { return colourMemoryText(e.colour); }),
                 "Peak memory while baking, including the image cache; and GPU memory if all tiles were "
                 "resident. The colour share of the budget limits how many are.");
    }
    endValues();
}

void bakeButtons(const EditorView& view, BakePanelState& state, Commands& commands) {
    BakeRequest request = state.edited.value_or(view.bake.current);
    request.launcher = state.launcher.data();
    const bool same = sameFile(request, view.bake.current);
    beginGrey(!state.source.problem.empty() || !mayBake(state.colour),
              "The source or the colour image cannot be baked; the reason is shown above.");
    if (button(same ? "Bake again" : "Bake",
               "Bakes in the background, then shows the new planet with the same camera and settings. The "
               "previous bake stays available for comparison.")) {
        state.estimateAtS.reset();
        commands.push_back(StartBake{request});
    }
    endGrey();
    if (!state.edited) return;
    sameLineForButton("Revert to open file");
    if (button("Revert to open file", "Discards the changes made above.")) {
        state.edited.reset();
        state.estimateAtS.reset();
        setSource(view.bake.current.source, state.source);
        setColour(view.bake.current, state.colour);
    }
}

void launchedRows(const BakeView& bake) {
    const planet::JobProgress& job = bake.progress;
    const bool begun = job.unitsTotal > 0;
    valueRow("Run with", bake.running->launcher, "The command that has started the bake.");
    valueRow("Units", begun ? fmt::format("{} of {}", job.unitsDone, job.unitsTotal) : "...",
             "Parts of the bake that one process does at a time. Finished ones survive the bake.");
    valueRow("Slowest rank",
             begun ? fmt::format("{} of {}, {} samples/s", job.slowestRank, job.ranks,
                                 countText(job.slowestSamplesPerS))
                   : "...",
             "The process that has done the fewest samples. They get units as they ask for them, so a slow "
             "one does not "
             "hold up the others.");
}

void progressSection(const BakeView& bake, Commands& commands) {
    const planet::BakeProgress& progress = bake.progress.bake;
    const bool begun = progress.samplesTotal > 0;
    const double share =
        begun ? static_cast<double>(progress.samplesDone) / static_cast<double>(progress.samplesTotal) : 0;
    const bool isLaunched = !bake.running->launcher.empty();
    usageBar(share, begun ? fmt::format("{:.0f} %", 100 * share)
                          : std::string(isLaunched ? "starting" : "opening the source"));
    if (beginValues("progress")) {
        valueRow("Baking", sourceName(bake.running->source), bake.running->source.string().c_str());
        valueRow("Rate", begun ? fmt::format("{} samples/s", countText(progress.samplesPerS)) : "...",
                 "Finest-level samples and colour texels per second, since the bake began.");
        valueRow("Time left", begun ? durationText(progress.remainingS) : "...",
                 "Estimated from the current rate.");
        if (isLaunched) launchedRows(bake);
        endValues();
    }
    beginGrey(bake.stopping, "The bake is stopping.");
    if (button(
            bake.stopping ? "Stopping..." : "Cancel",
            isLaunched
                ? "Interrupts the command; the open planet stays. Its finished units are kept: the next bake "
                  "of the same source with the same settings goes on with them."
                : "Cancels the bake and discards its output; the open planet stays."))
        commands.push_back(CancelBake{});
    endGrey();
}

void outcomeLines(const BakeView& bake) {
    ImGui::PushTextWrapPos(0);
    if (!bake.lastProblem.empty()) {
        ImGui::TextColored(palette().warning, "Last bake: %s", bake.lastProblem.c_str());
    } else if (bake.lastReport) {
        const planet::BakeReport& report = *bake.lastReport;
        const std::string text = fmt::format(
            "Last bake: {} in {}, {:.2f} bits per sample; root errors: additive {}, tight {}{}",
            bytesText(static_cast<double>(report.fileBytes)), durationText(report.seconds),
            8 * static_cast<double>(report.fileBytes - report.colourBytes) /
                static_cast<double>(report.samples),
            distanceText(static_cast<double>(report.largestDeltaCM)),
            distanceText(static_cast<double>(report.largestDeltaTightM)),
            report.missingSamples == 0 ? std::string()
                                       : fmt::format("; {} samples without data",
                                                     countText(static_cast<double>(report.missingSamples))));
        const std::string colours =
            report.colourTiles == 0
                ? std::string()
                : fmt::format("; {} colour tiles, {}", countText(static_cast<double>(report.colourTiles)),
                              bytesText(static_cast<double>(report.colourBytes)));
        const std::string copied = report.copiedChunks == 0
                                       ? std::string()
                                       : fmt::format("; {} of {} chunks copied from an earlier bake",
                                                     countText(static_cast<double>(report.copiedChunks)),
                                                     countText(static_cast<double>(report.chunks)));
        ImGui::TextColored(palette().good, "%s", (text + colours + copied).c_str());
        tooltip(
            "Root errors are the largest geometric errors of the six root chunks: additive (δc) sums the "
            "errors of all levels; tight is the largest measured distance to the finest samples.");
    }
    ImGui::PopTextWrapPos();
}

void previousSection(const DataView& data, Commands& commands) {
    if (!data.hasPreviousBake || !section("Previous bake")) return;
    ImGui::TextColored(palette().dim, "%s", data.previousName.c_str());
    bool shown = data.showsPreviousBake;
    if (ImGui::Checkbox("Show previous bake", &shown)) commands.push_back(ShowPreviousBake{shown});
    noteItem("Show previous bake");
    tooltip("Switches between the two bakes; the camera stays.");
    secondColumn("Dismiss");
    if (button("Dismiss", "Frees its memory. Its file stays in the cache."))
        commands.push_back(DismissPreviousBake{});
}

}  // namespace

void bakePanel(const EditorView& view, BakePanelState& state, ViewSettings& settings, Commands& commands) {
    followOpenFile(view, state);
    sourcePreviewBox(view, state.edited.value_or(view.bake.current), state.source.problem.empty(),
                     state.preview, commands);
    // The picture stays in view while the controls below scroll.
    const bool pinned = ImGui::GetContentRegionAvail().y > ImGui::GetFontSize() * 12;
    if (pinned) ImGui::BeginChild("below the preview");
    previousSection(view.data, commands);
    requestSection(view, state, commands);
    askForEstimate(view, state, commands);
    ImGui::Spacing();
    if (view.bake.running) {
        progressSection(view.bake, commands);
    } else {
        // Lines that come and go stand below the button, so that it does not move under the pointer.
        bakeButtons(view, state, commands);
        estimateValues(view, state);
    }
    outcomeLines(view.bake);
    openFileSection(view, settings);
    if (pinned) ImGui::EndChild();
}

}  // namespace worldy::ui
