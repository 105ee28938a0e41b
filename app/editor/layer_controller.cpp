#include "app/editor/layer_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/base/places.h"
#include "app/base/utf8.h"
#include "app/data/named_files.h"
#include "app/data/write_check.h"
#include "app/session/overloaded.h"
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

void list(LayerController& controller) {
    controller.sets.clear();
    listFolder(controller.folders.shipped, true, controller.sets);
    listFolder(controller.folders.own, false, controller.sets);
    std::sort(controller.sets.begin(), controller.sets.end(),
              [](const ui::LayerSetFile& a, const ui::LayerSetFile& b) {
                  return std::pair(!a.shipped, a.name) < std::pair(!b.shipped, b.name);
              });
}

Result<void> told(LayerController& controller, Result<void> result) {
    controller.setProblem = result ? std::string() : result.error().message;
    return result;
}

}  // namespace

LayerFolders layerFolders() {
    return {dataFolder() / "layers", configFolder() / "layers"};
}

LayerController openLayers(const LayerFolders& folders) {
    LayerController controller;
    controller.folders = folders;
    list(controller);
    return controller;
}

Result<void> loadInto(LayerController& controller, const fs::path& file, LayerSettings& layers) {
    Result<planet::LayerSet> set = loadLayerSet(file);
    if (!set) return told(controller, tl::unexpected(set.error()));
    layers.set = std::move(*set);
    layers.file = file.string();
    return told(controller, {});
}

Result<void> saveAs(LayerController& controller, std::string_view name, LayerSettings& layers) {
    if (Result<void> good = checkFileName(name); !good) return told(controller, std::move(good));
    const auto same =
        std::find_if(controller.sets.begin(), controller.sets.end(),
                     [&](const ui::LayerSetFile& set) { return set.shipped && set.name == name; });
    if (same != controller.sets.end()) {
        return told(
            controller,
            planet::badInput(fmt::format(
                "The layer set \"{}\" is built-in and cannot be replaced; expected another name", name)));
    }
    const fs::path file = controller.folders.own / fmt::format("{}.toml", name);
    if (Result<void> kind = checkKinds({{file, OutputKind::LayerSet}}); !kind)
        return told(controller, std::move(kind));
    const fs::path folder = layerFolderOf(layers.file);
    if (Result<void> saved = saveLayerSet(layers.set, folder, file); !saved)
        return told(controller, std::move(saved));
    layers.set = movedTo(file.parent_path(), folder, layers.set);
    layers.file = file.string();
    list(controller);
    return told(controller, {});
}

ui::LayerReadout layerReadout(const planet::ChunkTree& tree, const planet::SurfaceHit& hit,
                              const SurfaceSettings& surface) {
    ui::LayerReadout readout;
    readout.place = planet::layerPlace(tree.shape, hit.id, *tree.nodes[hit.node].heights, hit.positionM,
                                       surface.seaLevelM, tree.exaggeration);
    readout.weights = planet::layerWeights(surface.layers.set, readout.place);
    return readout;
}

ui::LayersView layersViewOf(const LayerController& controller, const Scene* scene,
                            const LayerSettings& layers) {
    ui::LayersView view;
    view.sets = controller.sets;
    view.setProblem = controller.setProblem;
    view.overGround = controller.overGround;
    view.under = controller.under;
    // The place is kept from the pointer's last position; the layers may have changed since.
    if (view.under) view.under->weights = planet::layerWeights(layers.set, view.under->place);
    const LayerPictures none;
    const LayerPictures& pictures = scene ? scene->layers : none;
    view.problems = problemsOf(layers.set, pictures);
    view.colours = coloursOf(layers.set, pictures);
    return view;
}

void execute(LayerController& controller, const ui::LayerCommand& command, SettingsController& settings,
             Scene* scene, bool replaying, Notices& notices) {
    const auto maySet = [&] { return mayChange("Settings", replaying, notices.log); };
    ViewSettings view = settings.settings.view;
    std::visit(
        Overloaded{
            [&](const ui::LoadLayerSet& load) {
                if (!maySet() || !succeeded(notices, loadInto(controller, load.file, view.surface.layers),
                                            "The layer set cannot be loaded"))
                    return;
                replaceView(settings, std::move(view), "layer set " + load.file.stem().string());
            },
            [&](const ui::SaveLayerSet& save) {
                if (!maySet() || !succeeded(notices, saveAs(controller, save.name, view.surface.layers),
                                            "The layer set was not saved"))
                    return;
                confirm(notices, fmt::format("Layer set saved: {}", view.surface.layers.file));
                replaceView(settings, std::move(view), "layer set saved");
            },
            [&](const ui::ReloadLayerTextures&) {
                if (scene) scene->layers = {};  // read again when next drawn
            },
        },
        command);
}

void readLayers(LayerController& controller, const Scene& scene, const PlanetPicture& picture,
                const SurfaceSettings& surface) {
    controller.overGround = false;
    if (!picture.shown() || !picture.pointer.over) return;
    const planet::ChunkTree& tree = scene.planet->tree();
    const std::optional<planet::SurfaceHit> hit =
        planet::pickSurface(tree, scene.planet->selection().draw, picture.view.eyeM,
                            rayThrough(picture.view, picture.pointer.positionPx));
    controller.overGround = hit.has_value();
    if (hit) controller.under = layerReadout(tree, *hit, surface);
}

}  // namespace worldy
