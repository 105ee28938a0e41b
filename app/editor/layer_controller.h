// Texture layers in the window: the available layer sets, and the layers under the pointer. Main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/editor/settings_controller.h"
#include "app/editor/viewport.h"
#include "app/scene/scene.h"
#include "app/session/notices.h"
#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/measure/pick.h"
#include "planet/tree/chunk_tree.h"
#include "ui/model/commands.h"
#include "ui/model/layers_view.h"

namespace worldy {

struct LayerFolders {
    std::filesystem::path shipped;
    std::filesystem::path own;  // need not exist yet
};
LayerFolders layerFolders();

struct LayerController {
    LayerFolders folders;
    std::vector<ui::LayerSetFile> sets;
    std::string setProblem;  // of the last load or save
    bool overGround = false;
    std::optional<ui::LayerReadout> under;
};

LayerController openLayers(const LayerFolders& folders = layerFolders());

// Loads a set's layers. On an Error, which names the file, the settings stay as they are.
planet::Result<void> loadInto(LayerController& controller, const std::filesystem::path& file,
                              LayerSettings& layers);

// Saves the layers as a user set, which the settings then name. Replaces a user set of that name, but not a
// shipped one. Names follow the rules for presets.
planet::Result<void> saveAs(LayerController& controller, std::string_view name, LayerSettings& layers);

// Returns the layers at the point where a ray has hit a drawn chunk.
ui::LayerReadout layerReadout(const planet::ChunkTree& tree, const planet::SurfaceHit& hit,
                              const SurfaceSettings& surface);

// scene: null if no planet is open.
ui::LayersView layersViewOf(const LayerController& controller, const Scene* scene,
                            const LayerSettings& layers);

// scene: null if no planet is open. Settings stay as they are during a replay.
void execute(LayerController& controller, const ui::LayerCommand& command, SettingsController& settings,
             Scene* scene, bool replaying, Notices& notices);

// Reads the layers at the ground under the pointer.
void readLayers(LayerController& controller, const Scene& scene, const PlanetPicture& picture,
                const SurfaceSettings& surface);

}  // namespace worldy
