#include "ui/panels/lod/seams_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "app/base/text.h"
#include "planet/base/percentile.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/plots.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

void seamControls(ViewSettings& settings) {
    const SettingControls control(settings);
    planet::LodSettings& lod = settings.lod;
    control(lod.seams);
    if (lod.seams == planet::SeamMode::Skirts) {
        control(lod.skirtDepth);
        if (lod.skirtDepth == planet::SkirtDepth::Automatic)
            control(lod.skirtFactor);
        else
            control(lod.skirtDepthM);
    }
    control(settings.overlay.lodSeams);
}

// The largest and the median depth of the drawn chunks, metres.
struct Depths {
    float largestM = 0;
    float medianM = 0;
};
Depths drawnDepths(std::span<const planet::DrawItem> items) {
    std::vector<float> depths;
    depths.reserve(items.size());
    for (const planet::DrawItem& item : items) depths.push_back(item.skirtDepthM);
    if (depths.empty()) return {};
    return {*std::max_element(depths.begin(), depths.end()), planet::percentileOf(depths, 0.5)};
}

int difference(const planet::LevelSeam& seam) {
    return seam.finer.level - seam.coarser.level;
}

void values(const planet::Selection& selection) {
    if (!beginValues("seams")) return;
    const Depths depths = drawnDepths(selection.draw);
    valueRow("Deepest skirt", distanceText(static_cast<double>(depths.largestM)),
             "Skirt depth of the drawn chunks, in metres.");
    valueRow("Median skirt", distanceText(static_cast<double>(depths.medianM)),
             "Skirt depth of the drawn chunks, in metres.");
    valueRow("LOD seams", countText(static_cast<double>(selection.seams.size())),
             "Number of pairs of adjacent drawn chunks with different levels.");
    valueRow("Max level difference", fmt::format("{}", selection.counters.widestSeam),
             "Largest level difference of two drawn neighbours. The finer chunk's edge has 2^difference "
             "times as many vertices as the coarser one's.");
    endValues();
}

void differenceBars(std::span<const planet::LevelSeam> seams) {
    std::array<int, planet::maxLevel + 1> counts{};
    for (const planet::LevelSeam& seam : seams) ++counts[static_cast<std::size_t>(difference(seam))];
    std::vector<Bar> bars;
    for (std::size_t levels = 1; levels < counts.size(); ++levels) {
        if (counts[levels] == 0) continue;
        const ImVec4& colour = levels == 1 ? palette().good : levels == 2 ? palette().warning : palette().bad;
        bars.push_back({fmt::format("{} level{}", levels, levels == 1 ? "" : "s"),
                        static_cast<double>(counts[levels]), colour, fmt::format("{}", counts[levels])});
    }
    barList("level differences", bars, "seams");
    tooltip("LOD seams by level difference.");
}

const char* edgeName(planet::Edge edge) {
    constexpr std::array names = {"west", "east", "south", "north"};
    return names[static_cast<std::size_t>(edge)];
}

void seamRow(const planet::LevelSeam& seam, const EditorView& view, Commands& commands) {
    cell(fmt::format("{}", difference(seam)));
    cell(edgeName(seam.edge));
    chunkCell(seam.finer, view, commands);
    chunkLink(seam.coarser, view, commands);
}

// Draws the widest level difference first, then by id. Only the visible rows are sorted.
void seamTable(const EditorView& view, std::span<const planet::LevelSeam> seams, Commands& commands) {
    const std::string chunk = widestChunkName(view);
    const std::array columns = {TableColumn{"Levels", 0.5f, "Level difference."},
                                TableColumn{"Edge", 0.5f, "Edge of the finer chunk.", "south"},
                                TableColumn{"Finer, coarser", 2, nullptr, chunk.c_str()}};
    if (!beginListTable("pairs", columns, 2 * seams.size(), 15)) return;
    std::vector<const planet::LevelSeam*> order;
    order.reserve(seams.size());
    for (const planet::LevelSeam& seam : seams) order.push_back(&seam);
    const auto wider = [](const planet::LevelSeam* a, const planet::LevelSeam* b) {
        return std::make_tuple(-difference(*a), a->finer, a->edge, a->coarser) <
               std::make_tuple(-difference(*b), b->finer, b->edge, b->coarser);
    };
    if (chosenSort()) {
        const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
            const planet::LevelSeam& seam = seams[row];
            if (column == 0) return static_cast<double>(difference(seam));
            if (column == 1) return std::string(edgeName(seam.edge));
            return sortKey(seam.finer);
        };
        std::vector<const planet::LevelSeam*> sorted;
        for (const std::size_t row : tableOrder(seams.size(), chosenSort(), key))
            sorted.push_back(&seams[row]);
        order = std::move(sorted);
        tableRows(order.size(), [&](std::size_t row) { seamRow(*order[row], view, commands); });
    } else {
        sortedTableRows(order, wider,
                        [&](const planet::LevelSeam* seam, std::size_t) { seamRow(*seam, view, commands); });
    }
    using Seam = planet::LevelSeam;
    ExportTable table =
        exportTable<Seam>("LOD seams", order.size(), [&](std::size_t row) { return *order[row]; },
                          {{"level_difference", difference},
                           {"edge", [](const Seam& seam) { return edgeName(seam.edge); }, true},
                           {"finer", [](const Seam& seam) { return toString(seam.finer); }, true},
                           {"coarser", [](const Seam& seam) { return toString(seam.coarser); }, true}});
    if (!chosenSort()) table.sortAll = [&] { std::sort(order.begin(), order.end(), wider); };
    endTable(table);
}

}  // namespace

void seamsPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    if (section("Seams")) seamControls(settings);
    if (!view.planet) return emptyState("No planet is open. Open one to see its LOD seams.");
    const planet::Selection& selection = view.planet->selection();
    if (section("Drawn now")) {
        values(selection);
        differenceBars(selection.seams);
    }
    if (!section("LOD seams")) return;
    if (selection.seams.empty())
        return emptyState("All drawn neighbours have the same level: there are no seams.");
    seamTable(view, selection.seams, commands);
}

}  // namespace worldy::ui
