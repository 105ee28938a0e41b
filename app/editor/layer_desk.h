// What the window knows of texture layers beside their settings: the sets there are, and what lies under the
// pointer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/measure/pick.h"
#include "planet/tree/chunk_tree.h"
#include "ui/model/layers_view.h"

namespace worldy {

struct Scene;

struct LayerFolders {
    std::filesystem::path shipped;
    std::filesystem::path own;  // need not exist yet
};
LayerFolders layerFolders();

struct LayerDesk {
    LayerFolders folders;
    std::vector<ui::LayerSetFile> sets;
    std::string setProblem;  // of the last load or save
    bool overGround = false;
    std::optional<ui::LayerReadout> under;
};

LayerDesk openLayerDesk(const LayerFolders& folders = layerFolders());

// Takes a set's layers. On an Error, which names the file, the settings stay as they are.
planet::Result<void> loadInto(LayerDesk& desk, const std::filesystem::path& file, LayerSettings& layers);

// Keeps the layers as one of the user's own sets, over one of that name, which the settings name then. Names
// are as those of presets; shipped sets stay as they are.
planet::Result<void> saveAs(LayerDesk& desk, std::string_view name, LayerSettings& layers);

// Of the point that a ray has hit on a drawn chunk.
ui::LayerReadout layerReadout(const planet::ChunkTree& tree, const planet::SurfaceHit& hit,
                              const SurfaceSettings& surface);

// scene: null while none is open.
ui::LayersView layersViewOf(const LayerDesk& desk, const Scene* scene, const LayerSettings& layers);

// They are read anew when they are next drawn. Nothing to do where there is no scene.
void forgetLayerPictures(Scene* scene);

}  // namespace worldy
