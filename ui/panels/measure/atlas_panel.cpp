#include "ui/panels/measure/atlas_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/measure/atlas_table.h"
#include "app/scene/atlas_drape.h"
#include "app/scene/overlay_colours.h"
#include "app/settings/view_settings.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"
#include "planet/sphere/chunk_id.h"
#include "ui/kit/columns.h"
#include "ui/kit/item_map.h"
#include "ui/kit/legend_rows.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/net_cells.h"
#include "ui/model/overlay_legend.h"
#include "ui/model/plan_view.h"

namespace worldy::ui {

namespace {

using planet::AtlasMeasure;
using planet::AtlasViewpoint;

constexpr std::size_t atlasWorstListed = 50;
constexpr std::size_t atlasBuckets = 32;

const AtlasView& atlasOf(const EditorView& view) {
    return view.instruments.atlas;
}

void atlasSurveyControls(const EditorView& view, AtlasPanelState& state, Commands& commands) {
    const AtlasView& atlas = atlasOf(view);
    if (button("Open...", "Opens an atlas that worldy atlas or this panel has written."))
        commands.push_back(AskForFile{});
    if (atlas.running) {
        sameLineForButton("Cancel");
        beginGrey(atlas.cancelling, "The survey is ending.");
        if (button("Cancel", "Ends the survey and discards it.")) commands.push_back(CancelAtlas{});
        endGrey();
        const double share = atlas.progress ? static_cast<double>(atlas.progress->done) /
                                                  static_cast<double>(atlas.progress->total)
                                            : 0;
        const std::string text =
            atlas.progress ? fmt::format("{} of {} viewpoints", atlas.progress->done, atlas.progress->total)
                           : std::string("reading chunks");
        ImGui::ProgressBar(static_cast<float>(share), {-1, 0}, text.c_str());
    } else {
        sameLineForButton("Survey");
        beginGrey(!view.planet, "No planet is open.");
        if (button(
                "Survey",
                "Surveys the open planet in the background with the current settings, 4 headings, and 200 m, "
                "5 km and 50 km above the ground. The atlas is saved beside the screenshots. worldy atlas "
                "has more options, and can be interrupted."))
            commands.push_back(StartAtlas{static_cast<std::uint64_t>(state.viewpoints), state.measuresError});
        endGrey();
        slider("Viewpoints", state.viewpoints, 1000, 72, 20'000, "%d",
               "Most viewpoints of the next survey. Where the planet differs most, they are closest.",
               ImGuiSliderFlags_Logarithmic);
        checkbox("True error", state.measuresError, false,
                 "Also measures the true error, which takes about a hundred times as long.");
    }
    if (!atlas.problem.empty()) wrappedText(atlas.problem, palette().warning);
}

// Returns the measures that the atlas has.
std::vector<AtlasMeasure> atlasMeasuresOf(const planet::Atlas& atlas) {
    std::vector<AtlasMeasure> measures;
    for (const AtlasSpread& one : spreadsOf(atlas.viewpoints)) measures.push_back(one.measure);
    return measures;
}

void atlasChoiceControls(const AtlasView& atlas, ViewSettings& settings, Commands& commands) {
    const std::vector<AtlasMeasure> measures = atlasMeasuresOf(*atlas.atlas);
    std::string names;
    int index = 0;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        names += std::string(planet::textOf(measures[i]).name) + '\0';
        if (measures[i] == atlas.drape->measure) index = static_cast<int>(i);
    }
    bool changed = choiceIndex("Measure", index, index, names.c_str(),
                               planet::textOf(atlas.drape->measure).meaning.data());
    std::string altitudes;
    for (const double altitudeM : atlas.atlas->survey.grid.altitudesM)
        altitudes += distanceText(altitudeM) + '\0';
    int altitude = atlas.altitude;
    changed |= choiceIndex("Altitude", altitude, altitude, altitudes.c_str(),
                           "Altitude of the viewpoints above the ground or a drawn sea.");
    if (changed && !measures.empty())
        commands.push_back(ChooseAtlas{measures[static_cast<std::size_t>(index)], altitude});
    bool tint = settings.overlay.colourBy == ColourBy::Atlas;
    if (ImGui::Checkbox("Tint planet", &tint))
        settings.overlay.colourBy = tint ? ColourBy::Atlas : ColourBy::None;
    noteItem("Tint planet");
    tooltip(
        "Tints the planet by the measure, like Colour by in the Overlay panel. Cells that are smaller than "
        "the drawn "
        "chunks are hatched. The Quadtree panel can show the measure too; there, a chunk that several cells "
        "cover has "
        "the colour of the largest value.");
}

void aboutAtlas(const AtlasView& atlas) {
    const planet::Atlas& all = *atlas.atlas;
    wrappedText(fmt::format("{}: {} viewpoints{}", atlas.name, all.viewpoints.size(),
                            all.isFinished ? "" : ", unfinished"),
                palette().dim);
    if (!atlas.otherBake.empty()) wrappedText(atlas.otherBake, palette().warning);
    for (const AtlasSpread& one : spreadsOf(all.viewpoints)) {
        if (one.measure != atlas.drape->measure) continue;
        if (!beginValues("atlas spread")) return;
        const char* const all_ = "Over all viewpoints and altitudes.";
        valueRow("Median", figureText(one.measure, one.median), all_);
        valueRow("P90", figureText(one.measure, one.p90), all_);
        valueRow("P99", figureText(one.measure, one.p99), all_);
        valueRow("Maximum", figureText(one.measure, one.most), all_);
        endValues();
    }
}

// The map.

struct AtlasMapSquare {
    ImVec2 start, end;
};
AtlasMapSquare mapSquareOf(const planet::ChunkId& cell, const PlanPlacement& placement) {
    const NetSquare square = netSquare(cell);
    const PlanPoint from = onScreen(placement, {square.x, square.y});
    const PlanPoint to = onScreen(placement, {square.x + square.side, square.y + square.side});
    return {{static_cast<float>(from.x), static_cast<float>(from.y)},
            {static_cast<float>(to.x), static_cast<float>(to.y)}};
}

// Returns the viewpoint of a cell with the largest value of the shown measure.
std::optional<std::size_t> worstViewpointOf(const AtlasView& atlas, const planet::AtlasCell& cell) {
    std::optional<std::size_t> worst;
    const std::vector<AtlasViewpoint>& all = atlas.atlas->viewpoints;
    const auto value = [&](std::size_t i) { return planet::figureOf(all[i].figures, atlas.drape->measure); };
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].place.cell != cell.cell || all[i].place.altitude != cell.altitude || std::isnan(value(i)))
            continue;
        if (!worst || value(i) > value(*worst)) worst = i;
    }
    return worst;
}

void lookFromViewpoint(AtlasPanelState& state, std::size_t viewpoint, Commands& commands) {
    state.shown = viewpoint;
    commands.push_back(LookFromAtlas{viewpoint});
}

void tellAtlasCell(const AtlasView& atlas, const planet::AtlasCell& cell, AtlasPanelState& state,
                   Commands& commands) {
    const std::optional<std::size_t> worst = worstViewpointOf(atlas, cell);
    if (!worst) return;
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(viewpointText(atlas.atlas->survey, atlas.atlas->viewpoints[*worst]).c_str());
    for (const AtlasMeasure measure : atlasMeasuresOf(*atlas.atlas)) {
        const double value = planet::figureOf(atlas.atlas->viewpoints[*worst].figures, measure);
        ImGui::Text("%s %s", std::string(planet::textOf(measure).name).c_str(),
                    figureText(measure, value).c_str());
    }
    ImGui::TextDisabled("the worst heading   click: fly there with the settings of the survey");
    ImGui::EndTooltip();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) lookFromViewpoint(state, *worst, commands);
}

void atlasMap(const AtlasView& atlas, AtlasPanelState& state, Commands& commands) {
    legendRows(legendOf(*atlas.drape));
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float width = std::max(room.x, 4 * ImGui::GetFontSize());
    const float wanted = width * netRows / netColumns;
    const float height = room.y > 6 * ImGui::GetFontSize() ? std::min(wanted, room.y) : wanted;
    const ImVec2 start = ImGui::GetCursorScreenPos();
    plotItem("atlas map", {width, height});
    noteItem("atlas map");
    const bool hovered = plotIsHovered();
    const Rect area{start.x, start.y, width, height};
    const PlanPlacement placement = placementOf(netSize, {}, area);
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const planet::AtlasCell* told = nullptr;
    for (const planet::AtlasCell& cell : atlas.cells) {
        const double value = planet::figureOf(cell.values, atlas.drape->measure);
        if (cell.altitude != atlas.altitude || std::isnan(value)) continue;
        const AtlasMapSquare square = mapSquareOf(cell.cell, placement);
        const float gap = square.end.x - square.start.x > 6 ? 1.0f : 0.0f;
        drawList.AddRectFilled(square.start, {square.end.x - gap, square.end.y - gap},
                               packedColour(rampColour(shareOf(*atlas.drape, value))));
        if (hovered && pointer.x >= square.start.x && pointer.x < square.end.x &&
            pointer.y >= square.start.y && pointer.y < square.end.y)
            told = &cell;
    }
    if (state.shown && *state.shown < atlas.atlas->viewpoints.size()) {
        const AtlasMapSquare square =
            mapSquareOf(atlas.atlas->viewpoints[*state.shown].place.cell, placement);
        drawList.AddRect(square.start, square.end, packed(palette().warning), 0, 0, 2);
    }
    if (!told) return;
    const AtlasMapSquare square = mapSquareOf(told->cell, placement);
    drawList.AddRect(square.start, square.end, packed(palette().text), 0, 0, 2);
    tellAtlasCell(atlas, *told, state, commands);
}

// The distribution.

void atlasDistribution(const AtlasView& atlas) {
    std::vector<float> counts(atlasBuckets);
    for (const planet::AtlasCell& cell : atlas.cells) {
        const double value = planet::figureOf(cell.values, atlas.drape->measure);
        if (cell.altitude != atlas.altitude || std::isnan(value)) continue;
        const double share = shareOf(*atlas.drape, value);
        ++counts[std::min(static_cast<std::size_t>(share * atlasBuckets), atlasBuckets - 1)];
    }
    const auto text = [&](double share) {
        return figureText(atlas.drape->measure, valueOf(*atlas.drape, share));
    };
    const Legend legend = legendOf(*atlas.drape);
    histogram("atlas histogram", counts, text(0), legend.entries.back().label, {}, 4, text);
    tooltip(
        "Cells of this altitude by the measure of their worst heading. Values above the 99th percentile are "
        "in "
        "the last bucket.");
}

constexpr std::array atlasWorstColumns = {
    TableColumn{"##go", 0.1f, nullptr, "Go xx"},
    TableColumn{"Value", 0.8f, "The chosen measure.", "1.86e+09 px"},
    TableColumn{"Place", 1.4f, "Latitude and longitude.", "88.88\u00b0 N 188.88\u00b0 W"},
    TableColumn{"Altitude", 0.7f, "Above the ground or a drawn sea.", "50.0 km"},
    TableColumn{"Heading", 0.7f, "Clockwise from north.", "270\u00b0"},
};

void atlasWorstList(const AtlasView& atlas, AtlasPanelState& state, Commands& commands) {
    const planet::Atlas& all = *atlas.atlas;
    const std::vector<std::size_t> worst =
        worstViewpoints(all.viewpoints, atlas.drape->measure, atlasWorstListed);
    if (!beginWideTable("atlas worst", atlasWorstColumns, 1)) return;
    const auto viewpointOf = [&](std::size_t row) -> const AtlasViewpoint& {
        return all.viewpoints[worst[row]];
    };
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const AtlasViewpoint& one = viewpointOf(row);
        switch (column) {
            case 2:
                return planet::poseOf(all.survey, one).latitudeDeg;
            case 3:
                return all.survey.grid.altitudesM[one.place.altitude];
            case 4:
                return static_cast<double>(one.place.heading);
            default:
                return planet::figureOf(one.figures, atlas.drape->measure);
        }
    };
    tableRows(worst.size(), key, [&](std::size_t row) {
        const AtlasViewpoint& one = viewpointOf(row);
        const planet::CameraPose pose = planet::poseOf(all.survey, one);
        ImGui::TableNextColumn();
        if (ImGui::SmallButton("Go")) lookFromViewpoint(state, worst[row], commands);
        noteItem(fmt::format("Go {}", row));
        tooltip("Flies to the viewpoint with the settings of the survey. Undo brings the settings back.");
        cell(figureText(atlas.drape->measure, planet::figureOf(one.figures, atlas.drape->measure)));
        cell(placeText(pose.latitudeDeg, pose.longitudeDeg, 2));
        cell(distanceText(all.survey.grid.altitudesM[one.place.altitude]));
        cell(fmt::format("{:.0f}\u00b0", pose.headingDeg));
    });
    using V = AtlasViewpoint;
    const planet::AtlasSurvey& survey = all.survey;
    std::vector<ExportField<V>> fields = {
        {"latitude_deg", [&survey](const V& v) { return planet::poseOf(survey, v).latitudeDeg; }, true},
        {"longitude_deg", [&survey](const V& v) { return planet::poseOf(survey, v).longitudeDeg; }, true},
        {"above_ground_m", [&survey](const V& v) { return survey.grid.altitudesM[v.place.altitude]; }, true},
        {"heading_deg", [&survey](const V& v) { return planet::poseOf(survey, v).headingDeg; }, true}};
    for (std::size_t i = 0; i < planet::atlasMeasureCount; ++i) {
        fields.push_back({planet::atlasMeasureTexts[i].key.data(), [i](const V& v) { return v.figures[i]; }});
    }
    endTable(exportTable<V>("atlas", worst.size(), viewpointOf, fields));
}

}  // namespace

void atlasPanel(const EditorView& view, AtlasPanelState& state, ViewSettings& settings, Commands& commands) {
    const AtlasView& atlas = atlasOf(view);
    if (!atlas.atlas) {
        atlasSurveyControls(view, state, commands);
        return emptyState(atlas.running ? "The survey is running."
                                        : "Open an atlas, or press Survey, to see the whole planet at once.");
    }
    if (state.shown && *state.shown >= atlas.atlas->viewpoints.size()) state.shown.reset();
    constexpr float mapLines = 16, listLines = 14;
    const float font = ImGui::GetFontSize();
    const std::array columns = {Column{.title = "Survey",
                                       .draw =
                                           [&] {
                                               atlasSurveyControls(view, state, commands);
                                               atlasChoiceControls(atlas, settings, commands);
                                               aboutAtlas(atlas);
                                           },
                                       .wanted = 18 * font},
                                Column{.title = "Map",
                                       .share = 1.4f,
                                       .stackedLines = mapLines,
                                       .draw = [&] { atlasMap(atlas, state, commands); },
                                       .wanted = 20 * font},
                                Column{.title = "Worst viewpoints",
                                       .share = 1.4f,
                                       .stackedLines = listLines,
                                       .draw =
                                           [&] {
                                               atlasDistribution(atlas);
                                               atlasWorstList(atlas, state, commands);
                                           },
                                       .wanted = listTableWidth(atlasWorstColumns)}};
    drawColumns("atlas", columns);
}

}  // namespace worldy::ui
