// The state of texture layers for the Surface panel, besides their settings.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/surface/layer_set.h"

namespace worldy::ui {

struct LayerSetFile {
    std::string name;  // without the folder and ".toml"
    std::filesystem::path file;
    bool shipped = false;  // comes with Worldy and is read-only
};

// The layers' weights at a point of the ground, as computed by the library.
struct LayerReadout {
    planet::LayerPlace place;
    planet::LayerValues weights{};
};

struct LayersView {
    std::vector<std::string> problems;  // of each layer; empty: none
    std::vector<glm::vec3> colours;  // mean colour of each layer's textures, sRGB; none before they are read
    std::span<const LayerSetFile> sets;
    std::string setProblem;             // why the last set was not read or written
    bool overGround = false;            // the pointer is over the ground now
    std::optional<LayerReadout> under;  // below the pointer, or at its last position over the ground
};

}  // namespace worldy::ui
