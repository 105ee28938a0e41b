#include "ui/panels/sources/sources_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/text.h"
#include "app/scene/overlay_colours.h"
#include "app/scene/source_lines.h"
#include "planet/source/terrain.h"
#include "ui/kit/item_map.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/source_readings.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/source_text.h"
#include "ui/panels/sources/layer_controls.h"

namespace worldy::ui {

namespace {

constexpr const char* rowDrag = "source layer";

// A row of the list: an edited layer, or one of a source that cannot be edited.
struct LayerRow {
    std::string name;
    const planet::SourceLayer* read = nullptr;   // null until it is read
    const planet::WorldLayer* edited = nullptr;  // null if it cannot be edited
};

// From the bottom up.
std::vector<LayerRow> rowsOf(const SourcesView& sources) {
    std::vector<LayerRow> rows;
    if (sources.edit) {
        for (std::size_t i = 0; i < sources.edit->layers.size(); ++i) {
            const planet::WorldLayer& layer = sources.edit->layers[i];
            rows.push_back({layer.name, descriptionOf(sources, i), &layer});
        }
    } else if (sources.layers) {
        for (const planet::SourceLayer& layer : sources.layers->layers) rows.push_back({layer.name, &layer});
    }
    return rows;
}

// A request of the list.
struct ListRequest {
    std::optional<std::size_t> switched;
    std::optional<std::pair<std::size_t, std::size_t>> moved;  // from, to
    std::optional<std::size_t> shown;                          // fly there
};

void dragLayer(const LayerRow& row, std::size_t index, ListRequest& request) {
    if (!row.edited) return;
    if (ImGui::BeginDragDropSource()) {
        ImGui::SetDragDropPayload(rowDrag, &index, sizeof(index));
        ImGui::TextUnformatted(row.name.c_str());
        ImGui::EndDragDropSource();
    }
    if (!ImGui::BeginDragDropTarget()) return;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(rowDrag))
        request.moved = {*static_cast<const std::size_t*>(payload->Data), index};
    ImGui::EndDragDropTarget();
}

void chip(const SourcesView& sources, const LayerRow& row) {
    const float side = std::round(ImGui::GetTextLineHeight() * 0.8f);
    const glm::vec3 colour =
        row.read ? layerColour(static_cast<std::size_t>(row.read - sources.layers->layers.data()))
                 : unmeasuredColour;
    ImGui::ColorButton("##chip", {colour.x, colour.y, colour.z, 1},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    tooltip("Colour of the layer's outline and of the tint by source; grey until the layer is read.");
}

const char* kindOf(const LayerRow& row) {
    if (row.read) return kindText(row.read->kind);
    if (!row.edited) return "";
    const planet::WorldLayer& layer = *row.edited;
    return !layer.detail.empty() ? "detail" : !layer.terrain.empty() ? "terrain" : "files";
}

void layerRow(const EditorView& view, const LayerRow& row, std::size_t index, SourcesPanelState& state,
              ListRequest& request) {
    ImGui::TableNextColumn();
    chip(view.sources, row);
    ImGui::SameLine();
    bool on = !row.edited || row.edited->on;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
    beginGrey(!row.edited, "The layers of this source cannot be edited.");
    if (ImGui::Checkbox("##on", &on)) request.switched = index;
    noteItem("on " + row.name);
    tooltip(
        "Switches the layer on or off. A layer that is off is not baked. It stays in a saved world file.");
    endGrey();
    ImGui::PopStyleVar();
    ImGui::TableNextColumn();
    const bool broken = row.read && !row.read->skipped.empty();
    ImGui::PushStyleColor(ImGuiCol_Text, broken ? palette().bad : on ? palette().text : palette().dim);
    if (ImGui::Selectable((row.name + "##row").c_str(), state.chosen == index,
                          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick |
                              ImGuiSelectableFlags_AllowItemOverlap)) {
        state.chosen = index;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) request.shown = index;
    }
    ImGui::PopStyleColor();
    noteItem("layer " + row.name);
    dragLayer(row, index, request);
    tooltip([&] {
        return fmt::format(
            "{}\nClick to select, double-click to fly to the middle of what it covers, drag to move.",
            row.read ? row.read->about : "Not read yet.");
    });
    const double radiusM = view.planet->tree().shape.radiusM;
    const ImVec4& dim = palette().dim;
    cell(row.read ? spacingText(*row.read, radiusM) : "", dim);
    cell(row.read ? voidsText(*row.read) : "", dim);
    cell(row.edited ? joinText(row.edited->join) : row.read ? joinText(row.read->join) : "", dim);
    cell(kindOf(row), dim);
    cell(broken ? fmt::format("{}", row.read->skipped.size()) : "", palette().bad);
}

ListRequest layerList(const EditorView& view, const std::vector<LayerRow>& rows, SourcesPanelState& state) {
    const std::array columns = {
        TableColumn{"##on", 0, nullptr, "mmm", false},
        TableColumn{"Layer", 1, "The top layer first.", "mmmmmmmmmm", false},
        TableColumn{"Spacing", 0, "Distance between the finest samples, at the planet's radius.", nullptr,
                    false},
        TableColumn{"Voids", 0, "Share of the samples without a height.", nullptr, false},
        TableColumn{"Join", 0, "How the layer joins what lies under it.", "replace", false},
        TableColumn{"Kind", 0, nullptr, "six faces", false},
        TableColumn{"Broken", 0, "Files that could not be read and were left out.", nullptr, false}};
    ListRequest request;
    if (!beginListTable("source layers", columns, rows.size())) return request;
    for (std::size_t i = rows.size(); i-- > 0;)
        tableRow(i, [&] { layerRow(view, rows[i], i, state, request); });
    const double radiusM = view.planet->tree().shape.radiusM;
    const auto spacing = [=](const LayerRow& row) {
        return row.read && row.read->spacingRad > 0 ? ExportCell(row.read->spacingRad * radiusM)
                                                    : ExportCell();
    };
    const auto voids = [](const LayerRow& row) {
        return row.read && row.read->sampleCount > 0
                   ? ExportCell(static_cast<double>(row.read->missingCount) /
                                static_cast<double>(row.read->sampleCount))
                   : ExportCell();
    };
    endTable(exportTable<LayerRow>(
        "source layers", rows.size(), [&](std::size_t row) { return rows[row]; },
        {{"on", [](const LayerRow& row) { return !row.edited || row.edited->on; }},
         {"layer", [](const LayerRow& row) { return row.name; }, true},
         {"spacing_m", spacing},
         {"void_share", voids},
         {"join",
          [](const LayerRow& row) {
              return row.edited ? joinText(row.edited->join) : row.read ? joinText(row.read->join) : "";
          }},
         {"kind", kindOf},
         {"broken_files", [](const LayerRow& row) {
              return row.read ? ExportCell(row.read->skipped.size()) : ExportCell();
          }}}));
    return request;
}

void moveSourceLayer(WorldEdit& edit, std::size_t from, std::size_t to) {
    if (from >= edit.layers.size() || to >= edit.layers.size() || from == to) return;
    planet::WorldLayer layer = std::move(edit.layers[from]);
    edit.layers.erase(edit.layers.begin() + static_cast<std::ptrdiff_t>(from));
    edit.layers.insert(edit.layers.begin() + static_cast<std::ptrdiff_t>(to), std::move(layer));
}

void obeyList(const EditorView& view, const std::vector<LayerRow>& rows, const ListRequest& request,
              SourcesPanelState& state, Commands& commands) {
    if (request.shown && rows[*request.shown].read)
        commands.emplace_back(MoveCamera{poseOver(*rows[*request.shown].read, view.planet->tree()), true});
    if (!view.sources.edit || (!request.switched && !request.moved)) return;
    WorldEdit edit = *view.sources.edit;
    if (request.switched) edit.layers[*request.switched].on = !edit.layers[*request.switched].on;
    if (request.moved) {
        moveSourceLayer(edit, request.moved->first, request.moved->second);
        state.chosen = request.moved->second;
    }
    commands.emplace_back(EditLayers{std::move(edit)});
}

void moveButtons(const EditorView& view, const std::vector<LayerRow>& rows, SourcesPanelState& state,
                 Commands& commands) {
    const bool canEdit = view.sources.edit != nullptr;
    ListRequest request;
    beginGrey(!canEdit || state.chosen + 1 >= rows.size(), "The selected layer is the topmost.");
    if (button("Up", "Moves the selected layer up, over the next one."))
        request.moved = {state.chosen, state.chosen + 1};
    endGrey();
    sameLineForButton("Down");
    beginGrey(!canEdit || state.chosen == 0, "The selected layer is the lowest.");
    if (button("Down", "Moves the selected layer down, under the next one."))
        request.moved = {state.chosen, state.chosen - 1};
    endGrey();
    sameLineForButton("Fly there");
    const bool known = state.chosen < rows.size() && rows[state.chosen].read;
    beginGrey(!known, "The layer is not read yet.");
    if (button(
            "Fly there",
            "Moves the camera over the middle of what the layer covers. Double-clicking it does the same."))
        request.shown = state.chosen;
    endGrey();
    obeyList(view, rows, request, state, commands);
}

std::string greyReason(const SourcesView& sources) {
    if (sources.baking) return "A bake is running.";
    if (!sources.edited) return "The planet was baked from these layers.";
    return sources.bakeProblem.empty() ? std::string() : "The layers cannot be baked as they are.";
}

void bakeButtons(const SourcesView& sources, Commands& commands) {
    const std::string reason = greyReason(sources);
    beginGrey(!reason.empty(), reason.c_str());
    if (button("Bake",
               "Bakes the changed layers in the background, with the chunk size, the radius and the colours "
               "of the open "
               "file. The planet stays usable; the Bake panel shows the progress."))
        commands.emplace_back(BakeLayers{});
    endGrey();
    sameLineForButton("Revert");
    beginGrey(!sources.edited && !sources.unsaved, "Nothing is changed.");
    if (button("Revert", sources.edited ? "Restores the layers that the planet was baked from."
                                        : "Restores the layers as they were opened or saved last."))
        commands.emplace_back(RevertLayers{});
    endGrey();
    if (sources.edited && sources.bakeProblem.empty())
        wrappedText("The layers are changed. The planet shows them after a bake.", palette().warning);
    if (!sources.bakeProblem.empty()) wrappedText(sources.bakeProblem, palette().bad);
}

void brokenFiles(const planet::SourceLayer& layer) {
    if (layer.skipped.empty()) return;
    wrappedText(fmt::format("{} broken {} left out:", layer.skipped.size(),
                            layer.skipped.size() == 1 ? "file was" : "files were"),
                palette().bad);
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < std::min(most, layer.skipped.size()); ++i)
        wrappedText(layer.skipped[i], palette().text);
    if (layer.skipped.size() > most)
        wrappedText(fmt::format("and {} more", layer.skipped.size() - most), palette().dim);
}

void layerFacts(const EditorView& view, const planet::SourceLayer& layer) {
    if (!beginValues("layer facts")) return;
    valueRow("Samples", layer.sampleCount == 0 ? "none" : countText(static_cast<double>(layer.sampleCount)),
             "Number of samples of the files.");
    valueRow("Voids", voidsText(layer), "Share of the samples without a height.");
    valueRow("Spacing", spacingText(layer, view.planet->tree().shape.radiusM),
             "Distance between the finest samples, at the planet's radius.");
    valueRow("Covers", layer.coversPlanet ? "the planet" : countedText(layer.outlines.size(), "area"),
             "Whether the layer covers the planet, or how many outlines it has.");
    endValues();
}

void chosenLayer(const EditorView& view, const std::vector<LayerRow>& rows, std::size_t chosen,
                 Commands& commands) {
    const LayerRow& row = rows[chosen];
    if (!section(fmt::format("{}###chosen layer", row.name).c_str())) return;
    if (row.read) {
        wrappedText(row.read->about, palette().dim);
        layerFacts(view, *row.read);
    }
    if (row.edited) {
        planet::WorldLayer layer = *row.edited;
        if (sourceLayerControls(layer, view.sources.edit->datum)) {
            WorldEdit edit = *view.sources.edit;
            edit.layers[chosen] = std::move(layer);
            commands.emplace_back(EditLayers{std::move(edit)});
        }
    }
    if (row.read) brokenFiles(*row.read);
}

// Returns a file beside the source; in the current folder for terrain.
std::filesystem::path proposedFile(const std::filesystem::path& source) {
    if (planet::isTerrainText(source)) return "world.toml";
    const bool isPattern = source.string().find_first_of("*?[|") != std::string::npos;
    return source.parent_path() / (isPattern ? "world.toml" : source.stem().string() + "-edited.toml");
}

void saveControls(const SourcesView& sources, SourcesPanelState& state, Commands& commands) {
    if (!section("Save as a world file")) return;
    if (state.saveAsOf != sources.source) {
        state.saveAsOf = sources.source;
        const std::string text = proposedFile(sources.source).string();
        state.saveAs.fill('\0');
        std::copy_n(text.begin(), std::min(text.size(), state.saveAs.size() - 1), state.saveAs.begin());
    }
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##saveAs", "folder/world.toml", state.saveAs.data(), state.saveAs.size());
    noteItem("File");
    beginGrey(!sources.bakeProblem.empty() || state.saveAs[0] == '\0',
              "The layers cannot be saved as they are.");
    if (button("Save as",
               "Writes the layers as a world file, with paths relative to its folder where possible. Layers "
               "that "
               "are off are saved as such. You are asked before a file is replaced."))
        commands.emplace_back(SaveLayers{state.saveAs.data()});
    const bool asks = !sources.replaces.empty() && sources.replaces == state.saveAs.data();
    if (asks) {
        wrappedText(fmt::format("{} exists. Saving replaces it, and its comments are lost.",
                                sources.replaces.filename().string()),
                    palette().warning);
        if (button("Replace it", "Writes the layers into this file."))
            commands.emplace_back(SaveLayers{state.saveAs.data(), true});
    }
    endGrey();
}

}  // namespace

void sourcesPanel(const EditorView& view, SourcesPanelState& state, ViewSettings& settings,
                  Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to see what it was baked from.");
    const SourcesView& sources = view.sources;
    if (sources.state == SourcesView::State::Unknown) return emptyState(stateText(sources).c_str());
    wrappedText(sourceName(sources.source), palette().text);
    if (sources.state != SourcesView::State::Read) {
        const bool failed = sources.state == SourcesView::State::Failed;
        wrappedText(stateText(sources), failed ? palette().bad : palette().dim);
        if (failed && button("Try again", "Reads the source again.")) commands.emplace_back(ReadSource{});
    }
    if (!sources.editProblem.empty()) wrappedText(sources.editProblem, palette().warning);
    const std::vector<LayerRow> rows = rowsOf(sources);
    if (rows.empty()) return;
    state.chosen = std::min(state.chosen, rows.size() - 1);
    obeyList(view, rows, layerList(view, rows, state), state, commands);
    moveButtons(view, rows, state, commands);
    if (sources.edit) bakeButtons(sources, commands);
    const SettingControls control(settings);
    control(settings.overlay.sources);
    chosenLayer(view, rows, state.chosen, commands);
    if (section("Under the pointer"))
        sourceReadings("pointed", sources, sources.pointed, "Point at the ground in the viewport.", commands);
    if (sources.edit) saveControls(sources, state, commands);
}

}  // namespace worldy::ui
