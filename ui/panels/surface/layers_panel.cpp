#include "ui/panels/surface/layers_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>

#include "ui/kit/feature_control.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/surface/layer_controls.h"
#include "ui/panels/surface/layer_edit.h"

namespace worldy::ui {

namespace {

using planet::TextureLayer;
using planet::gl::LayerPreview;

constexpr const char* dragKind = "texture layer";

void useControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface,
                 Commands& commands) {
    LayerSettings& layers = surface.layers;
    featureControl(control, CostlyPart::Layers, view, surface, commands);
    control(layers.opacity);
    control(layers.beginM);
    control(layers.endM);
    layers.beginM = std::min(layers.beginM, layers.endM);
    control(layers.colourBelow);
}

void blendControls(const SettingControls& control, LayerSettings& layers) {
    control(layers.set.blend);
    beginGrey(layers.set.blend == planet::LayerBlend::Weight, "Blend by height first.");
    control(layers.set.blendDepth);
    endGrey();
}

void previewControl(const LayersPanelState& state, const SettingControls& control, LayerSettings& layers) {
    control(layers.preview);
    if (layers.preview != LayerPreview::Off) layers.previewed = static_cast<int>(state.chosen) + 1;
}

// Moves a layer by dragging its row to another's.
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

// Draws a one-letter button that toggles a value and is lit while it is set.
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
    ImGui::TableNextColumn();
    const glm::vec3 known = index < view.layers.colours.size() ? view.layers.colours[index] : glm::vec3(0.5f);
    const glm::vec3 colour = known * layer.tint;
    const float side = ImGui::GetTextLineHeight();
    ImGui::ColorButton("##chip", {colour.r, colour.g, colour.b, 1},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    tooltip("Average colour of the textures including the tint; grey until they are loaded.");
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
                  : "Click to select the layer; drag it onto another to move it. It is drawn over the layers "
                    "below it.");
    ImGui::TableNextColumn();
    if (view.layers.under)
        ImGui::TextColored(palette().dim, "%3.0f %%", 100 * view.layers.under->weights[index]);
    tooltip("Weight of the layer at the last ground position of the pointer.");
    ImGui::TableNextColumn();
    letterSwitch("M", fmt::format("mute {}", layer.name), layer.muted, palette().warning,
                 "Mute: hides the layer.");
    ImGui::SameLine();
    letterSwitch("S", fmt::format("solo {}", layer.name), layer.solo, palette().accent,
                 "Solo: while any layer is solo, only solo layers are drawn.");
}

// The weights are those of the column: under the pointer.
ExportTable layerExport(const EditorView& view, const LayerSettings& layers) {
    const planet::LayerSet& set = layers.set;
    using Row = std::size_t;
    const auto of = [&set](auto TextureLayer::*value) {
        return [&set, value](Row row) { return ExportCell(set.layers[row].*value); };
    };
    const auto weight = [&view](Row row) {
        return view.layers.under ? ExportCell(view.layers.under->weights[row]) : ExportCell();
    };
    return exportTable<Row>("texture layers", set.layers.size(), [](Row row) { return row; },
                            {{"from_bottom", [](Row row) { return row + 1; }, true},
                             {"layer", of(&TextureLayer::name)},
                             {"drawn", [&set](Row row) { return planet::isDrawn(set, row); }},
                             {"muted", of(&TextureLayer::muted)},
                             {"solo", of(&TextureLayer::solo)},
                             {"opacity", of(&TextureLayer::opacity)},
                             {"scale_m", of(&TextureLayer::scaleM)},
                             {"weight_under_pointer", weight}});
}

// Draws the list with the highest layer first.
void layerList(const EditorView& view, LayersPanelState& state, LayerSettings& layers) {
    if (layers.set.layers.empty()) {
        wrappedText("There are no layers. Add one or load a set.", palette().dim);
        return;
    }
    std::optional<std::pair<std::size_t, std::size_t>> moved;
    if (!beginPlainTable("layers", 4, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("chip");
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("weight");
    ImGui::TableSetupColumn("switches");
    for (std::size_t i = layers.set.layers.size(); i-- > 0;)
        tableRow(i, [&] { layerRow(view, i, state, layers, moved); });
    endTable(layerExport(view, layers));
    if (!moved || moved->first >= layers.set.layers.size()) return;
    moveLayer(layers.set.layers, moved->first, moved->second);
    state.chosen = moved->second;
}

void listButtons(LayersPanelState& state, LayerList& list) {
    const bool full = list.size() >= planet::maxLayers;
    const std::size_t last = list.empty() ? 0 : list.size() - 1;
    beginGrey(full, "The maximum of eight layers is reached.");
    if (button("Add", full ? "The maximum of eight layers is reached."
                           : "Adds a layer without textures above all others."))
        state.chosen = addLayer(list);
    endGrey();
    sameLineForButton("Copy");
    beginGrey(full || list.empty(),
              full ? "The maximum of eight layers is reached." : "There is no layer to copy.");
    if (button("Copy", "Duplicates the selected layer above it."))
        state.chosen = duplicateLayer(list, state.chosen);
    endGrey();
    sameLineForButton("Remove");
    beginGrey(list.empty(), "There is no layer to remove.");
    if (button("Remove", "Removes the selected layer. Undo restores it."))
        state.chosen = removeLayer(list, state.chosen);
    endGrey();
    sameLineIfRoom(4 * ImGui::GetFontSize());
    beginGrey(list.empty() || state.chosen >= last, "The selected layer is the topmost.");
    if (button("Up", "Moves the selected layer up.")) {
        moveLayer(list, state.chosen, state.chosen + 1);
        ++state.chosen;
    }
    endGrey();
    sameLineForButton("Down");
    beginGrey(list.empty() || state.chosen == 0, "The selected layer is the lowest.");
    if (button("Down", "Moves the selected layer down.")) {
        moveLayer(list, state.chosen, state.chosen - 1);
        --state.chosen;
    }
    endGrey();
}

// Shows the layers' weights under the pointer, and the weight of the planet's own colour.
void readout(const EditorView& view, const LayerSettings& layers) {
    if (!view.layers.under) {
        wrappedText("Point at the ground in the viewport.", palette().dim);
        return;
    }
    const LayerReadout& under = *view.layers.under;
    if (!beginValues("readout")) return;
    valueRow("Height", fmt::format("{:.0f} m", under.place.heightM),
             "Height above sea level, without exaggeration.");
    valueRow("Slope", fmt::format("{:.1f}°", under.place.slopeDeg),
             "Slope of the drawn heights used by the layers, without exaggeration.");
    valueRow("Latitude", fmt::format("{:.2f}°", under.place.latitudeDeg), "Latitude, north positive.");
    double rest = 1;
    for (std::size_t i = layers.set.layers.size(); i-- > 0;) {
        rest -= under.weights[i];
        const ImVec4& colour = under.weights[i] >= 0.005 ? palette().text : palette().dim;
        valueRow(layers.set.layers[i].name.c_str(), fmt::format("{:.1f} %", 100 * under.weights[i]),
                 "Opacity x height x slope x latitude, including noise, minus the coverage of the layers "
                 "above, before height blending and distance fading.",
                 &colour);
    }
    valueRow("Image or ramp", fmt::format("{:.1f} %", 100 * std::max(rest, 0.0)),
             "Weight not covered by any layer.");
    endValues();
}

void loadControl(const EditorView& view, LayersPanelState& state, const LayerSettings& layers,
                 Commands& commands) {
    const std::string now =
        layers.file.empty() ? "earth" : std::filesystem::path(layers.file).stem().string();
    labelledControl("Load", "Replaces the layers by a saved set. Undo restores them.");
    if (!ImGui::BeginCombo("##sets", now.c_str())) {
        noteItem("Load set");
        return;
    }
    for (const LayerSetFile& set : view.layers.sets) {
        const std::string label = fmt::format("{}{}", set.name, set.shipped ? "" : "  (user)");
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
    // A rejected name stays in the field for correction; the message box says why it was rejected.
    if (state.saving && view.layers.setProblem.empty()) state.newName.fill(0);
    state.saving = false;
    const float room = ImGui::CalcTextSize("Save").x + 2 * ImGui::GetStyle().FramePadding.x +
                       ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - room, ImGui::GetFontSize() * 4));
    ImGui::InputTextWithHint("##newSet", "Set name", state.newName.data(), state.newName.size());
    noteItem("Set name");
    tooltip(
        "Used as the file name: letters, digits, spaces, dots and dashes, up to 60 bytes. A set of your own "
        "with this name is replaced.");
    ImGui::SameLine();
    beginGrey(state.newName[0] == 0, "Type a name first.");
    if (button("Save##set", "Saves the layers as a TOML file.")) {
        commands.push_back(SaveLayerSet{state.newName.data()});
        state.saving = true;
    }
    endGrey();
}

}  // namespace

void layersSections(const EditorView& view, LayersPanelState& state, const SettingControls& control,
                    SurfaceSettings& surface, Commands& commands) {
    LayerSettings& layers = surface.layers;
    LayerList& list = layers.set.layers;
    ImGui::PushID("layers");
    if (section("Texture layers")) {
        useControls(view, control, surface, commands);
        layerList(view, state, layers);
        state.chosen = std::min(state.chosen, list.empty() ? 0 : list.size() - 1);
        listButtons(state, list);
        blendControls(control, layers);
        previewControl(state, control, layers);
        setFiles(view, state, layers, commands);
    }
    state.chosen = std::min(state.chosen, list.empty() ? 0 : list.size() - 1);
    if (!list.empty() && section(fmt::format("Layer: {}###layer", list[state.chosen].name).c_str())) {
        const bool wrong = state.chosen < view.layers.problems.size();
        layerControls(list[state.chosen], wrong ? view.layers.problems[state.chosen] : std::string(),
                      commands);
    }
    if (section(view.layers.overGround || !view.layers.under ? "Weights###weights"
                                                             : "Last weights###weights"))
        readout(view, layers);
    ImGui::PopID();
}

}  // namespace worldy::ui
