// What the Surface panel shows of texture layers beside their settings.
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
    bool shipped = false;  // came with Worldy and stays as it is
};

// The layers' weights at a point of the ground, by the library's own reckoning.
struct LayerReadout {
    planet::LayerPlace place;
    planet::LayerValues weights{};
};

struct LayersView {
    std::vector<std::string> problems;  // of each layer; empty: none
    std::vector<glm::vec3> colours;  // of each layer's textures on average, sRGB; none before they are read
    std::span<const LayerSetFile> sets;
    std::string setProblem;             // why the last set was not read or written
    bool overGround = false;            // the pointer, now
    std::optional<LayerReadout> under;  // it, or where it was last
};

}  // namespace worldy::ui
