// Loads the textures of layers from files to the GPU. A missing or wrong texture is reported once and drawn
// as a checkerboard; the other layers are drawn normally.
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

// The paths of albedo, normal and roughness, as a layer names them.
using LayerFiles = std::array<std::string, 3>;

// The textures of one layer, enlarged to the size of the largest. Each must be square with a power-of-two
// side in [8, 4096]. The alpha of the albedo is the relief; without alpha the relief is flat.
struct LayerTexels {
    int size = 0;
    planet::gl::LayerPicture picture;
};
planet::Result<LayerTexels> readLayerTexels(const std::filesystem::path& folder, const LayerFiles& files);
// Enlarges the textures bilinearly to a larger power of two, wrapping around the edges.
LayerTexels enlarged(const LayerTexels& texels, int size);

// The pictures of a layer set that a renderer holds, and their problems.
struct LayerPictures {
    std::filesystem::path folder;
    std::vector<LayerFiles> files;      // the files read, each once
    std::vector<std::string> problems;  // one per element of files; empty: no problem
    std::vector<glm::vec3> colours;     // mean albedo of each, sRGB
    int size = 0;                       // side of all pictures on the GPU, texels
    std::vector<std::string> told;      // problems of the layers at the last fitLayerPictures
    std::vector<std::string> untold;    // messages not yet reported
};

// Reads the textures that the renderer does not hold yet. Cheap if nothing has changed. All pictures get the
// size of the largest, because they are slices of a texture array.
void fitLayerPictures(const planet::LayerSet& set, const std::filesystem::path& folder,
                      planet::gl::ChunkRenderer& renderer, LayerPictures& pictures);

// Returns the index of each layer's picture; -1: the checkerboard.
std::vector<int> picturesOf(const planet::LayerSet& set, const LayerPictures& pictures);
// Returns the mean colour of each layer; grey before it has been read.
std::vector<glm::vec3> coloursOf(const planet::LayerSet& set, const LayerPictures& pictures);
// Returns the problem of each layer, with its ranges or its textures; empty if there is none.
std::vector<std::string> problemsOf(const planet::LayerSet& set, const LayerPictures& pictures);

}  // namespace worldy
