#include "ui/panels/surface/layer_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

using planet::SoftRange;
using planet::TextureLayer;

// Draws a field for a text of at most 200 bytes.
void textField(const char* label, std::string& text, const char* hint, const char* explanation) {
    std::array<char, 201> buffer{};
    text.copy(buffer.data(), buffer.size() - 1);
    labelledControl(label, explanation);
    ImGui::PushID(label);
    if (ImGui::InputTextWithHint("##text", hint, buffer.data(), buffer.size())) text = buffer.data();
    noteItem(label);
    tooltip(text.empty() ? explanation : text.c_str());
    ImGui::PopID();
}

struct RangeControl {
    const char* label;
    const char* edgeLabel;
    const SoftRange& all;
    double widestEdge;
    const char* format;
    float speed;
    const char* explanation;
    const char* edgeExplanation;
};

void endPoint(const char* id, double& value, double least, double most, const RangeControl& control,
              float width) {
    ImGui::SetNextItemWidth(width);
    ImGui::DragScalar(id, ImGuiDataType_Double, &value, control.speed, &least, &most, control.format,
                      ImGuiSliderFlags_AlwaysClamp);
    tooltip(control.explanation);
}

// Draws both ends of a range, neither of which can pass the other, and the soft edge below them.
void rangeControl(const RangeControl& control, SoftRange& range) {
    ImGui::PushID(control.label);
    const bool isDefault = range == control.all;
    if (!isDefault) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    labelledControl(control.label, control.explanation);
    if (!isDefault) ImGui::PopStyleColor();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = std::max((ImGui::GetContentRegionAvail().x - gap) / 2, 1.0f);
    endPoint("##lowest", range.lowest, control.all.lowest, std::max(range.highest, control.all.lowest),
             control, width);
    noteItem(fmt::format("{} from", control.label));
    ImGui::SameLine(0, gap);
    endPoint("##highest", range.highest, std::min(range.lowest, control.all.highest), control.all.highest,
             control, width);
    noteItem(fmt::format("{} to", control.label));
    ImGui::PopID();
    slider(control.edgeLabel, range.softEdge, 0, 0, control.widestEdge, control.format,
           control.edgeExplanation, ImGuiSliderFlags_Logarithmic);
}

void ranges(TextureLayer& layer) {
    const float heightSpeed =
        static_cast<float>(std::max(0.01 * std::max(std::abs(layer.heightM.lowest), 0.0), 5.0));
    rangeControl(
        {"Height", "Height falloff", planet::allHeightsM, 5000, "%.0f m", std::min(heightSpeed, 50.0f),
         "Height range of the layer in metres above sea level; its weight is 0.5 at each end. With "
         "both ends at their limits it covers all heights. Drag, or Ctrl+click to type.",
         "Width of the transition at each end, in metres. 0: a sharp border."},
        layer.heightM);
    rangeControl({"Slope", "Slope falloff", planet::allSlopesDeg, 60, "%.0f°", 0.2f,
                  "Slope range of the layer in degrees; 0 is level, 90 vertical. Computed from the drawn "
                  "heights, so coarse data has no cliffs.",
                  "Width of the transition at each end, in degrees. 0: a sharp border."},
                 layer.slopeDeg);
    rangeControl({"Latitude", "Latitude falloff", planet::allLatitudesDeg, 60, "%.0f°", 0.3f,
                  "Latitude range of the layer in degrees, north positive.",
                  "Width of the transition at each end, in degrees. 0: a sharp border."},
                 layer.latitudeDeg);
}

void textures(TextureLayer& layer, Commands& commands) {
    if (!ImGui::TreeNode("Textures")) return;
    textField("Albedo", layer.albedo, "a PNG file",
              "PNG file with sRGB colours and an optional relief in the alpha channel. Square, with a "
              "power-of-two side; given relative to the set's file or as an absolute path. All layers are "
              "scaled to the size of the largest.");
    textField("Normal", layer.normal, "none: flat",
              "Normal map: red along columns, green up rows, 128 is flat. None: a flat layer.");
    textField("Roughness", layer.roughness, "none: 0.9",
              "Roughness map: black is glossy, white is matte. None: 0.9.");
    if (button("Reload", "Reloads the textures of all layers, for example after editing them."))
        commands.push_back(ReloadLayerTextures{});
    ImGui::TreePop();
}

}  // namespace

void layerControls(TextureLayer& layer, const std::string& problem, Commands& commands) {
    const TextureLayer defaults;
    if (!problem.empty())
        wrappedText(fmt::format("{}; a checkerboard is drawn instead.", problem), palette().bad);
    textField("Name", layer.name, "Layer name", "Name of the layer, shown in the list.");
    slider("Scale", layer.scaleM, defaults.scaleM, 0.1, 1000, "%.2f m",
           "Size in metres of one repeat of the textures. Larger: coarser near the camera, with less visible "
           "repetition. Farther away the repeat grows automatically.",
           ImGuiSliderFlags_Logarithmic);
    labelledControl("Tint", "Multiplies the albedo; white leaves it unchanged.");
    ImGui::ColorEdit3("##tint", &layer.tint.x, ImGuiColorEditFlags_NoInputs);
    noteItem("Tint");
    tooltip("Multiplies the albedo; white leaves it unchanged.");
    slider("Opacity", layer.opacity, defaults.opacity, 0, 1, "%.2f",
           "Opacity of the layer over the layers below where all its ranges apply.");
    ranges(layer);
    slider("Noise", layer.noiseAmount, defaults.noiseAmount, 0, 4, "%.2f x falloff",
           "How far noise moves the layer's borders, relative to their falloff. 0: borders follow contour "
           "lines. Large: patches.");
    slider("Noise size", layer.noiseSizeM, defaults.noiseSizeM, 1, 100000, "%.0f m",
           "Size of the coarsest noise features in metres. Smaller than a pixel: grain.",
           ImGuiSliderFlags_Logarithmic);
    textures(layer, commands);
}

}  // namespace worldy::ui
