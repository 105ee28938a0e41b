#include "ui/layers_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>

#include "ui/feature_knob.h"
#include "ui/item_map.h"
#include "ui/layer_edit.h"
#include "ui/layer_knobs.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

using planet::TextureLayer;
using planet::gl::LayerPreview;

constexpr const char* dragKind = "texture layer";

void useKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands) {
    LayerSettings& layers = surface.layers;
    const LayerSettings defaults;
    featureKnob("Layers", CostlyPart::Layers, view, surface, commands, "Materials painted on near ground.",
                "layers cost");
    slider("Opacity", layers.opacity, defaults.opacity, 0, 1, "%.2f",
           "Of all layers over the image or the ramp, 0 to 1.");
    slider(
        "Begin to fade", layers.beginM, defaults.beginM, 0, 1e6, "%.0f m",
        "Metres from the eye where the layers begin to give way to the image or ramp. Nearer there are only "
        "layers.",
        ImGuiSliderFlags_Logarithmic);
    slider(
        "Gone at", layers.endM, defaults.endM, 1, 1e7, "%.0f m",
        "Metres from the eye where nothing is left of the layers. Farther: they cost time over more pixels, "
        "and replace what the image knows better.",
        ImGuiSliderFlags_Logarithmic);
    layers.beginM = std::min(layers.beginM, layers.endM);
    slider(
        "Colour below", layers.colourBelow, defaults.colourBelow, 0, 1, "%.2f",
        "How much of the image's or ramp's colour goes through the layers: 0 their own colours, 1 only their "
        "pattern. More: the change from far to near is less seen.");
}

void blendKnobs(LayerSettings& layers) {
    const planet::LayerSet defaults;
    choice(
        "Blend by", layers.set.blend, defaults.blend, "weight\0height\0",
        "How layers share a place. Weight: in shares. Height: the one whose own relief stands higher wins, "
        "so that sand lies between stones.");
    ImGui::BeginDisabled(layers.set.blend == planet::LayerBlend::Weight);
    slider("Blend depth", layers.set.blendDepth, defaults.blendDepth, 0.05, 2, "%.2f",
           "Of height: what lies lower by so much keeps 2 % of its share; relief and weight are 0 to 1 each. "
           "Smaller: sharper borders.");
    ImGui::EndDisabled();
}

void previewKnob(const LayersPanelState& state, LayerSettings& layers) {
    const LayerSettings defaults;
    choice(
        "Preview", layers.preview, defaults.preview, "off\0heat\0mask\0",
        "The chosen layer's weight over the whole planet, near and far. Heat: violet 0, green a half, yellow "
        "1. Mask: black 0, white 1, nothing else.");
    if (layers.preview != LayerPreview::Off) layers.previewed = static_cast<int>(state.chosen) + 1;
}

// Drags a layer's row to another's.
void dragRow(const TextureLayer& layer, std::size_t index,
             std::optional<std::pair<std::size_t, std::size_t>>& moved) {
    if (ImGui::BeginDragDropSource()) {
        ImGui::SetDragDropPayload(dragKind, &index, sizeof(index));
        ImGui::TextUnformatted(layer.name.c_str());
        ImGui::EndDragDropSource();
    }
    if (!ImGui::BeginDragDropTarget()) return;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(dragKind))
        moved = {*static_cast<const std::size_t*>(payload->Data), index};
    ImGui::EndDragDropTarget();
}

// A letter that is lit while it holds.
void letterSwitch(const char* letter, const std::string& item, bool& value, const ImVec4& colour,
                  const char* explanation) {
    ImGui::PushStyleColor(ImGuiCol_Text, value ? colour : palette().dim);
    if (ImGui::SmallButton(letter)) value = !value;
    ImGui::PopStyleColor();
    noteItem(item);
    tooltip(explanation);
}

void layerRow(const EditorView& view, std::size_t index, LayersPanelState& state, LayerSettings& layers,
              std::optional<std::pair<std::size_t, std::size_t>>& moved) {
    TextureLayer& layer = layers.set.layers[index];
    ImGui::PushID(static_cast<int>(index));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const glm::vec3 known = index < view.layers.colours.size() ? view.layers.colours[index] : glm::vec3(0.5f);
    const glm::vec3 colour = known * layer.tint;
    const float side = ImGui::GetTextLineHeight();
    ImGui::ColorButton("##chip", {colour.r, colour.g, colour.b, 1},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    tooltip("The textures' colour on average, tinted; grey before they have been read.");
    ImGui::TableNextColumn();
    const bool drawn = planet::isDrawn(layers.set, index);
    const bool wrong = index < view.layers.problems.size() && !view.layers.problems[index].empty();
    ImGui::PushStyleColor(ImGuiCol_Text, wrong ? palette().bad : drawn ? palette().text : palette().dim);
    const std::string label = fmt::format("{}##row", layer.name.empty() ? "(no name)" : layer.name);
    if (ImGui::Selectable(label.c_str(), state.chosen == index)) state.chosen = index;
    ImGui::PopStyleColor();
    noteItem(fmt::format("layer {}", layer.name));
    dragRow(layer, index, moved);
    tooltip(wrong ? view.layers.problems[index].c_str()
                  : "Click to choose it, drag it onto another to move it there. It is painted over those "
                    "below it.");
    ImGui::TableNextColumn();
    if (view.layers.under)
        ImGui::TextColored(palette().dim, "%3.0f %%", 100 * view.layers.under->weights[index]);
    tooltip("Its weight under the pointer, or where that was last over the ground.");
    ImGui::TableNextColumn();
    letterSwitch("M", fmt::format("mute {}", layer.name), layer.muted, palette().warning,
                 "Mute: leaves the layer out.");
    ImGui::SameLine();
    letterSwitch("S", fmt::format("solo {}", layer.name), layer.solo, palette().accent,
                 "Solo: while any layer is solo, only those are drawn.");
    ImGui::PopID();
}

// The highest layer first, as they lie.
void layerList(const EditorView& view, LayersPanelState& state, LayerSettings& layers) {
    if (layers.set.layers.empty()) {
        wrappedText("There are no layers. Add one, or load a set.", palette().dim);
        return;
    }
    std::optional<std::pair<std::size_t, std::size_t>> moved;
    if (!ImGui::BeginTable("layers", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("chip");
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("weight");
    ImGui::TableSetupColumn("switches");
    for (std::size_t i = layers.set.layers.size(); i-- > 0;) layerRow(view, i, state, layers, moved);
    ImGui::EndTable();
    if (!moved || moved->first >= layers.set.layers.size()) return;
    moveLayer(layers.set.layers, moved->first, moved->second);
    state.chosen = moved->second;
}

void listButtons(LayersPanelState& state, LayerList& list) {
    const bool full = list.size() >= planet::maxLayers;
    const std::size_t last = list.empty() ? 0 : list.size() - 1;
    ImGui::BeginDisabled(full);
    if (button("Add", full ? "There are eight, and no more fit."
                           : "A new layer above all others, without textures yet."))
        state.chosen = addLayer(list);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(full || list.empty());
    if (button("Copy", "The chosen layer once more, above it."))
        state.chosen = duplicateLayer(list, state.chosen);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(list.empty());
    if (button("Remove", "Removes the chosen layer. Undo brings it back."))
        state.chosen = removeLayer(list, state.chosen);
    ImGui::EndDisabled();
    sameLineIfRoom(4 * ImGui::GetFontSize());
    ImGui::BeginDisabled(list.empty() || state.chosen >= last);
    if (button("Up", "Moves the chosen layer over the next one.")) {
        moveLayer(list, state.chosen, state.chosen + 1);
        ++state.chosen;
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(list.empty() || state.chosen == 0);
    if (button("Down", "Moves the chosen layer below the next one.")) {
        moveLayer(list, state.chosen, state.chosen - 1);
        --state.chosen;
    }
    ImGui::EndDisabled();
}

// What is left of the planet's own colour is named too.
void readout(const EditorView& view, const LayerSettings& layers) {
    if (!view.layers.under) {
        wrappedText("Point at the ground in the viewport.", palette().dim);
        return;
    }
    const LayerReadout& under = *view.layers.under;
    if (!beginValues("readout")) return;
    valueRow("Height", fmt::format("{:.0f} m", under.place.heightM),
             "Above the sea level; true, not exaggerated.");
    valueRow("Slope", fmt::format("{:.1f} deg", under.place.slopeDeg),
             "Of the drawn heights around it, as the layers see it; true, not exaggerated.");
    valueRow("Latitude", fmt::format("{:.2f} deg", under.place.latitudeDeg), "North of the equator.");
    double rest = 1;
    for (std::size_t i = layers.set.layers.size(); i-- > 0;) {
        rest -= under.weights[i];
        const ImVec4& colour = under.weights[i] >= 0.005 ? palette().text : palette().dim;
        valueRow(
            layers.set.layers[i].name.c_str(), fmt::format("{:.1f} %", 100 * under.weights[i]),
            "Opacity x height x slope x latitude, noise counted in, less what the layers above it cover. "
            "Before the blend by height and before the fade with distance.",
            &colour);
    }
    valueRow("Image or ramp", fmt::format("{:.1f} %", 100 * std::max(rest, 0.0)), "What no layer covers.");
    endValues();
}

void loadControl(const EditorView& view, LayersPanelState& state, const LayerSettings& layers,
                 Commands& commands) {
    const std::string now =
        layers.file.empty() ? "earth" : std::filesystem::path(layers.file).stem().string();
    labelledControl("Load", "A set to take in place of the layers as they are. Undo brings these back.");
    if (!ImGui::BeginCombo("##sets", now.c_str())) {
        noteItem("Load set");
        return;
    }
    for (const LayerSetFile& set : view.layers.sets) {
        const std::string label = fmt::format("{}{}", set.name, set.shipped ? "" : "  (own)");
        if (ImGui::Selectable(label.c_str())) commands.push_back(LoadLayerSet{set.file});
        noteItem("set: " + set.name);
        tooltip(set.file.string().c_str());
    }
    ImGui::EndCombo();
    noteItem("Load set");
    state.set = now;
}

void setFiles(const EditorView& view, LayersPanelState& state, const LayerSettings& layers,
              Commands& commands) {
    loadControl(view, state, layers, commands);
    const float room = ImGui::CalcTextSize("Save").x + 2 * ImGui::GetStyle().FramePadding.x +
                       ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - room, ImGui::GetFontSize() * 4));
    ImGui::InputTextWithHint("##newSet", "name of a set", state.newName.data(), state.newName.size());
    noteItem("Set name");
    tooltip(
        "A file's name too: letters, digits, spaces, dots and dashes, up to 60 bytes. One of your own of "
        "that name "
        "is replaced.");
    ImGui::SameLine();
    ImGui::BeginDisabled(state.newName[0] == 0);
    if (button("Save##set",
               "Keeps the layers as they are as a TOML file, to be loaded again or sent to others.")) {
        commands.push_back(SaveLayerSet{state.newName.data()});
        state.newName.fill(0);
    }
    ImGui::EndDisabled();
    if (!view.layers.setProblem.empty()) wrappedText(view.layers.setProblem, palette().bad);
}

}  // namespace

void layersSections(const EditorView& view, LayersPanelState& state, SurfaceSettings& surface,
                    Commands& commands) {
    LayerSettings& layers = surface.layers;
    LayerList& list = layers.set.layers;
    ImGui::PushID("layers");
    if (section("Texture layers")) {
        useKnobs(view, surface, commands);
        layerList(view, state, layers);
        state.chosen = std::min(state.chosen, list.empty() ? 0 : list.size() - 1);
        listButtons(state, list);
        blendKnobs(layers);
        previewKnob(state, layers);
        setFiles(view, state, layers, commands);
    }
    state.chosen = std::min(state.chosen, list.empty() ? 0 : list.size() - 1);
    if (!list.empty() && section(fmt::format("Layer: {}###layer", list[state.chosen].name).c_str())) {
        const bool wrong = state.chosen < view.layers.problems.size();
        layerKnobs(list[state.chosen], wrong ? view.layers.problems[state.chosen] : std::string(), commands);
    }
    if (section(view.layers.overGround || !view.layers.under ? "Weights under the pointer###weights"
                                                             : "Weights last under the pointer###weights"))
        readout(view, layers);
    ImGui::PopID();
}

}  // namespace ui
