#include "ui/panels/lod/lod_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/base/glossary.h"
#include "app/base/text.h"
#include "app/scene/overlay_colours.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/history.h"
#include "ui/model/key_names.h"
#include "ui/panels/lod/budget_section.h"

namespace worldy::ui {

namespace {

// Length of the list of thrashing chunks.
constexpr std::size_t thrashingShown = 6;

void toleranceControls(const SettingControls& control, ViewSettings& settings) {
    planet::LodSettings& lod = settings.lod;
    const char* const governed = whyTauIsGoverned(settings);
    beginGrey(governed != nullptr, governed ? governed : "");
    control(lod.tauPx);
    endGrey();
    control(lod.hysteresis);
    control(lod.maxLevel);
    control(lod.morph);
    beginGrey(!lod.morph, "Turn on Morph first.");
    control(lod.morphRange);
    control(lod.fadeS);
    endGrey();
}

// Returns true for a file whose bake did not measure tight errors.
bool lacksTightErrors(const planet::ChunkTree& tree) {
    return std::all_of(tree.nodes.begin(), tree.nodes.begin() + planet::faceCount,
                       [](const planet::ChunkNode& root) {
                           return root.deltaTightM == 0 && root.childrenState != planet::ChildrenState::None;
                       });
}

void metricControl(const EditorView& view, const SettingControls& control, planet::LodSettings& lod) {
    control(lod.metric);
    if (view.planet && lod.metric == planet::ErrorMetric::Tight && lacksTightErrors(view.planet->tree())) {
        wrappedText("This file contains no tight errors, so no chunk is split. Bake it again.",
                    palette().warning);
    }
}

void cullingControls(const EditorView& view, const SettingControls& control, planet::LodSettings& lod,
                     Commands& commands) {
    control(lod.frustumCulling);
    control.beside(lod.horizonCulling);
    bool frozen = view.camera.lodFrozen;
    if (frozen) ImGui::PushStyleColor(ImGuiCol_Text, palette().warning);
    if (ImGui::Checkbox((withKey("Freeze", "freeze_lod") + "###freeze").c_str(), &frozen))
        commands.push_back(FreezeLod{frozen});
    noteItem("Freeze");
    if (view.camera.lodFrozen) ImGui::PopStyleColor();
    tooltip(
        "Keeps the current selection while the camera moves, to inspect it from outside. No other chunks are "
        "selected until it is turned off.");
}

// Returns the index of a chunk size, or the number of sizes if it is not one of them.
std::size_t sizeIndex(int chunkSize) {
    return static_cast<std::size_t>(
        std::find(planet::chunkSizes.begin(), planet::chunkSizes.end(), chunkSize) -
        planet::chunkSizes.begin());
}

void bakeOffer(const EditorView& view, int wantedSize, Commands& commands) {
    ImGui::AlignTextToFramePadding();
    const bool running = view.bake.running.has_value();
    ImGui::TextColored(palette().warning, "%s", running ? "baking" : "baked");
    ImGui::SameLine();
    beginGrey(!view.bake.canBake || running,
              running ? "A bake is running." : "The source of this file is unknown or missing.");
    const char* explanation =
        running ? "A bake is running; see the Bake panel."
        : view.bake.canBake && !view.bake.lostColours.empty()
            ? "Bakes the source again with this chunk size, but without colours, because the path of the "
              "colour image is unknown; set it in the Bake panel."
        : view.bake.canBake ? "Bakes the source again with this chunk size in the background. The current "
                              "file stays open until the new one is complete."
                            : "Cannot bake: the source of this file is unknown or missing. Open the "
                              "elevation data itself to bake it.";
    if (button("Bake", explanation)) {
        BakeRequest request = view.bake.current;
        request.settings.chunkSize = wantedSize;
        commands.push_back(StartBake{request});
    }
    endGrey();
}

void chunkSizeControl(const EditorView& view, Commands& commands) {
    const int fileSize = planet::chunkSize(view.planet->tree().shape);
    // The size that the user has chosen; 0 if that is the file's.
    int* wanted = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("wantedChunkSize"), 0);
    if (*wanted == fileSize) *wanted = 0;
    const auto fileIndex = static_cast<int>(sizeIndex(fileSize));
    int index = *wanted == 0 ? fileIndex : static_cast<int>(sizeIndex(*wanted));
    if (choiceIndex(
            "Chunk size", index, fileIndex,
            "17 x 17\0"
            "33 x 33\0"
            "65 x 65\0"
            "129 x 129\0",
            "Vertices along a side of a chunk, the same at every level. It is part of the file, so changing "
            "it requires a bake. Larger: fewer, larger draw calls and reads, but more triangles than the "
            "tolerance needs. Smaller: a finer selection, but more chunks to select, queue and draw.")) {
        *wanted = index == fileIndex ? 0 : planet::chunkSizes[static_cast<std::size_t>(index)];
    }
    if (*wanted != 0) bakeOffer(view, *wanted, commands);
}

void formulas(const EditorView& view, double tauPx) {
    const double screenScale = planet::screenScalePx(view.camera.lodView);
    wrappedText("ε = δc K' / D     d_m = δc K", palette().dim);
    tooltip(
        "Screen-space error in pixels of a chunk at the distance D in metres, and the switch distance d_m in "
        "metres: a nearer chunk must be split. δc, in metres, is the chunk's geometric error from the bake.");
    if (!beginValues("formulas")) return;
    valueRow("K' = W / (2 tan(Hfov/2))", fmt::format("{:.1f} px", screenScale),
             "W: viewport width in pixels; Hfov: horizontal field of view. An error of 1 m at a distance of "
             "1 m covers K' pixels.");
    valueRow(fmt::format("K = K' / {}", tauSymbol()).c_str(), fmt::format("{:.1f}", screenScale / tauPx),
             fmt::format("W / (2 {} tan(Hfov/2)); d_m = δc K.", tauSymbol()).c_str());
    valueRow("d_m for δc = 1 m", distanceText(screenScale / tauPx),
             "A chunk with a geometric error of 1 m is split within this distance.");
    endValues();
}

// Returns the error with two decimals, for comparison with the tolerance.
std::string preciseErrorText(float px) {
    return px < 1000 ? fmt::format("{:.2f} px", px) : pixelsText(static_cast<double>(px));
}

void drawnValues(const EditorView& view, double tauPx) {
    const planet::SelectionCounters& s = view.frames.stats.selection;
    if (!beginValues("drawn")) return;
    valueRow("Visited", countText(s.visited), "Quadtree nodes visited by the selection.");
    valueRow("Culled", fmt::format("{} + {}", countText(s.culledFrustum), countText(s.culledHorizon)),
             "Culled subtrees: outside the frustum + below the horizon.");
    valueRow(terms::drawnChunks.name, countText(s.drawn), terms::drawnChunks.meaning);
    valueRow(
        "Waiting", countText(s.waiting),
        "Chunks drawn although their error exceeds the tolerance, because their children are not loaded.",
        s.waiting > 0 ? &palette().warning : nullptr);
    valueRow("Fading", countText(s.fading),
             "Chunks and chunk edges still morphing after a level change, and splits or merges that wait for "
             "a morph. If this never drops to 0, the camera, the tolerance or loading changes faster than "
             "the fade.");
    const auto triangleRow = [](const Term& term, std::uint64_t count) {
        valueRow(term.name, countText(static_cast<double>(count)), term.meaning);
    };
    triangleRow(terms::groundTriangles, s.groundTriangles);
    triangleRow(terms::skirtTriangles, s.skirtTriangles);
    triangleRow(terms::triangles, s.triangles());
    valueRow("Deepest level", fmt::format("{}", s.deepestLevel),
             "Deepest level drawn; level 0 is a whole cube face.");
    const bool over = static_cast<double>(s.worstEpsPx) > tauPx;
    valueRow(fmt::format("Max {}", epsSymbol()).c_str(), preciseErrorText(s.worstEpsPx),
             "Largest predicted error on screen of a drawn chunk's own surface, in pixels.",
             over ? &palette().warning : nullptr);
    valueRow("Max drawn bound", preciseErrorText(s.worstDrawnBoundPx), terms::drawnBoundPx.meaning);
    endValues();
}

void levelBars(const planet::Planet& planet) {
    std::array<int, planet::maxLevel + 1> chunks{};
    for (const planet::DrawItem& item : planet.selection().draw) ++chunks[item.id.level];
    const double cells = planet::chunkCells(planet.tree().shape);
    std::vector<Bar> bars;
    for (std::size_t level = 0; level < chunks.size(); ++level) {
        if (chunks[level] == 0) continue;
        const glm::vec3 c = levelColour(static_cast<int>(level));
        bars.push_back(
            {fmt::format("{}", level),
             static_cast<double>(chunks[level]),
             {c.r, c.g, c.b, 1},
             fmt::format("{}   {} triangles", chunks[level], countText(chunks[level] * 2 * cells * cells))});
    }
    barList("drawn chunks by level", bars, "chunks");
    tooltip("Chunks drawn per level and their ground triangles. Level 0 is a whole cube face.");
}

void drawnPlots(const EditorView& view, double tauPx) {
    const std::vector<float> times = historyTimes(view.frames.history);
    const std::array counts = {
        Series{"drawn", seriesColour(0),
               historyValues(view.frames.history, [](const FrameStats& s) { return s.selection.drawn; })},
        Series{"visited", seriesColour(1),
               historyValues(view.frames.history, [](const FrameStats& s) { return s.selection.visited; })}};
    linePlot("drawn and visited", times, counts, "");
    // A chunk that contains the eye has an unbounded error, so errors far above the tolerance are clamped.
    const auto top = static_cast<float>(16 * tauPx);
    const std::string name = fmt::format("max {} (clamped at 16 {})", epsSymbol(), tauSymbol());
    const std::array errors = {
        Series{name.c_str(), seriesColour(3), historyValues(view.frames.history, [top](const FrameStats& s) {
                   return std::min(s.selection.worstEpsPx, top);
               })}};
    linePlot("max error", times, errors, "px", 0, 3, false, tauPx);
}

// Returns the chunks that thrashed last, newest first, each once.
std::vector<planet::ChunkId> lastThrashing(const planet::LodChanges& changes) {
    std::vector<planet::ChunkId> chunks;
    if (changes.thrashRecent() == 0) return chunks;
    const auto& recent = changes.recent();
    for (auto change = recent.rbegin(); change != recent.rend() && chunks.size() < thrashingShown; ++change) {
        if (change->thrash && std::find(chunks.begin(), chunks.end(), change->chunk) == chunks.end())
            chunks.push_back(change->chunk);
    }
    return chunks;
}

void changes(const EditorView& view, Commands& commands) {
    const planet::LodChanges& c = view.instruments.changes;
    const std::size_t thrashing = c.thrashRecent();
    if (beginValues("changes")) {
        valueRow("Splits", fmt::format("{:.0f}/s", c.splitsPerS()),
                 "Chunks replaced by their children in the last second.");
        valueRow("Merges", fmt::format("{:.0f}/s", c.mergesPerS()),
                 "Chunks that replaced their children in the last second.");
        valueRow("Thrash, last 10 s", countText(static_cast<double>(thrashing)),
                 "Chunks that switched back within a second, which wastes work and flickers. More hysteresis "
                 "or a larger memory budget helps.",
                 thrashing > 0 ? &palette().warning : nullptr);
        valueRow("Thrash, total", countText(static_cast<double>(c.thrashTotal())),
                 "Chunks that switched back within a second, since this planet was opened.");
        endValues();
    }
    const std::vector<planet::ChunkId> chunks = lastThrashing(c);
    if (chunks.empty()) return;
    ImGui::TextDisabled("Latest thrash, newest first:");
    for (const planet::ChunkId& id : chunks) chunkLink(id, view, commands);
}

}  // namespace

void lodPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    const SettingControls control(settings);
    planet::LodSettings& lod = settings.lod;
    if (section("Level of detail")) {
        toleranceControls(control, settings);
        metricControl(view, control, lod);
        cullingControls(view, control, lod, commands);
        if (view.planet) chunkSizeControl(view, commands);
        formulas(view, lod.tauPx);
    }
    if (section("Budget")) budgetSection(view, control, settings);
    if (!view.planet) return emptyState("No planet is open. Open one to see its level-of-detail statistics.");
    if (section("Drawn")) drawnValues(view, lod.tauPx);
    if (section("By level")) levelBars(*view.planet);
    if (section("Last 10 seconds")) drawnPlots(view, lod.tauPx);
    if (section("Level changes")) changes(view, commands);
}

}  // namespace worldy::ui
