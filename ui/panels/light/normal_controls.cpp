#include "ui/panels/light/normal_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include "app/base/text.h"
#include "planet/paging/normal_tile.h"
#include "planet/planet_tools.h"
#include "ui/kit/feature_control.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

// Returns the mean load time of recent tiles, milliseconds per tile; 0 if none were loaded lately.
double msATile(const planet::Planet& planet) {
    double seconds = 0;
    int blocks = 0;
    for (const planet::PagingEvent& event : planet.inspect().pagingHistory()) {
        if (event.kind != planet::BlockKind::Normals || event.outcome != planet::PagingOutcome::Loaded)
            continue;
        seconds += event.readS;
        ++blocks;
    }
    return blocks > 0 ? 1000 * seconds / (planet::quadrantCount * blocks) : 0;
}

void figures(const planet::Planet& planet) {
    const planet::TileCounters& seen = planet.views()[0].normals.counters;
    const planet::BlockCounters& paging = planet.paging()[planet::BlockKind::Normals];
    if (!beginValues("normals")) return;
    valueRow("Tiles", fmt::format("{} of {}", paging.resident, paging.capacity),
             "Resident tiles and the number that fits into their share of the budget.");
    valueRow(
        "Memory", bytesText(static_cast<double>(paging.capacity * planet::normalTileBytes)),
        "GPU memory for that many tiles of 272 x 272 slopes, 4 bytes each. Nothing is stored in the file.");
    valueRow(
        "Finest level",
        fmt::format("{} of {}", seen.deepestLevel, planet::normalLeafLevel(planet.tree().storedShape)),
        "Finest level of the tiles in view, and of the heights; level l has 256 x 2^l cells along a face.");
    const double perTileMs = msATile(planet);
    valueRow("Time per tile", perTileMs > 0 ? millisecondsText(perTileMs) : "-",
             "Loader thread time to read and decode heights and derive slopes: mean of the tiles among the "
             "last 1000 requests.");
    valueRow("Waiting", fmt::format("{}", seen.waiting), "Tiles in view that are coarser than requested.");
    endValues();
}

// Says why there are no figures.
void whyNone(const EditorView& view) {
    if (planet::normalLeafLevel(view.planet->tree().storedShape) < 0) {
        ImGui::TextDisabled("None: this planet's faces have fewer");
        ImGui::TextDisabled("than 256 cells; the mesh is enough.");
    } else if (view.planet->inspect().normalsArePending()) {
        ImGui::TextDisabled("Deriving the coarsest tiles;");
        ImGui::TextDisabled("mesh normals are drawn.");
    } else if (view.planet->pagingSettings().normals) {
        ImGui::TextDisabled("None: share too small. Increase the");
        ImGui::TextDisabled("share, or the paging budget.");
    }
}

}  // namespace

void normalControls(const EditorView& view, const SettingControls& control, ViewSettings& settings,
                    Commands& commands) {
    planet::gl::NormalDrawing& normals = settings.surface.light.normals;
    beginGrey(!settings.surface.lighting, "Turn on Lighting first.");
    featureControl(control, CostlyPart::Normals, view, settings.surface, commands);
    beginGrey(normals.use == planet::gl::FeatureUse::Off, "Fine normals are off.");
    control(normals.texelsPerPixel);
    control(settings.paging.normalShare);
    endGrey();
    endGrey();
    if (!view.planet) return;
    if (view.planet->paging()[planet::BlockKind::Normals].capacity > 0)
        figures(*view.planet);
    else
        whyNone(view);
}

}  // namespace worldy::ui
