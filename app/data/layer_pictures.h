// The textures of layers, from files to the GPU. What is missing or wrong is told once and drawn as a checker
// pattern; the rest goes on.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/draw/chunk_renderer.h"
#include "planet/surface/layer_set.h"

namespace worldy {

// Albedo, normal, roughness, as a layer names them.
using LayerFiles = std::array<std::string, 3>;

// One layer's textures, enlarged to the same size: that of the largest of them. Each must be square and a
// power of two a side, [8, 4096]; an alpha of the albedo is its relief, else it is even. The Error names the
// file, what is wrong and what would be right.
struct LayerTexels {
    int size = 0;
    planet::gl::LayerPicture picture;
};
planet::Result<LayerTexels> readLayerTexels(const std::filesystem::path& folder, const LayerFiles& files);
// To a larger power of two, between texels in straight lines, around the edges.
LayerTexels enlarged(const LayerTexels& texels, int size);

// What a renderer holds of a set, and what is wrong with it.
struct LayerPictures {
    std::filesystem::path folder;
    std::vector<LayerFiles> files;      // read, each once
    std::vector<std::string> problems;  // of each; empty: it is there
    std::vector<glm::vec3> colours;     // of each, the albedo on average, sRGB
    int size = 0;                       // of all of them on the GPU, texels a side
    std::vector<std::string> told;      // what was last told
    std::vector<std::string> untold;    // since
};

// Reads what the set names and the renderer does not hold yet. Cheap where nothing has changed. All pictures
// get the size of the largest, since an array's slices must.
void fitLayerPictures(const planet::LayerSet& set, const std::filesystem::path& folder,
                      planet::gl::ChunkRenderer& renderer, LayerPictures& pictures);

// Which picture each layer is drawn with; -1: the checker pattern.
std::vector<int> picturesOf(const planet::LayerSet& set, const LayerPictures& pictures);
// Each layer's colour on average; none before it has been read.
std::vector<glm::vec3> coloursOf(const planet::LayerSet& set, const LayerPictures& pictures);
// What is wrong with each layer, its ranges or its textures; empty: nothing.
std::vector<std::string> problemsOf(const planet::LayerSet& set, const LayerPictures& pictures);

}  // namespace worldy
