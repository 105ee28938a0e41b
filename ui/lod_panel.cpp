#include "ui/lod_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "ui/chunk_link.h"
#include "ui/history.h"
#include "ui/item_map.h"
#include "ui/overlay_colours.h"
#include "ui/plots.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

// Of the list of chunks that flip back and forth.
constexpr std::size_t thrashingShown = 6;

void toleranceKnobs(LodKnobs& lod) {
    const LodKnobs defaults;
    slider(
        fmt::format("Tolerance {}", tauSymbol()).c_str(), lod.tauPx, defaults.tauPx, 0.1, 64, "%.2f px",
        fmt::format("Error on screen that is good enough, pixels. A chunk is replaced by its children while "
                    "{} = delta_c K' / D > {}. Larger: fewer triangles and less memory, more visible error "
                    "and later, larger pops. Smaller: more of everything.",
                    epsSymbol(), tauSymbol())
            .c_str(),
        ImGuiSliderFlags_Logarithmic);
    slider(
        "Hysteresis", lod.hysteresis, defaults.hysteresis, 0, 0.9, "%.2f",
        fmt::format("Share of {0} by which a merge comes later than the split: what is split stays split "
                    "until {1} <= {0} (1 - hysteresis). Larger: fewer chunks that flip back and forth, but "
                    "more triangles than {0} alone asks for. 0: chunks near {0} flip with every move.",
                    tauSymbol(), epsSymbol())
            .c_str());
    slider("Largest level", lod.maxLevel, defaults.maxLevel, 0, planet::maxLevel, "%d",
           "Deepest level drawn; chunks of this level are not split. 0 is a whole cube face. Smaller: coarse "
           "ground near the camera, whatever the tolerance says.");
    checkbox("Morph", lod.morph, defaults.morph,
             "Slides a chunk's vertices onto its parent's surface before the parent takes its place. Off: "
             "chunks pop when their level changes.");
    ImGui::BeginDisabled(!lod.morph);
    slider(
        "Morph range", lod.morphRange, defaults.morphRange, 0.01, 4, "%.2f",
        fmt::format("Share of {0} over which a chunk slides: by its parent's {1}, from {0} (1 + range) where "
                    "it is itself down to {0} where it is its parent. Larger: slower slides, but more of the "
                    "picture is coarser than it could be. Small: nearly a pop.",
                    tauSymbol(), epsSymbol())
            .c_str(),
        ImGuiSliderFlags_Logarithmic);
    slider("Fade", lod.fadeS, defaults.fadeS, 0, 10, "%.2f s",
           "With morph: seconds that a chunk takes at least to slide all the way, each level for itself. For "
           "children that come late, a new tolerance, a fast camera: what the morph range cannot foresee. "
           "Larger: calmer, but the picture is longer coarser or finer than it should be. 0: it pops.",
           ImGuiSliderFlags_Logarithmic);
    ImGui::EndDisabled();
}

// Of a file that was baked before there was one.
bool lacksTightErrors(const planet::ChunkTree& tree) {
    return std::all_of(tree.nodes.begin(), tree.nodes.begin() + planet::faceCount,
                       [](const planet::ChunkNode& root) {
                           return root.deltaTightM == 0 && root.childrenState != planet::ChildrenState::None;
                       });
}

void metricKnob(const EditorView& view, LodKnobs& lod) {
    const LodKnobs defaults;
    choice("Error metric", lod.metric, defaults.metric, "additive\0tight\0",
           "Which bound of a chunk's error, metres, is compared with the tolerance. Additive: delta_c, the "
           "largest step to each finer level added up over the levels; safe and loose. Tight: the largest "
           "distance that the bake measured between the chunk's surface, or that of one under it, and the "
           "finest data; never more than delta_c, so fewer triangles for the same tolerance.");
    if (view.planet && lod.metric == planet::ErrorMetric::Tight && lacksTightErrors(view.planet->tree())) {
        wrappedText("This file has no tight errors: nothing is split. Bake it again.", palette().warning);
    }
}

void cullingKnobs(const EditorView& view, LodKnobs& lod, Commands& commands) {
    const LodKnobs defaults;
    checkbox("Frustum culling", lod.frustumCulling, defaults.frustumCulling,
             "Leaves out what lies beside and behind the view. Off: it is loaded and drawn too, so a turn of "
             "the camera shows nothing coarse, for several times the chunks.");
    secondColumn();
    checkbox(
        "Horizon culling", lod.horizonCulling, defaults.horizonCulling,
        "Leaves out what the planet itself hides. Off: its far side is loaded and drawn too, at no gain.");
    bool frozen = view.lodFrozen;
    if (frozen) ImGui::PushStyleColor(ImGuiCol_Text, palette().warning);
    if (ImGui::Checkbox("Freeze (F2)", &frozen)) commands.push_back(FreezeLod{frozen});
    noteItem("Freeze (F2)");
    if (view.lodFrozen) ImGui::PopStyleColor();
    tooltip(
        "What is drawn stays chosen for the view as it is now, while the camera flies on: look at the "
        "selection from outside. Meanwhile the picture is as coarse as it was chosen to be.");
}

// The index of a chunk size, or the number of sizes where it is none of them.
std::size_t sizeIndex(int chunkSize) {
    return static_cast<std::size_t>(
        std::find(planet::chunkSizes.begin(), planet::chunkSizes.end(), chunkSize) -
        planet::chunkSizes.begin());
}

void bakeOffer(const EditorView& view, int wantedSize, Commands& commands) {
    ImGui::AlignTextToFramePadding();
    const bool running = view.bake.running.has_value();
    ImGui::TextColored(palette().warning, "%s", running ? "being baked" : "needs a bake");
    ImGui::SameLine();
    ImGui::BeginDisabled(!view.bake.canBake || running);
    const char* explanation =
        running ? "A bake is running; see the Bake panel."
        : view.bake.canBake && !view.bake.lostColours.empty()
            ? "Bakes the source again with this chunk size, without its colours, since it is not known where "
              "their image lies: the Bake panel takes its name."
        : view.bake.canBake
            ? "Bakes the source again with this chunk size, while you fly on. The file in use is "
              "kept until the new one is whole."
            : "Cannot be baked: the source of this file is not known or no longer there. Open "
              "the elevation data itself to bake it.";
    if (button("Bake", explanation)) {
        BakeRequest request = view.bake.current;
        request.settings.chunkSize = wantedSize;
        commands.push_back(StartBake{request});
    }
    ImGui::EndDisabled();
}

void chunkSizeKnob(const EditorView& view, Commands& commands) {
    const int fileSize = planet::chunkSize(view.planet->shape());
    // What the user would like to have; 0 while that is what the file has.
    int* wanted = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("wantedChunkSize"), 0);
    if (*wanted == fileSize) *wanted = 0;
    const auto fileIndex = static_cast<int>(sizeIndex(fileSize));
    int index = *wanted == 0 ? fileIndex : static_cast<int>(sizeIndex(*wanted));
    if (choiceIndex("Chunk size", index, fileIndex,
                    "17 x 17\0"
                    "33 x 33\0"
                    "65 x 65\0"
                    "129 x 129\0",
                    "Vertices of a chunk, the same at every level; in the file, so another one needs a bake. "
                    "Larger: fewer, larger draws and reads, but more triangles than the tolerance asks for. "
                    "Smaller: a finer choice, but more chunks to select, queue and draw.")) {
        *wanted = index == fileIndex ? 0 : planet::chunkSizes[static_cast<std::size_t>(index)];
    }
    if (*wanted != 0) bakeOffer(view, *wanted, commands);
}

void formulas(const EditorView& view, double tauPx) {
    const double screenScale = planet::screenScalePx(view.lodView);
    const std::string formula = fmt::format("{} = delta_c K' / D     d_m = delta_c K", epsSymbol());
    ImGui::TextDisabled("%s", formula.c_str());
    tooltip(
        "Error on screen, pixels, of a chunk that lies D metres away; and the distance d_m, metres, nearer "
        "than which it must be replaced by its children. delta_c, metres: the chunk's error, from the bake.");
    if (!beginValues("formulas")) return;
    valueRow(
        "K' = W / (2 tan(Hfov/2))", fmt::format("{:.1f} px", screenScale),
        "W: the viewport's width in pixels; Hfov: the horizontal angle of view. A metre of error a metre "
        "away covers K' pixels.");
    valueRow(fmt::format("K = K' / {}", tauSymbol()).c_str(), fmt::format("{:.1f}", screenScale / tauPx),
             fmt::format("W / (2 {} tan(Hfov/2)): d_m = delta_c K.", tauSymbol()).c_str());
    valueRow("d_m of delta_c = 1 m", distanceText(screenScale / tauPx),
             "Within this distance a chunk whose error is one metre is split.");
    endValues();
}

void drawnValues(const EditorView& view, double tauPx) {
    const planet::SelectionCounters& s = view.stats.selection;
    if (!beginValues("drawn")) return;
    valueRow("Visited", countText(s.visited), "Nodes of the quadtrees that selection looked at.");
    valueRow("Culled", fmt::format("{} + {}", countText(s.culledFrustum), countText(s.culledHorizon)),
             "Subtrees left out: outside the view + below the horizon.");
    valueRow("Drawn", countText(s.drawn), "Chunks drawn.");
    valueRow("Waiting", countText(s.waiting),
             "Chunks drawn though over the tolerance: their children are not loaded.",
             s.waiting > 0 ? &palette().warning : nullptr);
    valueRow("Fading", countText(s.fading),
             "Chunks, and edges of chunks, that still slide after a change of level, or whose split or merge "
             "waits for that. Over 0 all the time: the camera, the tolerance or the disk is faster than the "
             "fade.");
    valueRow("Triangles", countText(static_cast<double>(view.stats.render.triangles)),
             "Triangles drawn, skirts included.");
    valueRow("Deepest level", fmt::format("{}", s.deepestLevel), "Of what is drawn; 0 is a whole cube face.");
    const bool over = static_cast<double>(s.worstEpsPx) > tauPx;
    valueRow(fmt::format("Worst {}", epsSymbol()).c_str(),
             s.worstEpsPx < 1000 ? fmt::format("{:.2f} px", s.worstEpsPx)
                                 : pixelsText(static_cast<double>(s.worstEpsPx)),
             "Largest predicted error on screen of what is drawn, pixels.",
             over ? &palette().warning : nullptr);
    endValues();
}

void levelBars(const planet::Planet& planet) {
    std::array<int, planet::maxLevel + 1> chunks{};
    for (const planet::DrawItem& item : planet.selection().draw) ++chunks[item.id.level];
    const double cells = planet::chunkCells(planet.shape());
    std::vector<Bar> bars;
    for (std::size_t level = 0; level < chunks.size(); ++level) {
        if (chunks[level] == 0) continue;
        const glm::vec3 c = levelColour(static_cast<int>(level));
        bars.push_back(
            {fmt::format("{}", level),
             static_cast<double>(chunks[level]),
             {c.r, c.g, c.b, 1},
             fmt::format("{}   {} tri", chunks[level], countText(chunks[level] * 2 * cells * cells))});
    }
    barList("levels", bars);
    tooltip("Chunks drawn by level, and their triangles without skirts. Level 0 is a whole cube face.");
}

void drawnPlots(const EditorView& view, double tauPx) {
    const std::vector<float> times = historyTimes(view.history);
    const std::array counts = {
        Series{"drawn", seriesColour(0),
               historyValues(view.history, [](const FrameStats& s) { return s.selection.drawn; })},
        Series{"visited", seriesColour(1),
               historyValues(view.history, [](const FrameStats& s) { return s.selection.visited; })}};
    linePlot("counts", times, counts, "");
    // A chunk that holds the eye has any error at all; the plot is about what comes near the tolerance.
    const auto top = static_cast<float>(16 * tauPx);
    const std::string name = fmt::format("worst {}, at most 16 {}", epsSymbol(), tauSymbol());
    const std::array errors = {
        Series{name.c_str(), seriesColour(3), historyValues(view.history, [top](const FrameStats& s) {
                   return std::min(s.selection.worstEpsPx, top);
               })}};
    linePlot("errors", times, errors, "px", 0, 3, false, tauPx);
}

// The chunks that flipped back last, newest first, each once.
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
    const planet::LodChanges& c = view.changes;
    const std::size_t thrashing = c.thrashRecent();
    if (beginValues("changes")) {
        valueRow("Splits", fmt::format("{:.0f} /s", c.splitsPerS()),
                 "Chunks replaced by their children, over the last second.");
        valueRow("Merges", fmt::format("{:.0f} /s", c.mergesPerS()),
                 "Chunks that took their children's place, over the last second.");
        valueRow(
            "Thrash, last 10 s", countText(static_cast<double>(thrashing)),
            "Chunks that flipped back within a second: work for nothing, and flicker. More hysteresis or "
            "a larger memory budget helps.",
            thrashing > 0 ? &palette().warning : nullptr);
        valueRow("Thrash, in all", countText(static_cast<double>(c.thrashTotal())),
                 "Since this planet was opened.");
        endValues();
    }
    const std::vector<planet::ChunkId> chunks = lastThrashing(c);
    if (chunks.empty()) return;
    ImGui::TextDisabled("Flipped back last:");
    for (const planet::ChunkId& id : chunks) chunkLink(id, view, commands);
}

}  // namespace

void lodPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    LodKnobs& lod = settings.lod;
    if (section("Level of detail")) {
        toleranceKnobs(lod);
        metricKnob(view, lod);
        cullingKnobs(view, lod, commands);
        if (view.planet) chunkSizeKnob(view, commands);
        formulas(view, lod.tauPx);
    }
    if (!view.planet) return emptyState("What is drawn shows here once a planet is open.");
    if (section("Drawn")) drawnValues(view, lod.tauPx);
    if (section("By level")) levelBars(*view.planet);
    if (section("Last 10 seconds")) drawnPlots(view, lod.tauPx);
    if (section("Changes of level")) changes(view, commands);
}

}  // namespace ui
