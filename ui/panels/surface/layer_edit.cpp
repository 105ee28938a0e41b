#include "ui/panels/surface/layer_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace worldy::ui {

namespace {

std::string freeName(const LayerList& layers, const std::string& wanted) {
    const auto isTaken = [&](const std::string& name) {
        return std::any_of(layers.begin(), layers.end(),
                           [&](const planet::TextureLayer& layer) { return layer.name == name; });
    };
    std::string name = wanted;
    for (int number = 2; isTaken(name); ++number) name = fmt::format("{} {}", wanted, number);
    return name;
}

std::ptrdiff_t offset(std::size_t index) {
    return static_cast<std::ptrdiff_t>(index);
}

}  // namespace

void moveLayer(LayerList& layers, std::size_t from, std::size_t to) {
    assert(from < layers.size() && to < layers.size());
    if (from < to)
        std::rotate(layers.begin() + offset(from), layers.begin() + offset(from) + 1,
                    layers.begin() + offset(to) + 1);
    else
        std::rotate(layers.begin() + offset(to), layers.begin() + offset(from),
                    layers.begin() + offset(from) + 1);
}

std::size_t duplicateLayer(LayerList& layers, std::size_t index) {
    assert(index < layers.size() && layers.size() < planet::maxLayers);
    planet::TextureLayer copy = layers[index];
    copy.name = freeName(layers, copy.name);
    layers.insert(layers.begin() + offset(index) + 1, std::move(copy));
    return index + 1;
}

std::size_t addLayer(LayerList& layers) {
    assert(layers.size() < planet::maxLayers);
    planet::TextureLayer layer;
    layer.name = freeName(layers, layer.name);
    layers.push_back(std::move(layer));
    return layers.size() - 1;
}

std::size_t removeLayer(LayerList& layers, std::size_t index) {
    assert(index < layers.size());
    layers.erase(layers.begin() + offset(index));
    return layers.empty() ? 0 : std::min(index, layers.size() - 1);
}

}  // namespace worldy::ui
