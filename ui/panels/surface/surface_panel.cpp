#include "ui/panels/surface/surface_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "app/base/text.h"
#include "planet/surface/colour_clipmap.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/surface/ramp_edit.h"

namespace worldy::ui {

namespace {

using planet::gl::maxRampStops;
using planet::gl::RampStop;

// Heights in metres that presets and the first stop of a ramp span.
struct HeightRange {
    double lowestM = -8000;
    double highestM = 8000;
};

HeightRange heightsOf(const EditorView& view, double seaLevelM) {
    if (!view.planet) return {};
    const planet::ChunkTree& tree = view.planet->tree();
    // Stops are at true heights, independent of the exaggeration.
    return {planet::heightM(tree.storedShape, tree.minStep) - seaLevelM,
            planet::heightM(tree.storedShape, tree.maxStep) - seaLevelM};
}

// A list of the powers of two that the size of a clipmap's windows may be.
void windowSizeControl(const SettingControls& control, SurfaceSettings& surface) {
    const auto indexOf = [](int sizePx) {
        const auto size = static_cast<unsigned>(planet::clipmapLayout(sizePx, 0).sizePx);
        return std::countr_zero(size) - std::countr_zero(static_cast<unsigned>(planet::smallestClipmapPx));
    };
    const Field& field = control.of(surface.clipmapSizePx);
    const auto tip = [&] { return settingTip(field); };
    int index = indexOf(surface.clipmapSizePx);
    if (choiceIndex(std::string(field.label).c_str(), index, indexOf(SurfaceSettings().clipmapSizePx),
                    "256 px\0"
                    "512 px\0"
                    "1024 px\0"
                    "2048 px\0"
                    "4096 px\0",
                    tip))
        surface.clipmapSizePx = planet::smallestClipmapPx << index;
    noteSetting(field);
}

void clipmapControls(const SettingControls& control, SurfaceSettings& surface) {
    control(surface.colourMode);
    beginGrey(surface.colourMode != ColourMode::Clipmap, "Only the clipmap has windows.");
    windowSizeControl(control, surface);
    endGrey();
}

// Shows the memory of tiles and of the clipmap, whichever is used.
void colourMemory(const EditorView& view, const SurfaceSettings& surface) {
    const planet::gl::GpuMemory& gpu = view.frames.stats.gpuMemory;
    const ClipmapStats& clipmap = view.frames.stats.clipmap;
    const auto bytes = [](std::size_t count) { return bytesText(static_cast<double>(count)); };
    valueRow("Tile memory", bytes(gpu.colourTiles),
             "GPU memory of the tile pool, the page table and the mipmaps of the root tiles. The clipmap is "
             "filled from the pool, so it is needed in both modes.");
    const planet::ClipmapLayout layout =
        planet::clipmapLayout(surface.clipmapSizePx, view.planet->colour()->leafLevel);
    const std::size_t planned =
        planet::clipmapBaseBytes(layout) +
        static_cast<std::size_t>(layout.movingLevels()) * planet::clipmapWindowBytes(layout);
    const bool there = gpu.colourClipmap > 0;
    valueRow("Clipmap memory",
             there ? bytes(gpu.colourClipmap) : fmt::format("0 (enabled: {})", bytes(planned)),
             "Additional GPU memory, 4 bytes per texel: the coarse levels of all six faces, and one window "
             "per finer level, or two or three near a face's edge or corner. Freed when sampling tiles.");
    if (!there) return;
    valueRow("Windows", fmt::format("{} above level {}", clipmap.windows, clipmap.wholeLevel),
             "Number of clipmap windows of the levels finer than those stored completely. The Clipmap option "
             "in the Overlay panel shows them.");
    valueRow("Texels updated", countText(static_cast<double>(clipmap.filledTexels)),
             "Texels updated in the last frame: strips that entered the windows by camera movement, and "
             "areas of newly loaded tiles. After a camera jump, all texels are updated.");
}

// Draws the controls of colours that the file holds.
void streamedControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface) {
    control(surface.streamed);
    beginGrey(!surface.streamed, "Turn on Streamed first.");
    control(surface.texelsPerPixel);
    clipmapControls(control, surface);
    endGrey();
    const std::string& problem = view.frames.stats.clipmap.problem;
    if (!problem.empty()) wrappedText(problem, palette().warning);
    const planet::TileCounters& seen = view.planet->views()[0].colours.counters;
    const planet::BlockCounters& paging = view.planet->paging()[planet::BlockKind::Colours];
    if (!beginValues("streamed")) return;
    valueRow("Tiles", fmt::format("{} of {}", paging.resident, paging.capacity),
             "Resident tiles and the number that fits into the colour share of the budget (Paging panel).");
    valueRow("Finest level", fmt::format("{} of {}", seen.deepestLevel, view.planet->colour()->leafLevel),
             "Finest level of the tiles in view, and of the file.");
    valueRow("Waiting", fmt::format("{}", seen.waiting), "Tiles in view that are coarser than requested.");
    colourMemory(view, surface);
    endValues();
}

void colourControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface) {
    const bool hasOwn = view.planet && view.planet->colour();
    const bool hasAny = hasOwn || view.data.hasColourImage;
    control(surface.surface,
            {.help = hasAny ? "" : "No colour image is loaded; both choices draw the height ramp."});
    const bool image = surface.surface == planet::gl::SurfaceColour::Image && hasAny;
    beginGrey(!image,
              hasAny ? "The height ramp is drawn: choose the image above." : "No colour image is loaded.");
    control(surface.imageOpacity);
    if (hasOwn) streamedControls(view, control, surface);
    endGrey();
}

// Draws the ramp from its first stop to its last, with a mark below each stop. Returns the height that is
// clicked.
std::optional<double> previewBar(std::span<const RampStop> ramp, int selected) {
    const float line = ImGui::GetFrameHeight();
    const float tick = std::round(line * 0.35f);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, line);
    const bool clicked = ImGui::InvisibleButton("preview", {width, line + tick});
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const double first = ramp.front().heightM;
    const double span = ramp.back().heightM - first;
    const auto x = [&](double heightM) {
        return start.x + (span > 0 ? static_cast<float>((heightM - first) / span) * width : width / 2);
    };
    if (span <= 0)
        drawList.AddRectFilled(start, {start.x + width, start.y + line}, packed(ramp.back().colour));
    for (std::size_t i = 0; i + 1 < ramp.size() && span > 0; ++i) {
        const ImU32 left = packed(ramp[i].colour);
        const ImU32 right = packed(ramp[i + 1].colour);
        drawList.AddRectFilledMultiColor({x(ramp[i].heightM), start.y},
                                         {x(ramp[i + 1].heightM), start.y + line}, left, right, right, left);
    }
    for (std::size_t i = 0; i < ramp.size(); ++i) {
        const float at = std::clamp(x(ramp[i].heightM), start.x + tick / 2, start.x + width - tick / 2);
        const bool isSelected = static_cast<int>(i) == selected;
        drawList.AddTriangleFilled({at, start.y + line}, {at - tick / 2, start.y + line + tick},
                                   {at + tick / 2, start.y + line + tick},
                                   ImGui::GetColorU32(isSelected ? palette().accent : palette().dim));
    }
    const auto share = static_cast<double>((ImGui::GetIO().MousePos.x - start.x) / width);
    const double heightM = first + std::clamp(share, 0.0, 1.0) * span;
    tooltip(fmt::format("{:.0f} m above sea level. Click to add a stop here.", heightM).c_str());
    if (clicked) return heightM;
    return std::nullopt;
}

void presetButtons(const HeightRange& heights, Ramp& ramp) {
    if (button("Built-in", "Built-in ramp with rules for steep slopes, ice and dry belts.")) ramp.clear();
    sameLineForButton("Grey");
    if (button("Grey", "Grey ramp: black at this planet's minimum height, white at its maximum."))
        ramp = greyRamp(heights.lowestM, heights.highestM);
    sameLineForButton("Hypsometric");
    if (button("Hypsometric",
               "Atlas colours scaled to this planet's heights: blue below sea level; green, yellow, brown "
               "and white above."))
        ramp = hypsometricRamp(heights.lowestM, heights.highestM);
}

enum class StopAction : std::uint8_t { None, Remove };

StopAction stopRow(Ramp& ramp, std::size_t index, int& selected) {
    ImGui::PushID(static_cast<int>(index));
    const bool isSelected = selected == static_cast<int>(index);
    const float height = ImGui::GetFrameHeight();
    if (ImGui::RadioButton("##select", isSelected)) selected = static_cast<int>(index);
    tooltip("Select a stop; new stops are added after it.");
    ImGui::SameLine();
    ImGui::ColorEdit3("##colour", &ramp[index].colour.x, ImGuiColorEditFlags_NoInputs);
    if (ImGui::IsItemActivated()) selected = static_cast<int>(index);
    tooltip("sRGB colour. Click to change it.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - height - ImGui::GetStyle().ItemSpacing.x);
    double heightM = ramp[index].heightM;
    const auto speed = static_cast<float>(std::max(std::abs(heightM) * 0.005, 1.0));
    if (ImGui::DragScalar("##height", ImGuiDataType_Double, &heightM, speed, nullptr, nullptr, "%.0f m"))
        moveStop(ramp, index, heightM);
    if (ImGui::IsItemActivated()) selected = static_cast<int>(index);
    tooltip("Metres above sea level, between the neighbouring stops. Drag, or Ctrl+click to type.");
    ImGui::SameLine();
    const bool remove = ImGui::Button("x", {height, 0});
    tooltip("Removes this stop. Without stops the built-in ramp is used.");
    ImGui::PopID();
    return remove ? StopAction::Remove : StopAction::None;
}

void rampStops(Ramp& ramp, int& selected) {
    for (std::size_t i = 0; i < ramp.size(); ++i) {
        if (stopRow(ramp, i, selected) == StopAction::None) continue;
        ramp.erase(ramp.begin() + static_cast<std::ptrdiff_t>(i));
        if (selected >= static_cast<int>(i)) --selected;
        break;
    }
}

void rampEditor(const EditorView& view, SurfacePanelState& state, SurfaceSettings& surface) {
    Ramp& ramp = surface.ramp;
    const HeightRange heights = heightsOf(view, surface.seaLevelM);
    presetButtons(heights, ramp);
    state.selectedStop = std::min(state.selectedStop, static_cast<int>(ramp.size()) - 1);
    std::optional<double> addedM;
    if (ramp.empty()) {
        wrappedText("The built-in ramp is used.", palette().dim);
    } else {
        addedM = previewBar(ramp, state.selectedStop);
        rampStops(ramp, state.selectedStop);
    }
    beginGrey(ramp.size() >= maxRampStops, "The ramp is full.");
    const std::string explanation = fmt::format(
        "Adds a stop after the selected one, or above the last, with the current ramp colour; at most {} "
        "stops.",
        maxRampStops);
    if (button("Add a stop", explanation.c_str())) {
        const std::size_t after =
            state.selectedStop >= 0 ? static_cast<std::size_t>(state.selectedStop) : ramp.size() - 1;
        addedM = ramp.empty() ? 0 : heightAfter(ramp, after);
    }
    endGrey();
    if (!addedM || ramp.size() >= maxRampStops) return;
    if (ramp.empty()) ramp = greyRamp(heights.lowestM, heights.highestM);
    state.selectedStop = static_cast<int>(addStop(ramp, *addedM));
}

}  // namespace

void surfacePanel(const EditorView& view, SurfacePanelState& state, ViewSettings& settings,
                  Commands& commands) {
    const SettingControls control(settings);
    SurfaceSettings& surface = settings.surface;
    if (section("Colour")) colourControls(view, control, surface);
    if (section("Height ramp")) rampEditor(view, state, surface);
    if (section("Sea")) {
        control(surface.sea);
        control(surface.seaLevelM);
    }
    if (section("Relief")) control(surface.exaggeration);
    layersSections(view, state.layers, control, surface, commands);
}

}  // namespace worldy::ui
