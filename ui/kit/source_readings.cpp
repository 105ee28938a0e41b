#include "ui/kit/source_readings.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/trigonometric.hpp>
#include <vector>

#include "app/base/text.h"
#include "app/scene/overlay_colours.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/source_text.h"

namespace worldy::ui {

namespace {

void stateOf(const SourcesView& sources, Commands& commands) {
    wrappedText(stateText(sources),
                sources.state == SourcesView::State::Failed ? palette().bad : palette().dim);
    if (sources.state != SourcesView::State::Unread) return;
    if (button("Read source", "Opens the source in the background. That reads each of its samples once."))
        commands.emplace_back(ReadSource{});
}

void readingRow(const SourcesView& sources, const planet::SourceReading& reading, double share, bool isTop) {
    const ImVec4& colour = isTop ? palette().text : palette().dim;
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float swatch = std::round(ImGui::GetFontSize() * 0.6f);
    const float top = at.y + (ImGui::GetFontSize() - swatch) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + swatch, top + swatch},
                                              packed(layerColour(reading.layer)), 2);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + swatch * 1.5f);
    ImGui::TextColored(colour, "%s", sources.layers->layers[reading.layer].name.c_str());
    if (!reading.file.empty()) {
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + swatch * 1.5f);
        ImGui::TextColored(palette().dim, "%s", pixelText(reading).c_str());
        tooltip([&] {
            return fmt::format("{}\ncolumn {}, row {}{}", reading.file.string(), reading.column, reading.row,
                               reading.isVoid ? "\nThe sample has no height." : "");
        });
    }
    rightCell(heightText(reading), colour);
    rightCell(reading.heightM ? fmt::format("{:.0f} %", 100 * share) : std::string(), colour);
}

}  // namespace

void sourceReadings(const char* id, const SourcesView& sources, const std::optional<PlaceReadings>& place,
                    const char* nothing, Commands& commands) {
    if (!sources.layers) return stateOf(sources, commands);
    if (!place) return wrappedText(nothing, palette().dim);
    wrappedText(placeText(glm::degrees(place->place.latitudeRad), glm::degrees(place->place.longitudeRad)),
                palette().dim);
    if (!place->problem.empty()) return wrappedText(place->problem, palette().bad);
    const std::array columns = {
        TableColumn{
            "Layer", 1,
            "Layers of the source, the top one first; the bright one is the topmost with a height. Under "
            "each: the file, and the column and the row of the sample in it, from the top left.",
            "S33W071.tif 360, 360", false},
        TableColumn{
            "Height", 0,
            "Height of the sample nearest to the place, after scale, offset and datum. A bake interpolates "
            "between samples.",
            "-1000.0 m", false},
        TableColumn{"Share", 0,
                    "Share of the sample in the height that a bake shows here. 0 %: other layers cover the "
                    "layer. Layers that are "
                    "added have shares of their own beside those under them.",
                    "100 %", false}};
    const planet::SourceReading* const top = planet::topmost(place->readings);
    std::size_t lines = 1;  // the lines of a sample are a little apart
    for (const planet::SourceReading& reading : place->readings) lines += reading.file.empty() ? 1 : 2;
    if (beginListTable(id, columns, lines)) {
        using Reading = planet::SourceReading;
        const std::vector<Reading>& readings = place->readings;
        const std::vector<double> shares = planet::sharesOf(*sources.layers, readings);
        for (std::size_t row = 0; row < readings.size(); ++row)
            tableRow(row, [&] { readingRow(sources, readings[row], shares[row], &readings[row] == top); });
        const auto ifIn = [&](std::size_t row, std::int64_t value) {
            return readings[row].file.empty() ? ExportCell() : ExportCell(value);
        };
        endTable(exportTable<std::size_t>(
            "source", readings.size(), [](std::size_t row) { return row; },
            {{"layer", [&](std::size_t row) { return sources.layers->layers[readings[row].layer].name; },
              true},
             {"height_m", [&](std::size_t row) { return readings[row].heightM; }},
             {"share", [&](std::size_t row) { return shares[row]; }},
             {"file", [&](std::size_t row) { return readings[row].file.string(); }},
             {"column", [&](std::size_t row) { return ifIn(row, readings[row].column); }},
             {"row", [&](std::size_t row) { return ifIn(row, readings[row].row); }}}));
    }
    noteItem("Readings");
    if (!top)
        wrappedText(fmt::format("No layer has a height here. The planet has {:.1f} m (fill_m).",
                                sources.layers->fillM),
                    palette().dim);
}

}  // namespace worldy::ui
