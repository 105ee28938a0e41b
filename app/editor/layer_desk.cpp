#include "app/editor/layer_desk.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/base/places.h"
#include "app/base/toml_file.h"
#include "app/data/write_check.h"
#include "app/editor/presets.h"
#include "app/scene/scene.h"
#include "app/settings/layer_file.h"
#include "planet/surface/layer_place.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

void listFolder(const fs::path& folder, bool shipped, std::vector<ui::LayerSetFile>& sets) {
    std::error_code status;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
        const fs::path& file = entry.path();
        const std::string name = file.stem().string();
        if (file.extension() == ".toml" && !name.starts_with('.') && isUtf8(name))
            sets.push_back({name, file, shipped});
    }
}

void list(LayerDesk& desk) {
    desk.sets.clear();
    listFolder(desk.folders.shipped, true, desk.sets);
    listFolder(desk.folders.own, false, desk.sets);
    std::sort(desk.sets.begin(), desk.sets.end(), [](const ui::LayerSetFile& a, const ui::LayerSetFile& b) {
        return std::pair(!a.shipped, a.name) < std::pair(!b.shipped, b.name);
    });
}

Result<void> told(LayerDesk& desk, Result<void> result) {
    desk.setProblem = result ? std::string() : result.error().message;
    return result;
}

}  // namespace

LayerFolders layerFolders() {
    return {dataFolder() / "layers", configFolder() / "layers"};
}

LayerDesk openLayerDesk(const LayerFolders& folders) {
    LayerDesk desk;
    desk.folders = folders;
    list(desk);
    return desk;
}

Result<void> loadInto(LayerDesk& desk, const fs::path& file, LayerSettings& layers) {
    Result<planet::LayerSet> set = loadLayerSet(file);
    if (!set) return told(desk, tl::unexpected(set.error()));
    layers.set = std::move(*set);
    layers.file = file.string();
    return told(desk, {});
}

Result<void> saveAs(LayerDesk& desk, std::string_view name, LayerSettings& layers) {
    if (Result<void> good = checkPresetName(name); !good) return told(desk, std::move(good));
    const auto same = std::find_if(desk.sets.begin(), desk.sets.end(), [&](const ui::LayerSetFile& set) {
        return set.shipped && set.name == name;
    });
    if (same != desk.sets.end()) {
        return told(
            desk,
            planet::badInput(fmt::format(
                "The layer set \"{}\" is built-in and cannot be replaced; expected another name", name)));
    }
    const fs::path file = desk.folders.own / fmt::format("{}.toml", name);
    if (Result<void> kind = checkKinds({{file, OutputKind::LayerSet}}); !kind)
        return told(desk, std::move(kind));
    const fs::path folder = layerFolderOf(layers.file);
    if (Result<void> saved = saveLayerSet(layers.set, folder, file); !saved)
        return told(desk, std::move(saved));
    layers.set = movedTo(file.parent_path(), folder, layers.set);
    layers.file = file.string();
    list(desk);
    return told(desk, {});
}

ui::LayerReadout layerReadout(const planet::ChunkTree& tree, const planet::SurfaceHit& hit,
                              const SurfaceSettings& surface) {
    ui::LayerReadout readout;
    readout.place = planet::layerPlace(tree.shape, hit.id, *tree.nodes[hit.node].heights, hit.positionM,
                                       surface.seaLevelM, tree.exaggeration);
    readout.weights = planet::layerWeights(surface.layers.set, readout.place);
    return readout;
}

ui::LayersView layersViewOf(const LayerDesk& desk, const Scene* scene, const LayerSettings& layers) {
    ui::LayersView view;
    view.sets = desk.sets;
    view.setProblem = desk.setProblem;
    view.overGround = desk.overGround;
    view.under = desk.under;
    // The place stays where the pointer was last; the layers may have changed since.
    if (view.under) view.under->weights = planet::layerWeights(layers.set, view.under->place);
    const LayerPictures none;
    const LayerPictures& pictures = scene ? scene->layers : none;
    view.problems = problemsOf(layers.set, pictures);
    view.colours = coloursOf(layers.set, pictures);
    return view;
}

void forgetLayerPictures(Scene* scene) {
    if (scene) scene->layers = {};
}

}  // namespace worldy
