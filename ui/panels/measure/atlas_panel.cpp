#include "ui/panels/measure/atlas_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/text.h"
#include "app/measure/atlas_table.h"
#include "app/scene/atlas_drape.h"
#include "app/scene/overlay_colours.h"
#include "app/settings/setting_difference.h"
#include "app/settings/view_settings.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"
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

void resumeButton(const EditorView& view, Commands& commands) {
    sameLineForButton("Resume");
    beginGrey(!view.planet, "No planet is open.");
    if (button(
            "Resume",
            "Continues the shown survey, which is not finished, with its own settings and viewpoints. The "
            "open planet must be the same bake with the same regions. worldy atlas --resume does the same."))
        commands.push_back(ResumeAtlas{});
    endGrey();
}

const char* whyNoComparison(const EditorView& view) {
    if (atlasOf(view).running) return "A survey is running.";
    return atlasOf(view).atlas->isFinished ? "" : "The survey is not finished.";
}

void atlasComparisonButtons(const EditorView& view, const AtlasPanelState& state, Commands& commands) {
    const std::string_view why = whyNoComparison(view);
    beginGrey(!why.empty(), why.data());
    if (button("Compare with...",
               "Opens an earlier survey of the same viewpoints, to show what has changed since."))
        commands.push_back(AskForFile{FilePurpose::EarlierAtlas});
    sameLineForButton("Survey again");
    beginGrey(!view.planet, "No planet is open.");
    if (button(
            "Survey again",
            "Surveys the viewpoints of this atlas on the open planet, and shows what has changed, as worldy "
            "atlas --diff does."))
        commands.push_back(RevisitAtlas{!state.withCurrentSettings});
    endGrey();
    endGrey();
}

void atlasProgress(const AtlasView& atlas, Commands& commands) {
    sameLineForButton("Cancel");
    beginGrey(atlas.cancelling, "The survey is ending.");
    if (button("Cancel", "Ends the survey. What was surveyed is kept, and Resume continues it."))
        commands.push_back(CancelAtlas{});
    endGrey();
    const double share = atlas.progress ? static_cast<double>(atlas.progress->done) /
                                              static_cast<double>(atlas.progress->total)
                                        : 0;
    const std::string text =
        atlas.progress ? fmt::format("{} of {} viewpoints", atlas.progress->done, atlas.progress->total)
                       : std::string("reading chunks");
    ImGui::ProgressBar(static_cast<float>(share), {-1, 0}, text.c_str());
    if (!atlas.surveyed.empty()) wrappedText(fmt::format("Surveying {}.", atlas.surveyed), palette().dim);
}

void atlasSurveyButtons(const EditorView& view, const AtlasPanelState& state, Commands& commands) {
    sameLineForButton("Survey");
    beginGrey(!view.planet, "No planet is open.");
    if (button("Survey",
               "Surveys the open planet in the background with the current settings, 4 headings, and 200 m, "
               "5 km and 50 km above the ground. The atlas is saved beside the screenshots. worldy atlas "
               "has more options."))
        commands.push_back(StartAtlas{static_cast<std::uint64_t>(state.viewpoints), state.measuresError});
    endGrey();
    const planet::Atlas* const atlas = atlasOf(view).atlas;
    if (atlas && !atlas->isFinished) resumeButton(view, commands);
}

void atlasSurveyOptions(const AtlasView& atlas, AtlasPanelState& state) {
    slider("Viewpoints", state.viewpoints, 1000, 72, 20'000, "%d",
           "Most viewpoints of the next survey. Where the planet differs most, they are closest.",
           ImGuiSliderFlags_Logarithmic);
    checkbox("True error", state.measuresError, false,
             "Also measures the true error, which takes about a hundred times as long.");
    if (!atlas.atlas) return;
    secondColumn("Current settings");
    checkbox("Current settings", state.withCurrentSettings, false,
             "\"Survey again\" takes the current settings, and not those of this atlas. The regions are "
             "those of now "
             "in either case.");
}

void atlasSurveyControls(const EditorView& view, AtlasPanelState& state, Commands& commands) {
    const AtlasView& atlas = atlasOf(view);
    if (button("Open...", "Opens an atlas that worldy atlas or this panel has written."))
        commands.push_back(AskForFile{});
    if (atlas.running)
        atlasProgress(atlas, commands);
    else
        atlasSurveyButtons(view, state, commands);
    if (atlas.atlas) atlasComparisonButtons(view, state, commands);
    if (!atlas.problem.empty()) wrappedText(atlas.problem, palette().warning);
    if (!atlas.comparisonProblem.empty()) wrappedText(atlas.comparisonProblem, palette().warning);
    if (!atlas.running) atlasSurveyOptions(atlas, state);
}

bool showsChange(const AtlasView& atlas) {
    return atlas.comparison && atlas.drape->isChange;
}

// Returns the changes of the shown measure; null if the survey itself is shown.
const planet::AtlasMeasureDiff* shownDiff(const AtlasView& atlas) {
    if (!showsChange(atlas)) return nullptr;
    const auto& measures = atlas.comparison->diff.measures;
    const auto found = std::ranges::find(measures, atlas.drape->measure, &planet::AtlasMeasureDiff::measure);
    return found == measures.end() ? nullptr : &*found;
}

// Returns the measures that can be shown.
std::vector<AtlasMeasure> atlasMeasuresOf(const AtlasView& atlas) {
    std::vector<AtlasMeasure> measures;
    if (showsChange(atlas)) {
        for (const planet::AtlasMeasureDiff& one : atlas.comparison->diff.measures)
            measures.push_back(one.measure);
    } else {
        for (const AtlasSpread& one : atlas.spreads) measures.push_back(one.measure);
    }
    return measures;
}

void atlasChoiceControls(const AtlasView& atlas, ViewSettings& settings, Commands& commands) {
    bool isChange = showsChange(atlas);
    bool changed = false;
    if (atlas.comparison) {
        int shown = isChange ? 1 : 0;
        changed = choiceIndex("Show", shown, 1, "survey\0change\0",
                              "The measures of this survey, or their change since the earlier one: positive "
                              "where it got worse, negative where it got better.");
        isChange = shown == 1;
    }
    const std::vector<AtlasMeasure> measures = atlasMeasuresOf(atlas);
    std::string names;
    int index = 0;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        names += std::string(planet::textOf(measures[i]).name) + '\0';
        if (measures[i] == atlas.drape->measure) index = static_cast<int>(i);
    }
    changed |= choiceIndex("Measure", index, index, names.c_str(),
                           planet::textOf(atlas.drape->measure).meaning.data());
    std::string altitudes;
    for (const double altitudeM : atlas.atlas->survey.grid.altitudesM)
        altitudes += distanceText(altitudeM) + '\0';
    int altitude = atlas.altitude;
    changed |= choiceIndex("Altitude", altitude, altitude, altitudes.c_str(),
                           "Altitude of the viewpoints above the ground or a drawn sea.");
    if (changed && !measures.empty())
        commands.push_back(ChooseAtlas{measures[static_cast<std::size_t>(index)], altitude, isChange});
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

void atlasSpreadValues(const AtlasView& atlas) {
    const auto spread = std::ranges::find(atlas.spreads, atlas.drape->measure, &AtlasSpread::measure);
    if (spread == atlas.spreads.end() || !beginValues("atlas spread")) return;
    const char* const all = "Over all viewpoints and altitudes.";
    valueRow("Median", figureText(spread->measure, spread->median), all);
    valueRow("P90", figureText(spread->measure, spread->p90), all);
    valueRow("P99", figureText(spread->measure, spread->p99), all);
    valueRow("Maximum", figureText(spread->measure, spread->most), all);
    if (spread->unbounded > 0)
        valueRow("No bound", fmt::format("{} of {}", spread->unbounded, spread->count),
                 "Viewpoints from which a drawn chunk is at most as far away as its error is large, as where "
                 "the eye "
                 "is inside its bounds. So no number of pixels bounds the error. Something keeps the chunk "
                 "coarse: a "
                 "region, a limited level, a budget, or a slow disk.");
    endValues();
}

void atlasChangeValues(const planet::AtlasMeasureDiff& diff, const AtlasDiff& all) {
    if (!beginValues("atlas change")) return;
    const char* const which = "Viewpoints of all altitudes.";
    valueRow("Grew", fmt::format("{} of {}", diff.grew, diff.compared), which,
             diff.grew > 0 ? &palette().warning : nullptr);
    valueRow("Shrank", fmt::format("{} of {}", diff.shrank, diff.compared), which);
    valueRow("Largest increase", diff.grew > 0 ? changeText(diff.measure, diff.moves.front().by()) : "-",
             which);
    valueRow("Largest decrease", diff.shrank > 0 ? changeText(diff.measure, diff.moves.back().by()) : "-",
             which);
    valueRow("Changed chunks", all.comparesTrees ? fmt::format("{}", all.chunks.size()) : "unknown",
             "Chunks down to level 8 that the bake of this survey has added, removed or changed, or under "
             "which it "
             "has. Unknown if one of the surveys has no list of chunks.");
    endValues();
}

void aboutAtlas(const AtlasView& atlas) {
    const planet::Atlas& all = *atlas.atlas;
    std::string text = fmt::format("{}: {} viewpoints{}", atlas.name, all.viewpoints.size(),
                                   all.isFinished ? "" : ", unfinished");
    if (atlas.comparison) text += fmt::format(", compared with {}", atlas.comparison->earlier);
    wrappedText(text, palette().dim);
    if (!atlas.otherBake.empty()) wrappedText(atlas.otherBake, palette().warning);
    if (const planet::AtlasMeasureDiff* diff = shownDiff(atlas))
        return atlasChangeValues(*diff, atlas.comparison->diff);
    atlasSpreadValues(atlas);
}

// The comparison with an earlier survey.

void aboutComparison(const AtlasView& atlas) {
    if (!atlas.comparison)
        return wrappedText(
            "Compare with an earlier survey of the same viewpoints, or survey them again after a bake or "
            "with "
            "other settings, to see where the planet got worse and better.",
            palette().dim);
    constexpr std::size_t listed = 8;
    const std::vector<SettingDifference>& settings = atlas.comparison->settings;
    for (std::size_t i = 0; i < std::min(settings.size(), listed); ++i)
        wrappedText(
            fmt::format("{}: {} before, {} now", settings[i].setting, settings[i].here, settings[i].there),
            palette().dim);
    if (settings.size() > listed)
        wrappedText(fmt::format("{} more settings differ.", settings.size() - listed), palette().dim);
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

std::span<const planet::AtlasCell> shownCells(const AtlasView& atlas) {
    return showsChange(atlas) ? std::span<const planet::AtlasCell>(atlas.comparison->cells) : atlas.cells;
}

// Returns the viewpoint of a cell with the largest value of the shown measure, or its worse change.
std::optional<std::size_t> worstViewpointOf(const AtlasView& atlas, const planet::AtlasCell& cell) {
    std::optional<std::size_t> worst;
    const bool isChange = showsChange(atlas);
    const std::vector<AtlasViewpoint>& all = isChange ? atlas.comparison->changes : atlas.atlas->viewpoints;
    const auto value = [&](std::size_t i) { return planet::figureOf(all[i].figures, atlas.drape->measure); };
    const auto isWorse = [&](double a, double than) {
        return isChange ? a != than && planet::worseChange(a, than) == a : a > than;
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].place.cell != cell.cell || all[i].place.altitude != cell.altitude || std::isnan(value(i)))
            continue;
        if (!worst || isWorse(value(i), value(*worst))) worst = i;
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
    for (const AtlasMeasure measure : atlasMeasuresOf(atlas)) {
        const double value = planet::figureOf(atlas.atlas->viewpoints[*worst].figures, measure);
        std::string text = figureText(measure, value);
        if (showsChange(atlas)) {
            const double change = planet::figureOf(atlas.comparison->changes[*worst].figures, measure);
            text += fmt::format(" ({})", change == 0 ? "unchanged" : changeText(measure, change));
        }
        ImGui::Text("%s %s", std::string(planet::textOf(measure).name).c_str(), text.c_str());
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
    for (const planet::AtlasCell& cell : shownCells(atlas)) {
        const double value = planet::figureOf(cell.values, atlas.drape->measure);
        if (cell.altitude != atlas.altitude || std::isnan(value)) continue;
        const AtlasMapSquare square = mapSquareOf(cell.cell, placement);
        const float gap = square.end.x - square.start.x > 6 ? 1.0f : 0.0f;
        drawList.AddRectFilled(square.start, {square.end.x - gap, square.end.y - gap},
                               packedColour(drapeColour(*atlas.drape, value)));
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

// Says what there is instead of values that could be in a histogram.
std::string withoutDistribution(bool isChange, std::size_t lost, std::size_t gained) {
    if (!isChange) return lost > 0 ? fmt::format("No bound in any of {} cells of this altitude.", lost) : "";
    if (lost + gained == 0) return "No cell of this altitude has changed.";
    return fmt::format("Cells of this altitude that have lost their bound: {}; that have gained one: {}.",
                       lost, gained);
}

void atlasDistribution(const AtlasView& atlas) {
    const bool isChange = showsChange(atlas);
    std::vector<float> counts(atlasBuckets);
    std::size_t lost = 0, gained = 0, counted = 0;
    for (const planet::AtlasCell& cell : shownCells(atlas)) {
        const double value = planet::figureOf(cell.values, atlas.drape->measure);
        if (cell.altitude != atlas.altitude || std::isnan(value) || (isChange && value == 0)) continue;
        if (std::isinf(value)) {
            ++(value > 0 ? lost : gained);
            continue;
        }
        ++counted;
        const double share = shareOf(*atlas.drape, value);
        ++counts[std::min(static_cast<std::size_t>(share * atlasBuckets), atlasBuckets - 1)];
    }
    if (counted == 0) return wrappedText(withoutDistribution(isChange, lost, gained), palette().dim);
    const auto text = [&](double share) { return drapeText(*atlas.drape, valueOf(*atlas.drape, share)); };
    histogram("atlas histogram", counts, scaleEndText(*atlas.drape, false), scaleEndText(*atlas.drape, true),
              {}, 4, text);
    tooltip(
        isChange
            ? "Cells of this altitude by the change of the measure, the worst of their headings, without "
              "those "
              "that have not changed. Changes above the 99th percentile of all sizes are in the buckets at "
              "the ends."
            : "Cells of this altitude by the measure of their worst heading. Values above the 99th "
              "percentile "
              "are in the last bucket, and cells without a bound in none.");
}

// The lists.

void goButton(std::size_t row, std::size_t viewpoint, AtlasPanelState& state, Commands& commands) {
    ImGui::TableNextColumn();
    if (ImGui::SmallButton("Go")) lookFromViewpoint(state, viewpoint, commands);
    noteItem(fmt::format("Go {}", row));
    tooltip("Flies to the viewpoint with the settings of the survey. Undo brings the settings back.");
}

void placeCells(const planet::AtlasSurvey& survey, const AtlasViewpoint& viewpoint) {
    const planet::CameraPose pose = planet::poseOf(survey, viewpoint);
    cell(placeText(pose.latitudeDeg, pose.longitudeDeg, 2));
    cell(distanceText(survey.grid.altitudesM[viewpoint.place.altitude]));
    cell(fmt::format("{:.0f}\u00b0", pose.headingDeg));
}

// Returns the sort key of a column of placeCells: 0 place, 1 altitude, 2 heading.
SortKey placeKey(const planet::AtlasSurvey& survey, const AtlasViewpoint& viewpoint, std::size_t column) {
    if (column == 0) return planet::poseOf(survey, viewpoint).latitudeDeg;
    if (column == 1) return survey.grid.altitudesM[viewpoint.place.altitude];
    return static_cast<double>(viewpoint.place.heading);
}

// Returns the exported fields of the place of a row, of which viewpointOf makes the viewpoint.
template <class Row, class ViewpointOf>
std::vector<ExportField<Row>> placeFields(const planet::AtlasSurvey& survey, const ViewpointOf& viewpointOf) {
    const auto pose = [&survey, viewpointOf](const Row& row) {
        return planet::poseOf(survey, viewpointOf(row));
    };
    return {{"latitude_deg", [pose](const Row& row) { return pose(row).latitudeDeg; }, true},
            {"longitude_deg", [pose](const Row& row) { return pose(row).longitudeDeg; }, true},
            {"above_ground_m",
             [&survey, viewpointOf](const Row& row) {
                 return survey.grid.altitudesM[viewpointOf(row).place.altitude];
             },
             true},
            {"heading_deg", [pose](const Row& row) { return pose(row).headingDeg; }, true}};
}

constexpr std::array atlasWorstColumns = {
    TableColumn{"##go", 0.1f, nullptr, "Go xx"},
    TableColumn{"Value", 0.8f, "The chosen measure.", "no bound"},
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
    const auto value = [&](std::size_t row) {
        return planet::figureOf(viewpointOf(row).figures, atlas.drape->measure);
    };
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        return column < 2 ? SortKey(value(row)) : placeKey(all.survey, viewpointOf(row), column - 2);
    };
    tableRows(worst.size(), key, [&](std::size_t row) {
        goButton(row, worst[row], state, commands);
        cell(figureText(atlas.drape->measure, value(row)));
        placeCells(all.survey, viewpointOf(row));
    });
    using V = AtlasViewpoint;
    auto fields = placeFields<V>(all.survey, std::identity());
    for (std::size_t i = 0; i < planet::atlasMeasureCount; ++i) {
        fields.push_back({planet::atlasMeasureTexts[i].key.data(), [i](const V& v) { return v.figures[i]; }});
    }
    endTable(exportTable<V>("atlas", worst.size(), viewpointOf, fields));
}

constexpr std::array atlasChangeColumns = {
    TableColumn{"##go", 0.1f, nullptr, "Go xx"},
    TableColumn{"Change", 0.9f, "Of the chosen measure. Positive is worse.", "bound gained"},
    TableColumn{"Before", 0.8f, "In the earlier survey.", "1.86e+03 px"},
    TableColumn{"Now", 0.8f, "In this survey.", "1.86e+03 px"},
    TableColumn{"Place", 1.4f, "Latitude and longitude.", "88.88\u00b0 N 188.88\u00b0 W"},
    TableColumn{"Altitude", 0.7f, "Above the ground or a drawn sea.", "50.0 km"},
    TableColumn{"Heading", 0.7f, "Clockwise from north.", "270\u00b0"},
};

// Returns the largest increases, then the largest decreases.
std::vector<planet::AtlasMove> listedMoves(const planet::AtlasMeasureDiff& diff) {
    const auto begin = diff.moves.begin();
    std::vector<planet::AtlasMove> moves(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(diff.grew, atlasWorstListed)));
    for (std::size_t i = 0; i < std::min(diff.shrank, atlasWorstListed); ++i)
        moves.push_back(diff.moves[diff.moves.size() - 1 - i]);
    return moves;
}

void atlasChangeList(const AtlasView& atlas, const planet::AtlasMeasureDiff& diff, AtlasPanelState& state,
                     Commands& commands) {
    if (diff.moves.empty()) return emptyState("This measure is the same at all viewpoints.");
    const planet::Atlas& all = *atlas.atlas;
    const std::vector<planet::AtlasMove> moves = listedMoves(diff);
    if (!beginWideTable("atlas changes", atlasChangeColumns, 1)) return;
    const auto viewpointOf = [&](const planet::AtlasMove& move) -> const AtlasViewpoint& {
        return all.viewpoints[move.viewpoint];
    };
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::AtlasMove& move = moves[row];
        if (column > 3) return placeKey(all.survey, viewpointOf(move), column - 4);
        return column == 3 ? move.now : column == 2 ? move.before : move.by();
    };
    tableRows(moves.size(), key, [&](std::size_t row) {
        const planet::AtlasMove& move = moves[row];
        goButton(row, move.viewpoint, state, commands);
        cell(changeText(diff.measure, move.by()));
        cell(figureText(diff.measure, move.before));
        cell(figureText(diff.measure, move.now));
        placeCells(all.survey, viewpointOf(move));
    });
    using M = planet::AtlasMove;
    auto fields = placeFields<M>(all.survey, viewpointOf);
    fields.push_back({"before", [](const M& move) { return move.before; }});
    fields.push_back({"now", [](const M& move) { return move.now; }});
    endTable(exportTable<M>(
        "atlas changes", moves.size(), [&](std::size_t row) -> const M& { return moves[row]; }, fields));
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
    const planet::AtlasMeasureDiff* const diff = shownDiff(atlas);
    const std::array columns = {
        Column{.title = "Survey",
               .draw =
                   [&] {
                       atlasSurveyControls(view, state, commands);
                       atlasChoiceControls(atlas, settings, commands);
                       aboutAtlas(atlas);
                       aboutComparison(atlas);
                   },
               .wanted = 18 * font},
        Column{.title = "Map",
               .share = 1.4f,
               .stackedLines = mapLines,
               .draw = [&] { atlasMap(atlas, state, commands); },
               .wanted = 20 * font},
        Column{.title = diff ? "Largest changes" : "Worst viewpoints",
               .share = 1.4f,
               .stackedLines = listLines,
               .draw =
                   [&] {
                       if (!diff || !diff->moves.empty()) atlasDistribution(atlas);
                       if (diff)
                           atlasChangeList(atlas, *diff, state, commands);
                       else
                           atlasWorstList(atlas, state, commands);
                   },
               .wanted = diff ? listTableWidth(atlasChangeColumns) : listTableWidth(atlasWorstColumns)}};
    drawColumns("atlas", columns);
}

}  // namespace worldy::ui
