#include "ui/layer_knobs.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "ui/item_map.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

using planet::SoftRange;
using planet::TextureLayer;

// A text of at most 200 bytes.
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

struct RangeKnob {
    const char* label;
    const char* edgeLabel;
    const SoftRange& all;
    double widestEdge;
    const char* format;
    float speed;
    const char* explanation;
    const char* edgeExplanation;
};

void endPoint(const char* id, double& value, double least, double most, const RangeKnob& knob, float width) {
    ImGui::SetNextItemWidth(width);
    ImGui::DragScalar(id, ImGuiDataType_Double, &value, knob.speed, &least, &most, knob.format,
                      ImGuiSliderFlags_AlwaysClamp);
    tooltip(knob.explanation);
}

// Both ends, neither past the other, and the edge below them.
void rangeKnob(const RangeKnob& knob, SoftRange& range) {
    ImGui::PushID(knob.label);
    const bool isDefault = range == knob.all;
    if (!isDefault) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    labelledControl(knob.label, knob.explanation);
    if (!isDefault) ImGui::PopStyleColor();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = std::max((ImGui::GetContentRegionAvail().x - gap) / 2, 1.0f);
    endPoint("##lowest", range.lowest, knob.all.lowest, std::max(range.highest, knob.all.lowest), knob,
             width);
    noteItem(fmt::format("{} from", knob.label));
    ImGui::SameLine(0, gap);
    endPoint("##highest", range.highest, std::min(range.lowest, knob.all.highest), knob.all.highest, knob,
             width);
    noteItem(fmt::format("{} to", knob.label));
    ImGui::PopID();
    slider(knob.edgeLabel, range.softEdge, 0, 0, knob.widestEdge, knob.format, knob.edgeExplanation,
           ImGuiSliderFlags_Logarithmic);
}

void ranges(TextureLayer& layer) {
    const float heightSpeed =
        static_cast<float>(std::max(0.01 * std::max(std::abs(layer.heightM.lowest), 0.0), 5.0));
    rangeKnob({"Height", "Height edge", planet::allHeightsM, 5000, "%.0f m", std::min(heightSpeed, 50.0f),
               "Metres above the sea level between which the layer lies; both ends as far as they go: all "
               "heights. An end is where it is half there. Drag, or Ctrl+click to type.",
               "Metres over which it comes and goes, half to either side of an end. 0: a sharp border."},
              layer.heightM);
    rangeKnob({"Slope", "Slope edge", planet::allSlopesDeg, 60, "%.0f deg", 0.2f,
               "Degrees of the ground's slope between which the layer lies; 0 level, 90 upright. From the "
               "drawn heights: coarse data knows no cliffs.",
               "Degrees over which it comes and goes, half to either side of an end. 0: a sharp border."},
              layer.slopeDeg);
    rangeKnob({"Latitude", "Latitude edge", planet::allLatitudesDeg, 60, "%.0f deg", 0.3f,
               "Degrees north between which the layer lies; -90 the south pole, 90 the north pole.",
               "Degrees over which it comes and goes, half to either side of an end. 0: a sharp border."},
              layer.latitudeDeg);
}

void textures(TextureLayer& layer, Commands& commands) {
    if (!ImGui::TreeNode("Textures")) return;
    textField(
        "Albedo", layer.albedo, "a PNG file",
        "sRGB colours, and the relief in the alpha where there is one. Square, a power of two a side; "
        "beside the set's file, or with its whole path. All layers are enlarged to the largest one's size.");
    textField("Normal", layer.normal, "none: even",
              "Normals: red along the columns, green up the rows, 128 even. None: the layer has no bumps.");
    textField("Roughness", layer.roughness, "none: 0.9",
              "Grey: black mirrors the sun, white not at all. None: 0.9.");
    if (button("Read again", "Reads all layers' textures anew, as after a change in another program."))
        commands.push_back(ReloadLayerTextures{});
    ImGui::TreePop();
}

}  // namespace

void layerKnobs(TextureLayer& layer, const std::string& problem, Commands& commands) {
    const TextureLayer defaults;
    if (!problem.empty())
        wrappedText(fmt::format("{}; a checker pattern is drawn in its place.", problem), palette().bad);
    textField("Name", layer.name, "a name", "Only for you to know it by.");
    slider("Scale", layer.scaleM, defaults.scaleM, 0.1, 1000, "%.2f m",
           "Metres that the textures cover once. Larger: coarser near by, and less to be seen of repeats. "
           "From far they are repeated in larger and larger steps by themselves.",
           ImGuiSliderFlags_Logarithmic);
    labelledControl("Tint", "Multiplies the albedo; white leaves it as it is.");
    ImGui::ColorEdit3("##tint", &layer.tint.x, ImGuiColorEditFlags_NoInputs);
    noteItem("Tint");
    tooltip("Multiplies the albedo; white leaves it as it is.");
    slider("Cover", layer.opacity, defaults.opacity, 0, 1, "%.2f",
           "How much of what lies below the layer it covers where its ranges are all met.");
    ranges(layer);
    slider(
        "Noise", layer.noiseAmount, defaults.noiseAmount, 0, 4, "%.2f edges",
        "How far noise moves the layer's borders, in widths of their soft edges. 0: borders follow heights "
        "and slopes as lines on a map do. Large: patches.");
    slider(
        "Noise size", layer.noiseSizeM, defaults.noiseSizeM, 1, 100000, "%.0f m",
        "Metres that the noise's coarse lumps are wide; finer ones are on them. Small beside a pixel: grain.",
        ImGuiSliderFlags_Logarithmic);
    textures(layer, commands);
}

}  // namespace ui
