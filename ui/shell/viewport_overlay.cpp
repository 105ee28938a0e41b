#include "ui/shell/viewport_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/chunk_labels.h"
#include "ui/model/key_names.h"
#include "ui/model/overlay_legend.h"
#include "ui/model/paging_text.h"
#include "ui/shell/compare_overlay.h"
#include "ui/shell/note_pins.h"

namespace worldy::ui {

namespace {

// Returns hint lines, the longest first. The keys of commands are left out if the commands have none.
std::array<std::string, 3> helpLines() {
    const std::string keys = keyOf("keys");
    const std::string find = keyOf("palette");
    const auto last = [&](const char* meaning) { return keys.empty() ? "" : "   " + keys + ": " + meaning; };
    return {"Left drag: move   Right drag: look   Wheel: zoom   Click: select   W A S D E Q: fly" +
                (find.empty() ? "" : "   " + find + ": find") + last("all keys"),
            "Drag: move, look   Wheel: zoom   W A S D E Q: fly" + last("keys"),
            keys.empty() ? "" : keys + ": keys and mouse"};
}

// Returns the longest end of a text that fits, after an ellipsis.
std::string endThatFits(const std::string& text, float widthPx) {
    std::string shown = text;
    std::size_t start = 0;
    while (start < text.size() && ImGui::CalcTextSize(shown.c_str()).x > widthPx) {
        ++start;
        while (start < text.size() && (static_cast<unsigned char>(text[start]) & 0xC0u) == 0x80u) ++start;
        shown = "..." + text.substr(start);
    }
    return shown;
}

float marginPx() {
    return std::round(ImGui::GetFontSize() * 0.7f);
}

float badgeStepPx() {
    return std::round(ImGui::GetFontSize() * 1.8f);
}

struct LegendLayout {
    int rows = 0;
    int columns = 1;
    float rowPx = 0;
    float columnPx = 0;
    float padPx = 0;
    ImVec2 size{0, 0};
};

// Divides the legend into as many columns as the height requires.
LegendLayout layoutOf(const Legend& legend, float heightPx) {
    LegendLayout layout;
    if (legend.entries.empty()) return layout;
    const int count = static_cast<int>(legend.entries.size());
    layout.rowPx = std::round(ImGui::GetFontSize() * 1.25f);
    layout.padPx = std::round(ImGui::GetFontSize() * 0.5f);
    const int most = std::max(1, static_cast<int>((heightPx - 2 * layout.padPx) / layout.rowPx) - 1);
    layout.columns = (count + most - 1) / most;
    layout.rows = (count + layout.columns - 1) / layout.columns;
    float label = 0;
    for (const LegendEntry& entry : legend.entries) {
        label = std::max(label, ImGui::CalcTextSize(entry.label.c_str()).x);
    }
    layout.columnPx = 1.6f * layout.rowPx + label + layout.padPx;
    const float title = ImGui::CalcTextSize(legend.title.c_str()).x + layout.padPx;
    layout.size = {std::max(layout.columnPx * static_cast<float>(layout.columns), title) + layout.padPx,
                   layout.rowPx * static_cast<float>(layout.rows + 1) + 2 * layout.padPx};
    return layout;
}

// Draws the legend in the top right corner, one row per colour.
void drawLegend(ImDrawList& drawList, const Legend& legend, const LegendLayout& layout, const Rect& rect) {
    if (legend.entries.empty()) return;
    const ImVec2 start(rect.x, rect.y);
    drawList.AddRectFilled(start, {start.x + layout.size.x, start.y + layout.size.y}, boxColour(),
                           layout.padPx * 0.6f);
    drawList.AddText({start.x + layout.padPx, start.y + layout.padPx}, ImGui::GetColorU32(palette().dim),
                     legend.title.c_str());
    for (std::size_t i = 0; i < legend.entries.size(); ++i) {
        const int column = static_cast<int>(i) / layout.rows;
        const int row = static_cast<int>(i) % layout.rows;
        const ImVec2 at(start.x + layout.padPx + layout.columnPx * static_cast<float>(column),
                        start.y + layout.padPx + layout.rowPx * static_cast<float>(row + 1));
        drawList.AddRectFilled({at.x, at.y + 2}, {at.x + 1.2f * layout.rowPx, at.y + layout.rowPx - 3},
                               packed(legend.entries[i].colour), 2);
        drawList.AddText({at.x + 1.6f * layout.rowPx, at.y}, ImGui::GetColorU32(palette().text),
                         legend.entries[i].label.c_str());
    }
}

std::vector<Rect> fromCorner(std::vector<Rect> rects, const Rect& viewport) {
    for (Rect& rect : rects) {
        rect.x -= viewport.x;
        rect.y -= viewport.y;
    }
    return rects;
}

// A picture of the planet in which labels are placed.
struct Picture {
    const planet::View& through;
    std::size_t selection = 0;  // index of the planet view that chose the drawn chunks
    Rect rect;
    std::vector<Rect> taken;  // rectangles without labels, in the window
};

void drawLabels(ImDrawList& drawList, const planet::Planet* planet, const OverlaySettings& overlay,
                const Picture& picture) {
    if (!planet || overlay.labels == ChunkLabels::None) return;
    const float pad = std::round(ImGui::GetFontSize() * 0.2f);
    const auto textSize = [&](std::string_view text) {
        const ImVec2 size = ImGui::CalcTextSize(text.data(), text.data() + text.size());
        return glm::vec2(size.x + 2 * pad, size.y);
    };
    const ChunkLabelSettings wanted{.show = overlay.labels,
                                    .areaPx = {picture.rect.width, picture.rect.height},
                                    .gapPx = std::round(ImGui::GetFontSize() * 0.25f),
                                    .cube = overlay.cube,
                                    .taken = fromCorner(picture.taken, picture.rect)};
    const planet::Selection& drawn = planet->selection(picture.selection);
    for (const ChunkLabel& label :
         chunkLabels(picture.through, planet->tree(), drawn.draw, wanted, textSize)) {
        const ImVec2 at(picture.rect.x + label.topLeft.x, picture.rect.y + label.topLeft.y);
        drawList.AddRectFilled(at, {at.x + label.size.x, at.y + label.size.y}, boxColour(), pad);
        drawList.AddText({at.x + pad, at.y}, ImGui::GetColorU32(palette().text), label.text.c_str());
    }
}

struct PlacedBadge {
    ViewportBadge badge;
    Rect rect;
};

PlacedBadge placed(ViewportBadge badge, float x, float y) {
    const ImVec2 size = ImGui::CalcTextSize(badge.text.c_str());
    return {std::move(badge), {x, y, size.x + ImGui::GetFontSize(), badgeStepPx()}};
}

// Adds the hint line at the bottom; none if even the shortest does not fit.
void placeHelp(const Rect& viewport, std::vector<PlacedBadge>& badges) {
    const float room = viewport.width - 2 * marginPx() - ImGui::GetFontSize();
    for (const std::string& text : helpLines()) {
        if (text.empty() || ImGui::CalcTextSize(text.c_str()).x > room) continue;
        const float y = viewport.y + viewport.height - badgeStepPx() - marginPx() / 2;
        badges.push_back(placed({text, palette().dim}, viewport.x + marginPx(), y));
        return;
    }
}

// Places the badges in a column on the left; those that do not fit are left out.
std::vector<PlacedBadge> placeBadges(const EditorView& view, const ViewSettings& settings,
                                     const Rect& viewport, float widthPx, float bottomPx) {
    std::vector<PlacedBadge> column;
    float y = viewport.y + marginPx();
    const auto add = [&](const ViewportBadge& one) {
        if (y + badgeStepPx() > bottomPx) return;
        column.push_back(placed({endThatFits(one.text, widthPx), one.colour}, viewport.x + marginPx(), y));
        y += badgeStepPx();
    };
    if (!view.data.name.empty()) add({view.data.name, palette().text});
    for (const ViewportBadge& one : viewportBadges(view, settings)) add(one);
    return column;
}

void addPagingBadges(const EditorView& view, const ViewSettings& settings,
                     std::vector<ViewportBadge>& badges) {
    const planet::PagingCounters& paging = view.planet->paging();
    const std::uint32_t waiting = paging.queued + paging.loading;
    if (view.pagingPaused) {
        badges.push_back({waiting > 0 ? fmt::format("Paging paused, {} waiting", waiting) : "Paging paused",
                          palette().warning});
    }
    if (isBad(settings.paging.badDisk)) badges.push_back({"I/O fault injection", palette().warning});
    const std::uint32_t budgetWaits = paging[planet::BlockKind::Heights].budgetWaits;
    if (budgetWaits > 0)
        badges.push_back({fmt::format("Budget full, {} waiting", budgetWaits), palette().bad});
    if (!view.pagingPaused && waiting > 0)
        badges.push_back({fmt::format("Loading {}", waiting), palette().good});
}

bool showsMarks(const EditorView& view, const ViewSettings& settings) {
    return settings.cracks.mark && view.instruments.cracks.current && view.instruments.cracks.measured;
}

// Draws adjacent pixels as one rectangle, with a minimum size so that none is overlooked.
void drawCrackMarks(ImDrawList& drawList, const planet::gl::CrackMap& map, const Rect& viewport) {
    const float scale = viewport.width / static_cast<float>(std::max(map.widthPx, 1));
    const float rim = std::max(0.0f, (ImGui::GetFontSize() * 0.2f - scale) / 2);
    for (std::size_t i = 0; i < map.pixels.size();) {
        const planet::CrackPixel& first = map.pixels[i];
        int count = 0;
        const auto goesOn = [&](const planet::CrackPixel& pixel) {
            return pixel.y == first.y && pixel.x == first.x + count && pixel.leaks == first.leaks;
        };
        while (i < map.pixels.size() && goesOn(map.pixels[i])) ++i, ++count;
        const ImVec2 from(viewport.x + scale * static_cast<float>(first.x) - rim,
                          viewport.y + scale * static_cast<float>(first.y) - rim);
        const ImVec2 to(viewport.x + scale * static_cast<float>(first.x + count) + rim,
                        viewport.y + scale * static_cast<float>(first.y + 1) + rim);
        drawList.AddRectFilled(from, to, packed(first.leaks ? palette().bad : palette().warning));
    }
}

// Names the ends of the ruler above their posts.
void drawRulerNames(ImDrawList& drawList, const EditorView& view, const Rect& viewport) {
    const float scale = viewport.width / static_cast<float>(std::max(view.camera.renderView.widthPx, 1));
    const std::vector<RulerEndInPicture>& ends = view.instruments.ruler.inPicture;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (!ends[i].atPx) continue;
        constexpr double postPx = 24;
        const glm::vec2 at(*ends[i].atPx - glm::dvec2(0, postPx));
        const char* name = i == 0 ? "A" : "B";
        badge(drawList,
              {viewport.x + scale * at.x - ImGui::CalcTextSize(name).x,
               viewport.y + scale * at.y - badgeStepPx()},
              name, palette().warning);
    }
}

// Only the source of A is read.
Legend legendFor(const planet::Planet* planet, const OverlaySettings& overlay,
                 const planet::SourceLayers* layers = nullptr, const AtlasDrape* atlas = nullptr) {
    if (!planet) return {};
    // The levels of all views count, because an observer with its own LOD may draw finer chunks.
    std::uint32_t deepest = 0;
    for (std::size_t view = 0; view < planet->views().size(); ++view)
        deepest = std::max(deepest, planet->selection(view).counters.deepestLevel);
    LegendFacts facts{.shape = planet->tree().shape};
    if (layers && overlay.colourBy == ColourBy::Source) {
        for (const planet::SourceLayer& layer : layers->layers) facts.layers.push_back(layer.name);
    }
    facts.regions = legendRegions(*planet);
    facts.atlas = atlas;
    return legendOf(overlay, planet->views()[0].input.lod.tauPx, deepest, facts);
}

// Returns the legend. While comparing it is A's, or B's if only B's chunks are tinted.
Legend shownLegend(const EditorView& view, const OverlaySettings& overlay) {
    Legend legend = legendFor(view.planet, overlay, view.sources.layers, view.instruments.atlas.drape);
    if (!view.compare.on) return legend;
    const bool ofA = !legend.entries.empty();
    if (!ofA) legend = legendFor(view.compare.planetB, view.compare.settingsB->overlay);
    legend.title = (ofA ? "A: " : "B: ") + legend.title;
    return legend;
}

void pushClip(const Rect& rect) {
    ImGui::PushClipRect({rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height}, true);
}

// Returns "Paused (F5), step: F6", without the keys that commands do not have.
std::string pausedText() {
    const std::string step = keyOf("step_frame");
    return withKey("Paused", "pause_frames") + (step.empty() ? "" : ", step: " + step);
}

}  // namespace

std::vector<ViewportBadge> viewportBadges(const EditorView& view, const ViewSettings& settings) {
    std::vector<ViewportBadge> badges;
    if (view.data.isReadingColourImage) {
        badges.push_back({"Reading the colour image: height ramp drawn", palette().warning});
    } else if (view.frames.stats.render.standIn) {
        const bool firstAir = view.instruments.light.air.working && view.instruments.light.air.tablesMs == 0;
        badges.push_back({firstAir ? "Computing the atmosphere: analytic model drawn"
                                   : "Compiling shaders; stand-in shaders used",
                          palette().warning});
    }
    if (view.frames.paused) badges.push_back({pausedText(), palette().warning});
    if (view.camera.lodFrozen) badges.push_back({withKey("LOD frozen", "freeze_lod"), palette().warning});
    if (view.data.showsPreviousBake) badges.push_back({"Previous bake", palette().warning});
    if (view.instruments.pops.side != PopSide::Live && view.instruments.pops.problem.empty())
        badges.push_back({view.instruments.pops.side == PopSide::Before ? "Before the level change"
                                                                        : "After the level change",
                          palette().warning});
    if (view.planet) addPagingBadges(view, settings, badges);
    if (showsMarks(view, settings)) {
        const planet::gl::CrackMap& map = view.instruments.cracks.measured->map;
        const auto leaking = static_cast<std::size_t>(map.leaking);
        if (leaking > 0) badges.push_back({fmt::format("Uncovered pixels: {}", leaking), palette().bad});
        if (map.pixels.size() > leaking) {
            badges.push_back({fmt::format("Crack pixels covered by skirts: {}", map.pixels.size() - leaking),
                              palette().warning});
        }
        if (map.pixels.empty()) badges.push_back({"No cracks", palette().good});
    }
    if (settings.overlay.wireframe) badges.push_back({withKey("Wireframe", "wireframe"), palette().accent});
    if (settings.overlay.cube) badges.push_back({withKey("Unprojected cube", "cube"), palette().accent});
    if (settings.surface.exaggeration != 1)
        badges.push_back(
            {fmt::format("Exaggeration {:.3g} x", settings.surface.exaggeration), palette().accent});
    return badges;
}

void viewportPicture(ImTextureID picture, const Rect& viewport) {
    ImGui::InvisibleButton("picture", {viewport.width, viewport.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const ImVec2 end(viewport.x + viewport.width, viewport.y + viewport.height);
    ImGui::GetWindowDrawList()->AddImage(picture, {viewport.x, viewport.y}, end, {0, 1}, {1, 0});
}

void viewportOverlay(const EditorView& view, const ViewSettings& settings, const Rect& viewport) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    ImGui::PushClipRect({viewport.x, viewport.y}, {viewport.x + viewport.width, viewport.y + viewport.height},
                        true);
    const std::vector<ShownPart> parts = shownParts(view.compare, settings.compare, viewport);
    for (const ShownPart& one : parts) {
        if (one.isB || !showsMarks(view, settings)) continue;
        pushClip(one.part);
        drawCrackMarks(drawList, view.instruments.cracks.measured->map, one.whole);
        ImGui::PopClipRect();
    }
    const Legend legend = shownLegend(view, settings.overlay);
    const bool hasHelp = viewport.height > 9 * badgeStepPx();
    const float bottom = viewport.y + viewport.height - (hasHelp ? badgeStepPx() + marginPx() : marginPx());
    const LegendLayout layout = layoutOf(legend, bottom - viewport.y - marginPx());
    const float besideLegend = viewport.width - layout.size.x - 3 * marginPx() - ImGui::GetFontSize();
    std::vector<PlacedBadge> badges = placeBadges(view, settings, viewport, besideLegend, bottom);
    if (hasHelp) placeHelp(viewport, badges);
    std::vector<Rect> taken = {{viewport.x + viewport.width - marginPx() - layout.size.x,
                                viewport.y + marginPx(), layout.size.x, layout.size.y}};
    for (const PlacedBadge& one : badges) taken.push_back(one.rect);
    for (const ShownPart& one : parts) {
        pushClip(one.part);
        drawLabels(drawList, one.isB ? view.compare.planetB : view.planet,
                   one.isB ? view.compare.settingsB->overlay : settings.overlay,
                   {view.camera.renderView, 0, one.whole, taken});
        ImGui::PopClipRect();
    }
    drawRulerNames(drawList, view, viewport);
    drawNotePins(view, settings, viewport);
    compareOverlay(view.compare, settings.compare, viewport);
    drawLegend(drawList, legend, layout, taken.front());
    for (const PlacedBadge& one : badges) {
        badge(drawList, {one.rect.x, one.rect.y}, one.badge.text.c_str(), one.badge.colour);
    }
    ImGui::PopClipRect();
}

void observerOverlay(const EditorView& view, const ViewSettings& settings, const planet::View& observer,
                     const Rect& viewport) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    ImGui::PushClipRect({viewport.x, viewport.y}, {viewport.x + viewport.width, viewport.y + viewport.height},
                        true);
    const PlacedBadge name =
        placed({settings.camera.observerOwnLod ? "Observer, own LOD" : "Observer", palette().accent},
               viewport.x + marginPx(), viewport.y + marginPx());
    const bool ownSelection =
        settings.camera.observerOwnLod && view.planet && view.planet->views().size() > 1;
    drawLabels(drawList, view.planet, settings.overlay,
               {observer, ownSelection ? std::size_t{1} : std::size_t{0}, viewport, {name.rect}});
    badge(drawList, {name.rect.x, name.rect.y}, name.badge.text.c_str(), name.badge.colour);
    ImGui::PopClipRect();
}

}  // namespace worldy::ui
