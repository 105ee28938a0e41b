// What is baked: a file or made terrain with all its parameters, and detail added to either.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "planet/source/terrain.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct SourceEdit {
    int kind = 0;                               // 0: a file; else one of terrainKinds(), from 1
    std::vector<planet::TerrainSettings> made;  // by kind from 1; kept while another one is chosen
    bool detail = false;                        // added to it
    planet::DetailTerrain detailSettings;
    std::array<char, 1024> fileText{};  // being typed
    std::string problem;                // why it cannot be baked; empty: it can
};

// Takes a source apart.
void setSource(const std::filesystem::path& source, SourceEdit& edit);
// Puts it together; empty while there is nothing.
std::filesystem::path sourceOf(const SourceEdit& edit);

// Worlds, kind, parameters. True where the request's source has changed, or with a world its radius, face size and
// colours.
// Another kind or world takes the automatic quantum. Lit where it is not the open file's.
bool sourceControls(const EditorView& view, SourceEdit& edit, BakeRequest& request);

}  // namespace worldy::ui
