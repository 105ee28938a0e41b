#include "ui/normal_knobs.h"

#include <fmt/format.h>
#include <imgui.h>

#include "planet/normal_tile.h"
#include "ui/feature_knob.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace ui {

namespace {

// Milliseconds a tile of the blocks that loaders derived last; 0: none lately.
double msATile(const planet::Planet& planet) {
    double seconds = 0;
    int blocks = 0;
    for (const planet::PagingEvent& event : planet.pagingHistory()) {
        if (event.kind != planet::BlockKind::Normals || event.outcome != planet::PagingOutcome::Loaded)
            continue;
        seconds += event.readS;
        ++blocks;
    }
    return blocks > 0 ? 1000 * seconds / (planet::quadrantCount * blocks) : 0;
}

void figures(const planet::Planet& planet) {
    const planet::TileCounters& seen = planet.normalSelection().counters;
    const planet::TilePagingCounters& paging = planet.normalPaging();
    if (!beginValues("normals")) return;
    valueRow("Tiles", fmt::format("{} of {}", paging.residentTiles, paging.tileCapacity),
             "Resident, of those that their share of the budget has room for.");
    valueRow("Memory", bytesText(static_cast<double>(paging.tileCapacity * planet::normalTileBytes)),
             "On the GPU, for that many tiles of 272 x 272 slopes, 4 bytes each. No room in the file.");
    valueRow("Finest level", fmt::format("{} of {}", seen.deepestLevel, planet.normalLeafLevel()),
             "Of the tiles in view, and of the heights: level l has 256 x 2^l cells along a face.");
    const double perTileMs = msATile(planet);
    valueRow("A tile takes", perTileMs > 0 ? millisecondsText(perTileMs) : "-",
             "Of a loader thread, to read and decode the heights under it and derive its slopes: the mean "
             "of those among the last 1000 requests.");
    valueRow("Waiting", fmt::format("{}", seen.waiting), "Tiles in view that are coarser than wanted.");
    endValues();
}

// In place of the figures, where there are none.
void whyNone(const EditorView& view) {
    if (view.planet->normalLeafLevel() < 0) {
        ImGui::TextDisabled("None: this planet's faces have fewer");
        ImGui::TextDisabled("than 256 cells. The mesh shows all.");
    } else if (view.planet->pagingSettings().normals) {
        ImGui::TextDisabled("None: too little room. Raise their");
        ImGui::TextDisabled("share, or the budget in Paging.");
    }
}

}  // namespace

void normalKnobs(const EditorView& view, ViewSettings& settings, Commands& commands) {
    const ViewSettings defaults;
    planet::gl::NormalDrawing& normals = settings.surface.light.normals;
    ImGui::BeginDisabled(!settings.surface.lighting);
    featureKnob("Fine normals", CostlyPart::Normals, view, settings.surface, commands,
                "Chunks drawn with few vertices are lit by the slopes of the finest heights, as far as the "
                "screen shows them, in tiles that are derived from the file's own heights. Off: by their "
                "vertices' normals, smooth where the mesh is coarse; no memory is taken.",
                "fine normals cost");
    ImGui::BeginDisabled(normals.use == planet::gl::FeatureUse::Off);
    slider("Texels a pixel", normals.texelsPerPixel, defaults.surface.light.normals.texelsPerPixel, 0.1, 4,
           "%.2f",
           "A tile is derived in four finer ones while it has fewer texels than this for a pixel of the "
           "picture. Larger: sharper, up to four times the tiles for twice as many, and it may shimmer. "
           "Smaller: softer.",
           ImGuiSliderFlags_Logarithmic);
    slider("Share", settings.paging.normalShare, defaults.paging.normalShare, 0.01, 0.9, "%.2f",
           "Of what colours leave of the paging budget. Larger: finer light on coarse chunks; smaller: "
           "finer ground when the budget is full.");
    ImGui::EndDisabled();
    ImGui::EndDisabled();
    if (!view.planet) return;
    if (view.planet->normalPaging().tileCapacity > 0)
        figures(*view.planet);
    else
        whyNone(view);
}

}  // namespace ui
