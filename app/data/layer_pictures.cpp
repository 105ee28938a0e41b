#include "app/data/layer_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/base/picture_file.h"
#include "planet/gl/store/layer_textures.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

std::uint8_t valueAt(const Texture& texture, std::size_t texel, int channel) {
    return texture
        .bytes[texel * static_cast<std::size_t>(texture.channels) + static_cast<std::size_t>(channel)];
}

// Returns four channels per texel; pick(texture, i) returns those of one texel.
template <class Pick>
std::vector<std::uint8_t> laidOut(const Texture& texture, const Pick& pick) {
    const std::size_t count = static_cast<std::size_t>(texture.size) * static_cast<std::size_t>(texture.size);
    std::vector<std::uint8_t> out;
    out.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::array<std::uint8_t, 4> rgba = pick(texture, i);
        out.insert(out.end(), rgba.begin(), rgba.end());
    }
    return out;
}

std::array<std::uint8_t, 4> albedoTexel(const Texture& texture, std::size_t i) {
    const int last = texture.channels >= 3 ? 1 : 0;
    const bool relief = texture.channels == 2 || texture.channels == 4;
    return {valueAt(texture, i, 0), valueAt(texture, i, last), valueAt(texture, i, 2 * last),
            relief ? valueAt(texture, i, texture.channels - 1) : std::uint8_t{128}};
}

std::vector<std::uint8_t> enlargedBytes(const std::vector<std::uint8_t>& from, int size, int times) {
    const int large = size * times;
    const auto at = [&](int x, int y, int c) {
        const auto texel = static_cast<std::size_t>((y & (size - 1)) * size + (x & (size - 1)));
        return static_cast<double>(from[4 * texel + static_cast<std::size_t>(c)]);
    };
    std::vector<std::uint8_t> to;
    to.reserve(from.size() * static_cast<std::size_t>(times) * static_cast<std::size_t>(times));
    for (int row = 0; row < large; ++row) {
        for (int column = 0; column < large; ++column) {
            const double x = (column + 0.5) / times - 0.5, y = (row + 0.5) / times - 0.5;
            const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
            const double right = x - left, down = y - top;
            for (int c = 0; c < 4; ++c) {
                const double upper = at(left, top, c) * (1 - right) + at(left + 1, top, c) * right;
                const double lower = at(left, top + 1, c) * (1 - right) + at(left + 1, top + 1, c) * right;
                to.push_back(static_cast<std::uint8_t>(std::lround(upper * (1 - down) + lower * down)));
            }
        }
    }
    return to;
}

std::vector<std::uint8_t> fitted(std::vector<std::uint8_t> bytes, int size, int wanted) {
    return size == wanted ? std::move(bytes) : enlargedBytes(bytes, size, wanted / size);
}

LayerFiles filesOf(const planet::TextureLayer& layer) {
    return {layer.albedo, layer.normal, layer.roughness};
}

std::optional<std::size_t> placeOfFiles(const planet::TextureLayer& layer, const LayerPictures& pictures) {
    const auto found = std::find(pictures.files.begin(), pictures.files.end(), filesOf(layer));
    if (found == pictures.files.end()) return std::nullopt;
    return static_cast<std::size_t>(found - pictures.files.begin());
}

glm::vec3 meanColour(const planet::gl::LayerPicture& picture) {
    glm::dvec3 sum(0);
    const std::vector<std::uint8_t>& albedo = picture.albedo;
    for (std::size_t i = 0; i < albedo.size(); i += 4)
        sum += glm::dvec3(albedo[i], albedo[i + 1], albedo[i + 2]);
    const std::size_t texels = std::max<std::size_t>(albedo.size() / 4, 1);
    return sum / (255.0 * static_cast<double>(texels));
}

void readAll(const planet::LayerSet& set, planet::gl::ChunkRenderer& renderer, LayerPictures& pictures) {
    pictures.files.clear();
    pictures.problems.clear();
    pictures.colours.clear();
    std::vector<LayerTexels> read;
    pictures.size = 64;
    for (const planet::TextureLayer& layer : set.layers) {
        if (placeOfFiles(layer, pictures)) continue;
        pictures.files.push_back(filesOf(layer));
        Result<LayerTexels> texels = readLayerTexels(pictures.folder, filesOf(layer));
        pictures.problems.push_back(texels ? std::string() : texels.error().message);
        // The placeholder keeps the indices of the other pictures; it is not drawn.
        read.push_back(texels ? std::move(*texels) : LayerTexels{8, planet::gl::checkerPicture(8)});
        pictures.colours.push_back(meanColour(read.back().picture));
        pictures.size = std::max(pictures.size, read.back().size);
    }
    std::vector<planet::gl::LayerPicture> all;
    for (const LayerTexels& texels : read) all.push_back(enlarged(texels, pictures.size).picture);
    const Result<void> held = renderer.setLayers(all, pictures.size);
    if (held) return;
    for (std::string& problem : pictures.problems)
        if (problem.empty()) problem = held.error().message;
}

}  // namespace

Result<LayerTexels> readLayerTexels(const fs::path& folder, const LayerFiles& files) {
    if (files[0].empty()) return planet::badInput("albedo: is empty; expected the path of a PNG texture");
    std::array<Texture, 3> read;
    read[1] = {1, 3, {128, 128, 255}};
    read[2] = {1, 1, {230}};
    int size = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!files[i].empty()) {
            Result<Texture> texture = readTexture(folder / files[i]);
            if (!texture) return tl::unexpected(texture.error());
            if (i == 1 && texture->channels < 3) {
                return planet::badInput(fmt::format("{}: has {} channels; expected red, green and blue",
                                                    (folder / files[i]).string(), texture->channels));
            }
            read[i] = std::move(*texture);
        }
        size = std::max(size, read[i].size);
    }
    const auto picked = [&](const Texture& texture, const auto& pick) {
        return fitted(laidOut(texture, pick), texture.size, size);
    };
    LayerTexels texels{size, {picked(read[0], albedoTexel), {}}};
    texels.picture.surface = picked(read[1], [](const Texture& from, std::size_t i) {
        return std::array<std::uint8_t, 4>{valueAt(from, i, 0), valueAt(from, i, 1), 0, 255};
    });
    const std::vector<std::uint8_t> rough = picked(read[2], [](const Texture& from, std::size_t i) {
        return std::array<std::uint8_t, 4>{valueAt(from, i, 0), 0, 0, 0};
    });
    for (std::size_t i = 0; i < rough.size(); i += 4) texels.picture.surface[i + 2] = rough[i];
    return texels;
}

LayerTexels enlarged(const LayerTexels& texels, int size) {
    return {size,
            {fitted(texels.picture.albedo, texels.size, size),
             fitted(texels.picture.surface, texels.size, size)}};
}

void fitLayerPictures(const planet::LayerSet& set, const fs::path& folder,
                      planet::gl::ChunkRenderer& renderer, LayerPictures& pictures) {
    const bool held =
        folder == pictures.folder &&
        std::all_of(set.layers.begin(), set.layers.end(), [&](const planet::TextureLayer& layer) {
            return placeOfFiles(layer, pictures).has_value();
        });
    if (!held) {
        pictures.folder = folder;
        readAll(set, renderer, pictures);
    }
    std::vector<std::string> told = problemsOf(set, pictures);
    for (std::size_t i = 0; i < told.size(); ++i) {
        const bool before =
            std::find(pictures.told.begin(), pictures.told.end(), told[i]) != pictures.told.end();
        if (told[i].empty() || before) continue;
        pictures.untold.push_back(fmt::format("Layer {} \"{}\": {}; a checkerboard is drawn instead", i + 1,
                                              set.layers[i].name, told[i]));
    }
    pictures.told = std::move(told);
}

std::vector<int> picturesOf(const planet::LayerSet& set, const LayerPictures& pictures) {
    std::vector<int> of;
    for (const planet::TextureLayer& layer : set.layers) {
        const std::optional<std::size_t> place = placeOfFiles(layer, pictures);
        of.push_back(place && pictures.problems[*place].empty() ? static_cast<int>(*place) : -1);
    }
    return of;
}

std::vector<glm::vec3> coloursOf(const planet::LayerSet& set, const LayerPictures& pictures) {
    std::vector<glm::vec3> colours;
    for (const planet::TextureLayer& layer : set.layers) {
        const std::optional<std::size_t> place = placeOfFiles(layer, pictures);
        colours.push_back(place ? pictures.colours[*place] : glm::vec3(0.5f));
    }
    return colours;
}

std::vector<std::string> problemsOf(const planet::LayerSet& set, const LayerPictures& pictures) {
    std::vector<std::string> problems;
    for (const planet::TextureLayer& layer : set.layers) {
        std::string problem = planet::layerProblem(layer);
        const std::optional<std::size_t> place = placeOfFiles(layer, pictures);
        if (problem.empty() && place) problem = pictures.problems[*place];
        problems.push_back(std::move(problem));
    }
    return problems;
}

}  // namespace worldy
