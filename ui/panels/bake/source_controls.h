// The controls of the source that is baked: a file or generated terrain with all its parameters, with
// optional added detail.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "planet/source/terrain.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct SourceEdit {
    int kind = 0;                               // 0: a file; otherwise an element of terrainKinds(), from 1
    std::vector<planet::TerrainSettings> made;  // by kind from 1; each is kept while another is chosen
    bool detail = false;                        // detail is added to the source
    planet::DetailTerrain detailSettings;
    std::array<char, 1024> fileText{};  // the path being typed
    std::string problem;                // why the source cannot be baked; empty: it can
};

// Sets edit from a source.
void setSource(const std::filesystem::path& source, SourceEdit& edit);
// Returns the source that edit describes; empty if there is none.
std::filesystem::path sourceOf(const SourceEdit& edit);

// Draws the controls of world, kind and parameters. Returns true if the request's source has changed, or,
// when a world is chosen, also its radius, face size and colours. Another kind or world resets the quantum to
// automatic. The labels of values that differ from the open file's are lit.
bool sourceControls(const EditorView& view, SourceEdit& edit, BakeRequest& request);

}  // namespace worldy::ui
