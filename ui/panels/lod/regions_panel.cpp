#include "ui/panels/lod/regions_panel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/scene/overlay_colours.h"
#include "planet/sphere/chunk_id.h"
#include "planet/tree/region.h"
#include "ui/kit/item_map.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/note_subjects.h"

namespace worldy::ui {

namespace {

using planet::Region;
using Regions = std::vector<Region>;

constexpr float leastNameEms = 8;  // of the names' room, if they need it
constexpr float leastEffectEms = 3;

constexpr const char* noRegion = "There is no region. Add one first.";

std::string freeName(const Regions& regions) {
    for (std::size_t number = regions.size() + 1;; ++number) {
        std::string name = fmt::format("Region {}", number);
        if (std::ranges::find(regions, name, &Region::name) == regions.end()) return name;
    }
}

// Returns a circle in the middle of the picture, which takes a third of its width.
planet::RegionCircle circleInView(const EditorView& view) {
    const planet::View& eye = view.camera.renderView;
    const glm::dvec3 middle = groundInMiddle(eye, view.planet->tree(), view.planet->selection().draw);
    const double awayM = glm::distance(middle, eye.eyeM);
    const double radiusM = awayM * eye.widthPx / (6 * planet::screenScalePx(eye));
    return {planet::pointOf(middle), std::clamp(radiusM, 1.0, view.planet->tree().shape.radiusM)};
}

// Returns a region that shows at once: half of the tolerance, with a border as wide as half of its radius.
Region newRegion(const EditorView& view, const Regions& regions) {
    Region region;
    region.name = freeName(regions);
    region.circles = {circleInView(view)};
    region.borderM = region.circles[0].radiusM / 2;
    region.tauFactor = 0.5;
    return region;
}

std::string effectText(const Region& region) {
    std::vector<std::string> parts;
    if (region.tauFactor) parts.push_back(fmt::format("{} x {:.3g}", tauSymbol(), *region.tauFactor));
    if (region.leastLevel) parts.push_back(fmt::format("level >= {}", *region.leastLevel));
    if (region.mostLevel) parts.push_back(fmt::format("level <= {}", *region.mostLevel));
    if (region.metric) parts.push_back(*region.metric == planet::ErrorMetric::Tight ? "tight" : "additive");
    return parts.empty() ? "no effect" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string placeText(const Region& region) {
    std::vector<std::string> parts;
    if (!region.circles.empty()) parts.push_back(countedText(region.circles.size(), "circle"));
    if (!region.polygons.empty()) parts.push_back(countedText(region.polygons.size(), "polygon"));
    if (region.heights) {
        parts.push_back(fmt::format("{} to {}", distanceText(region.heights->lowestM),
                                    distanceText(region.heights->highestM)));
    }
    return parts.empty() ? "nowhere" : fmt::format("{}", fmt::join(parts, ", "));
}

void regionRow(std::size_t index, Region& region, RegionsPanelState& state) {
    ImGui::TableNextColumn();
    ImGui::Checkbox("##on", &region.on);
    noteItem(fmt::format("on: {}", region.name));
    tooltip("Off: the region has no effect, but stays in the list and in the file.");
    ImGui::TableNextColumn();
    const glm::vec3 colour = region.on ? regionColour(index) : noRegionColour;
    const float side = ImGui::GetTextLineHeight();
    ImGui::ColorButton("##chip", {colour.r, colour.g, colour.b, 1},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    tooltip("The colour of its outline and of its chunks in the tint by region.");
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, region.on ? palette().text : palette().dim);
    if (ImGui::Selectable(fmt::format("{}##row", region.name).c_str(), state.chosen == index)) {
        state.chosen = index;
        state.circle = 0;
    }
    ImGui::PopStyleColor();
    noteItem(fmt::format("region {}", region.name));
    tooltip("Click to edit or paint the region.");
    ImGui::TableNextColumn();
    const std::string effect = effectText(region);
    shortenedText(effect, palette().dim, ImGui::GetContentRegionAvail().x);
    tooltip([&] { return fmt::format("{}\n{}", effect, placeText(region)); });
}

void regionList(Regions& regions, RegionsPanelState& state) {
    if (regions.empty()) {
        wrappedText("The planet has no regions: the whole of it has the same tolerance.", palette().dim);
        return;
    }
    if (!beginPlainTable("regions", 4, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("on");
    ImGui::TableSetupColumn("chip");
    // Names keep their room, and effects are shortened.
    const float font = ImGui::GetFontSize();
    float name = 0, effect = 0;
    for (const Region& region : regions) {
        name = std::max(name, ImGui::CalcTextSize(region.name.c_str()).x);
        effect = std::max(effect, ImGui::CalcTextSize(effectText(region).c_str()).x);
    }
    const float room = ImGui::GetContentRegionAvail().x - checkboxWidth("") - ImGui::GetTextLineHeight() -
                       6 * ImGui::GetStyle().CellPadding.x;
    const float effectWidth =
        std::clamp(room - std::min(name, leastNameEms * font), leastEffectEms * font, effect + 1);
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("effect", ImGuiTableColumnFlags_WidthFixed, effectWidth);
    for (std::size_t i = 0; i < regions.size(); ++i) tableRow(i, [&] { regionRow(i, regions[i], state); });
    endTable(exportTable<const Region*>("regions", regions.size(),
                                        [&](std::size_t row) { return &regions[row]; },
                                        {{"region", [](const Region* one) { return one->name; }, true},
                                         {"on", [](const Region* one) { return one->on; }},
                                         {"effect", [](const Region* one) { return effectText(*one); }},
                                         {"place", [](const Region* one) { return placeText(*one); }}}));
}

void listButtons(const EditorView& view, Regions& regions, RegionsPanelState& state) {
    const bool isFull = regions.size() >= planet::mostRegions;
    beginGrey(isFull, "The planet has as many regions as it can have.");
    if (button("Add",
               "Adds a region around the ground in the middle of the picture, with half of the tolerance.")) {
        regions.push_back(newRegion(view, regions));
        state.chosen = regions.size() - 1;
        state.circle = 0;
    }
    sameLineForButton("Copy");
    beginGrey(regions.empty(), noRegion);
    if (button("Copy", "Duplicates the chosen region.")) {
        Region copy = regions[state.chosen];
        copy.name = freeName(regions);
        regions.push_back(std::move(copy));
        state.chosen = regions.size() - 1;
    }
    endGrey();
    endGrey();
    sameLineForButton("Delete");
    beginGrey(regions.empty(), noRegion);
    if (button("Delete", "Deletes the chosen region. Undo brings it back.")) {
        regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(state.chosen));
        state.chosen = std::min(state.chosen, regions.empty() ? 0 : regions.size() - 1);
        state.circle = 0;
    }
    endGrey();
}

// Asks about what saving would destroy.
void saveQuestion(const SettingsView& files, Commands& commands) {
    wrappedText(files.regionsQuestion, palette().warning);
    if (button("Replace it", "Writes the regions into this file."))
        commands.push_back(SaveRegions{.replaces = true});
    sameLineForButton("Read it");
    if (button("Read it", "Replaces the regions by those of the file. Undo brings yours back."))
        commands.push_back(LoadRegions{files.regionsFile});
    sameLineForButton("Do not save");
    if (button("Do not save", "Leaves the file as it is.")) commands.push_back(KeepRegionsFile{});
}

void fileControls(const EditorView& view, bool isEmpty, Commands& commands) {
    const SettingsView& files = view.settings;
    beginGrey(isEmpty && !files.hasUnsavedRegions, noRegion);
    const std::string help = fmt::format("Saves the regions in {}.", files.regionsFile.string());
    if (button("Save", help.c_str())) commands.push_back(SaveRegions{});
    endGrey();
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    shortenedText(files.hasUnsavedRegions ? "not saved" : files.regionsFile.filename().string(),
                  files.hasUnsavedRegions ? palette().warning : palette().dim,
                  ImGui::GetContentRegionAvail().x);
    tooltip(files.regionsFile.string().c_str());
    if (!files.regionsQuestion.empty()) saveQuestion(files, commands);
}

void nameField(Region& region) {
    labelledControl("Name", "Named in \"why this chunk\", in the legend and in the file. Unique.");
    std::array<char, planet::mostNameBytes + 1> text{};
    std::memcpy(text.data(), region.name.data(), std::min(region.name.size(), planet::mostNameBytes));
    if (ImGui::InputText("##name", text.data(), text.size())) region.name = text.data();
    noteItem("Name");
}

// Draws a check box that turns an effect on, and its slider while it is on.
template <class Value, class Slider>
void optionalControl(const char* label, std::optional<Value>& value, Value first, const char* help,
                     const Slider& slider) {
    bool isSet = value.has_value();
    if (checkbox(label, isSet, false, help)) value = isSet ? std::optional(first) : std::nullopt;
    if (value) slider(*value);
}

void effectControls(Region& region) {
    optionalControl<double>(
        "Factor on τ", region.tauFactor, 0.5,
        "The tolerance in the region is τ times this factor. Smaller than 1: finer; larger: coarser.",
        [](double& factor) {
            slider("Factor", factor, 0.5, planet::leastTauFactor, planet::mostTauFactor, "%.3g x τ",
                   "Smaller: more triangles in the region. Larger: fewer triangles, more visible error.",
                   ImGuiSliderFlags_Logarithmic);
        });
    const auto levelSlider = [](const char* label, int least, int most, const char* help) {
        return [=](int& level) { slider(label, level, 0, least, most, "%d", help); };
    };
    const int most = region.mostLevel.value_or(planet::maxLevel);
    optionalControl<int>(
        "Least level", region.leastLevel, std::min(4, most),
        "Chunks of smaller levels are split, whatever their error.",
        levelSlider("At least", 0, most, "Larger: more triangles in the region, however far away it is."));
    const int least = region.leastLevel.value_or(0);
    optionalControl<int>(
        "Largest level", region.mostLevel, std::max(8, least),
        "Chunks of this level are not split, whatever their error. A larger least level of another "
        "region overrules it.",
        levelSlider("At most", least, planet::maxLevel,
                    "Smaller: coarse ground near the camera, whatever the tolerance."));
    int metric = region.metric ? 1 + static_cast<int>(*region.metric) : 0;
    if (choiceIndex("Metric", metric, 0, "as set\0additive\0tight\0",
                    "The error metric in the region (LOD panel). It has no soft border.")) {
        region.metric.reset();
        if (metric > 0) region.metric = static_cast<planet::ErrorMetric>(metric - 1);
    }
}

// Draws a slider for a length along the ground, in kilometres.
void lengthSlider(const char* label, double& lengthM, double firstM, double leastM, double mostM,
                  const char* help) {
    double km = lengthM / 1000;
    if (slider(label, km, firstM / 1000, leastM / 1000, mostM / 1000, "%.4g km", help,
               ImGuiSliderFlags_Logarithmic))
        lengthM = 1000 * km;
}

void circleControls(const EditorView& view, Region& region, RegionsPanelState& state, Commands& commands) {
    const double planetM = view.planet->tree().shape.radiusM;
    lengthSlider("Soft border", region.borderM, 0, 0, planetM,
                 "Width around the circles and polygons over which the effect fades out. 0: a hard border.");
    if (button("Add circle", "Adds a circle around the ground in the middle of the picture.") &&
        region.circles.size() < planet::mostCircles) {
        region.circles.push_back(circleInView(view));
        state.circle = region.circles.size() - 1;
    }
    if (region.circles.empty()) return;
    state.circle = std::min(state.circle, region.circles.size() - 1);
    sameLineForButton("Remove circle");
    if (button("Remove circle", "Removes the circle below.")) {
        region.circles.erase(region.circles.begin() + static_cast<std::ptrdiff_t>(state.circle));
        if (region.circles.empty()) return;
        state.circle = std::min(state.circle, region.circles.size() - 1);
    }
    if (region.circles.size() > 1) {
        int number = static_cast<int>(state.circle) + 1;
        const std::string format = fmt::format("%d of {}", region.circles.size());
        slider("Circle", number, 1, 1, static_cast<int>(region.circles.size()), format.c_str(),
               "The circle that the controls below change.");
        state.circle =
            static_cast<std::size_t>(std::clamp<int>(number, 1, static_cast<int>(region.circles.size())) - 1);
    }
    planet::RegionCircle& circle = region.circles[state.circle];
    lengthSlider("Radius", circle.radiusM, circle.radiusM, 1, 3.2 * planetM, "Radius along the ground.");
    slider("Latitude", circle.centre.latitudeDeg, circle.centre.latitudeDeg, -90, 90, "%.4f°",
           "Of the centre.");
    slider("Longitude", circle.centre.longitudeDeg, circle.centre.longitudeDeg, -180, 180, "%.4f°",
           "Of the centre.");
    if (button("Look", "Flies above the circle.")) {
        planet::CameraPose pose = view.camera.pose;
        pose.latitudeDeg = circle.centre.latitudeDeg;
        pose.longitudeDeg = circle.centre.longitudeDeg;
        pose.altitudeM = std::max(1000.0, 3 * std::min(circle.radiusM, planetM));
        pose.pitchDeg = -88;
        commands.push_back(MoveCamera{pose, true});
    }
}

void polygonControls(Region& region, RegionsPanelState& state) {
    if (region.polygons.empty()) return;
    const std::size_t last = region.polygons.size() - 1;
    state.polygon = std::min(state.polygon, last);
    if (last > 0) {
        int number = static_cast<int>(state.polygon) + 1;
        const std::string format = fmt::format("%d of {}, {}", last + 1,
                                               countedText(region.polygons[state.polygon].size(), "corner"));
        slider("Polygon", number, 1, 1, static_cast<int>(last) + 1, format.c_str(),
               "The polygon that the button below removes. Its corners are in the file.");
        state.polygon = static_cast<std::size_t>(std::clamp(number, 1, static_cast<int>(last) + 1) - 1);
    }
    if (button("Remove polygon", last > 0 ? "Removes the polygon above." : "Removes the region's polygon."))
        region.polygons.erase(region.polygons.begin() + static_cast<std::ptrdiff_t>(state.polygon));
}

void heightControls(Region& region) {
    bool isSet = region.heights.has_value();
    if (checkbox("Only at heights", isSet, false,
                 "Limits the region to ground of some heights. Without circles and polygons, it covers all "
                 "ground at "
                 "these heights.")) {
        region.heights = isSet ? std::optional(planet::HeightBand{0, 9000, 500}) : std::nullopt;
    }
    if (!region.heights) return;
    planet::HeightBand& band = *region.heights;
    slider("Lowest", band.lowestM, 0, -12'000, 12'000, "%.0f m",
           "Above the planet's radius, without exaggeration.");
    slider("Highest", band.highestM, 9000, -12'000, 12'000, "%.0f m",
           "Above the planet's radius, without exaggeration.");
    slider("Height border", band.borderM, 500, 0, 5000, "%.0f m", "Height over which the effect fades out.");
    band.highestM = std::max(band.lowestM, band.highestM);
}

// Draws what belongs to a polygon that is being drawn. Its corners are no setting yet, so Undo does not know them.
void cornerControls(Region& region, RegionsPanelState& state) {
    planet::RegionPolygon& corners = state.corners;
    wrappedText(corners.empty() ? "Click on the globe to set the first corner."
                                : countedText(corners.size(), "corner") + "; click on the globe to add more.",
                palette().dim);
    beginGrey(corners.size() < 3, "A polygon has at least three corners.");
    if (button("Close polygon", "Adds the polygon to the region. Its edges must not cross.")) {
        const planet::Result<void> closed = closePolygon(corners, region);
        state.problem = closed ? std::string() : closed.error().message;
        state.polygon = region.polygons.size() - 1;
    }
    endGrey();
    sameLineForButton("Remove corner");
    beginGrey(corners.empty(), "There is no corner.");
    if (button("Remove corner", "Takes back the last corner.")) {
        corners.pop_back();
        state.problem.clear();
    }
    endGrey();
}

void brushControls(const EditorView& view, Region& region, RegionsPanelState& state) {
    RegionBrush& brush = state.brush;
    choice("Brush", brush.mode, BrushMode::Off, "off\0paint\0erase\0polygon\0",
           "While this panel is shown, dragging with the left button over the picture paints circles of the "
           "chosen region, or erases them; a stroke is one step for Undo. With \"polygon\", clicks set the "
           "corners of a polygon, and dragging moves the camera. The right button, Alt and the wheel always "
           "move the camera.");
    if (brush.mode == BrushMode::Polygon) return cornerControls(region, state);
    beginGrey(brush.mode == BrushMode::Off, "The brush is off.");
    lengthSlider("Size", brush.radiusM, 50'000, 1, view.planet->tree().shape.radiusM,
                 "Radius of the circles that the brush paints, and within which it erases.");
    endGrey();
}

void chosenControls(const EditorView& view, Region& region, RegionsPanelState& state, Commands& commands) {
    nameField(region);
    effectControls(region);
    if (section("Where")) {
        circleControls(view, region, state, commands);
        polygonControls(region, state);
        heightControls(region);
    }
    if (section("Brush")) brushControls(view, region, state);
}

}  // namespace

void regionsPanel(const EditorView& view, RegionsPanelState& state, ViewSettings& settings,
                  Commands& commands) {
    const SettingControls control(settings);
    control(settings.regions.on);
    control.beside(settings.overlay.regions);
    if (!view.planet) return emptyState("No planet is open. Open one to give it regions.");
    const Regions before = settings.regions.all();
    Regions regions = before;
    state.chosen = std::min(state.chosen, regions.empty() ? 0 : regions.size() - 1);
    regionList(regions, state);
    listButtons(view, regions, state);
    fileControls(view, regions.empty(), commands);
    if (!regions.empty() && section(fmt::format("Region: {}###region", regions[state.chosen].name).c_str()))
        chosenControls(view, regions[state.chosen], state, commands);
    if (regions != before) {
        const planet::Result<void> good = planet::checkRegions(regions);
        state.problem = good ? std::string() : good.error().message;
        if (good) settings.regions.list = std::make_shared<const Regions>(std::move(regions));
    }
    if (!state.problem.empty()) wrappedText(state.problem, palette().bad);
}

}  // namespace worldy::ui
