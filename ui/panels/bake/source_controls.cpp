#include "ui/panels/bake/source_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

namespace fs = std::filesystem;
using planet::TerrainField;
using planet::TerrainKind;
using planet::TerrainSettings;

// Returns the kinds that need no other source.
std::span<const TerrainKind> madeKinds() {
    return planet::terrainKinds().first(planet::terrainKinds().size() - 1);
}

std::string problemOf(const fs::path& source) {
    if (source.empty()) return "Enter the source to bake.";
    if (planet::isTerrainText(source)) {
        const auto terrain = planet::terrainFromText(source);
        if (!terrain) return terrain.error().message;
        if (!terrain->of.empty()) return problemOf(terrain->of);
        return {};
    }
    return planet::heightSourceExists(source) ? std::string() : "No such image or cube faces.";
}

void setFile(const fs::path& file, SourceEdit& edit) {
    const std::string text = file.string();
    edit.fileText.fill(0);
    std::copy_n(text.begin(), std::min(text.size(), edit.fileText.size() - 1), edit.fileText.begin());
}

// Sets kind and parameters from a source without added detail. A text that cannot be parsed is shown as a
// file path.
void setPlain(const fs::path& source, SourceEdit& edit) {
    const auto terrain = planet::terrainFromText(source);
    if (!planet::isTerrainText(source) || !terrain) {
        edit.kind = 0;
        setFile(source, edit);
        return;
    }
    const std::size_t index = terrain->settings.index();
    edit.kind = static_cast<int>(index) + 1;
    edit.made[index] = terrain->settings;
}

std::uint32_t newSeed() {
    static std::random_device device;
    return device() % 1'000'000;  // short enough to read out and type
}

bool seedControl(const TerrainField& field, TerrainSettings& settings) {
    auto seed = static_cast<std::uint32_t>(field.get(settings));
    labelledControl("Seed", std::string(field.about).c_str());
    const float room = ImGui::CalcTextSize("New seed").x + 2 * ImGui::GetStyle().FramePadding.x +
                       ImGui::GetStyle().ItemSpacing.x + 1;
    ImGui::SetNextItemWidth(std::max(ImGui::GetFontSize() * 3, ImGui::GetContentRegionAvail().x - room));
    bool changed = ImGui::InputScalar("##seed", ImGuiDataType_U32, &seed);
    noteItem("Seed");
    tooltip(std::string(field.about).c_str());
    sameLineIfRoom(ImGui::CalcTextSize("New seed").x + 2 * ImGui::GetStyle().FramePadding.x);
    if (button("New seed", "Picks another seed for the same kind of terrain.")) {
        seed = newSeed();
        changed = true;
    }
    if (changed) field.set(settings, seed);
    return changed;
}

std::string formatOf(const TerrainField& field) {
    const std::string unit =
        field.unit.empty() ? "" : (field.unit == "°" ? "" : " ") + std::string(field.unit);
    return (field.whole ? "%d" : "%.4g") + unit;
}

bool fieldControl(const TerrainField& field, const TerrainSettings& defaults, TerrainSettings& settings) {
    if (field.name == "seed") return seedControl(field, settings);
    const std::string label(field.label);
    const std::string about = fmt::format("{} Range [{}, {}]{}{}.", field.about, field.least, field.most,
                                          field.unit.empty() || field.unit == "°" ? "" : " ", field.unit);
    const std::string format = formatOf(field);
    const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
    if (field.whole) {
        int value = static_cast<int>(field.get(settings));
        const bool changed = slider(label.c_str(), value, static_cast<int>(field.get(defaults)),
                                    static_cast<int>(field.usualLeast), static_cast<int>(field.usualMost),
                                    format.c_str(), about.c_str(), flags);
        if (changed) field.set(settings, value);
        return changed;
    }
    double value = field.get(settings);
    const bool changed = slider(label.c_str(), value, field.get(defaults), field.usualLeast, field.usualMost,
                                format.c_str(), about.c_str(), flags);
    if (changed) field.set(settings, value);
    return changed;
}

bool fieldControls(const TerrainKind& kind, TerrainSettings& settings) {
    bool changed = false;
    ImGui::PushID(std::string(kind.name).c_str());
    for (const TerrainField& field : kind.fields) changed |= fieldControl(field, kind.defaults, settings);
    ImGui::PopID();
    return changed;
}

bool worldControl(const EditorView& view, SourceEdit& edit, BakeRequest& request) {
    if (view.bake.worlds.empty()) return false;
    constexpr const char* explanation =
        "Built-in sources with their radius and face size. You can change the settings below afterwards.";
    labelledControl("Preset", explanation);
    const auto is = [&](const World& world) {
        return world.request.source == request.source &&
               world.request.settings.radiusM == request.settings.radiusM;
    };
    const auto now = std::find_if(view.bake.worlds.begin(), view.bake.worlds.end(), is);
    const bool open =
        ImGui::BeginCombo("##world", now != view.bake.worlds.end() ? now->title.c_str() : "choose");
    if (!open) noteItem("Preset");
    tooltip(explanation);
    if (!open) return false;
    bool changed = false;
    for (const World& world : view.bake.worlds) {
        const bool chosen = ImGui::Selectable(world.title.c_str(), is(world));
        noteItem("Preset: " + world.title);
        tooltip(world.about.c_str());
        if (!chosen) continue;
        request.source = world.request.source;
        request.settings.radiusM = world.request.settings.radiusM;
        request.settings.faceSize = world.request.settings.faceSize;
        request.settings.quantumM.reset();
        request.settings.finestQuantumM.reset();
        request.colour = world.request.colour;
        request.settings.colour = {};
        setSource(request.source, edit);
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

bool kindControl(bool lit, SourceEdit& edit) {
    constexpr const char* explanation =
        "A file: an elevation image or cube faces. The other kinds generate procedural terrain from a seed.";
    litLabel("Source", lit, explanation);
    std::string items("A file");
    items += '\0';
    for (const TerrainKind& kind : madeKinds()) (items += kind.title) += '\0';
    const bool changed = combo("Source", edit.kind, items.c_str());
    tooltip(edit.kind == 0 ? explanation
                           : std::string(madeKinds()[static_cast<std::size_t>(edit.kind) - 1].about).c_str());
    return changed;
}

bool fileControl(SourceEdit& edit) {
    constexpr const char* explanation =
        "Path of an elevation image of the whole planet, of a georeferenced raster such as a GeoTIFF or HGT, "
        "or of "
        "one of six cube faces or their common stem. A pattern such as tiles/*.tif names several rasters, "
        "and a world file (.toml) lists layers. A "
        "terrain "
        "such as noise:ridged,seed=7 can stand here too.";
    labelledControl("File", explanation);
    const bool changed = ImGui::InputTextWithHint("##source", "Image or cube faces", edit.fileText.data(),
                                                  edit.fileText.size());
    noteItem("File");
    tooltip(explanation);
    return changed;
}

bool detailControls(SourceEdit& edit) {
    bool changed =
        checkbox("Add fractal detail", edit.detail, false,
                 "Adds noise below the source's resolution, matching its local roughness; flat ground and "
                 "the sea stay unchanged. Visible only with a face size larger than the natural one.");
    if (!edit.detail) return changed;
    TerrainSettings settings = edit.detailSettings;
    ImGui::Indent(ImGui::GetFontSize() / 2);
    if (fieldControls(planet::terrainKinds().back(), settings)) {
        edit.detailSettings = std::get<planet::DetailTerrain>(settings);
        changed = true;
    }
    ImGui::Unindent(ImGui::GetFontSize() / 2);
    return changed;
}

}  // namespace

void setSource(const fs::path& source, SourceEdit& edit) {
    if (edit.made.empty()) {
        for (const TerrainKind& kind : madeKinds()) edit.made.push_back(kind.defaults);
    }
    const auto terrain = planet::terrainFromText(source);
    edit.detail = planet::isTerrainText(source) && terrain && !terrain->of.empty();
    if (edit.detail) edit.detailSettings = std::get<planet::DetailTerrain>(terrain->settings);
    setPlain(edit.detail ? terrain->of : source, edit);
    edit.problem = problemOf(source);
}

fs::path sourceOf(const SourceEdit& edit) {
    const fs::path plain =
        edit.kind == 0
            ? fs::path(edit.fileText.data())
            : fs::path(planet::terrainText({edit.made[static_cast<std::size_t>(edit.kind) - 1], {}}));
    if (plain.empty() || !edit.detail) return plain;
    return planet::terrainText({edit.detailSettings, plain});
}

bool sourceControls(const EditorView& view, SourceEdit& edit, BakeRequest& request) {
    bool changed = worldControl(view, edit, request);
    const bool lit = request.source != view.bake.current.source;
    bool edited = kindControl(lit, edit);
    if (edited) {  // the new source has its own height range and number of samples
        request.settings.faceSize.reset();
        request.settings.quantumM.reset();
        request.settings.finestQuantumM.reset();
    }
    if (edit.kind == 0) {
        edited |= fileControl(edit);
    } else {
        const auto index = static_cast<std::size_t>(edit.kind) - 1;
        edited |= fieldControls(madeKinds()[index], edit.made[index]);
    }
    edited |= detailControls(edit);
    if (edited) {
        request.source = sourceOf(edit);
        edit.problem = problemOf(request.source);
    }
    if (!edit.problem.empty()) {
        const bool unknown = request.source.empty() && view.planet;
        wrappedText(unknown ? "The file does not record its source. Enter its path here." : edit.problem,
                    palette().warning);
    }
    return changed || edited;
}

}  // namespace worldy::ui
