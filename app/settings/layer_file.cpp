#include "app/settings/layer_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <sstream>
#include <variant>

#include "app/base/colour_text.h"
#include "app/base/output_file.h"
#include "app/base/places.h"
#include "app/base/toml_file.h"
#include "app/base/utf8.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;
using planet::SoftRange;
using planet::TextureLayer;

struct LayerKey {
    std::string_view key;
    std::string_view meaning;
    std::variant<std::string*, double*, bool*, SoftRange*, glm::vec3*> value;
    NumberRange range{};
};

std::vector<LayerKey> keysOf(TextureLayer& layer) {
    const auto limits = [](const SoftRange& all, std::string_view unit) {
        return NumberRange{all.lowest, all.highest, unit};
    };
    return {{"name", "", &layer.name},
            {"albedo", "sRGB, relief in its alpha; square, power-of-two side.", &layer.albedo},
            {"normal", "", &layer.normal},
            {"roughness", "", &layer.roughness},
            {"scale_m", "Size of one texture repeat, m.", &layer.scaleM, {0.01, 1e5, "m"}},
            {"tint", "", &layer.tint},
            {"opacity", "", &layer.opacity, {0, 1, ""}},
            {"muted", "", &layer.muted},
            {"solo", "", &layer.solo},
            {"height_m", "Lowest, highest, falloff.", &layer.heightM, limits(planet::allHeightsM, "m")},
            {"slope_deg", "", &layer.slopeDeg, limits(planet::allSlopesDeg, "°")},
            {"latitude_deg", "", &layer.latitudeDeg, limits(planet::allLatitudesDeg, "°")},
            {"noise_amount", "How far noise moves the borders, in falloffs.", &layer.noiseAmount, {0, 4, ""}},
            {"noise_size_m", "", &layer.noiseSizeM, {0.1, 1e6, "m"}}};
}

// Longer names would not fit into a recorded flight.
constexpr std::size_t mostNameBytes = 1000;

struct ReadKey {
    const fs::path& file;
    const std::string name;
    const toml::node& node;
    NumberRange range;

    Result<void> operator()(std::string* text) const {
        Result<std::string> read = readText(file, name, node);
        if (!read) return tl::unexpected(read.error());
        if (read->size() > mostNameBytes) {
            return wrong(
                file, node,
                fmt::format("{} is {} bytes long; expected at most {}", name, read->size(), mostNameBytes));
        }
        *text = std::move(*read);
        return {};
    }
    Result<void> operator()(double* number) const {
        return readNumber(file, name, node, range).map([&](double v) { *number = v; });
    }
    Result<void> operator()(bool* flag) const {
        return readBool(file, name, node).map([&](bool v) { *flag = v; });
    }
    Result<void> operator()(SoftRange* soft) const {
        const toml::array* array = node.as_array();
        if (!array || array->size() != 3) {
            return wrong(
                file, node,
                fmt::format("{} is {}; expected [lowest, highest, falloff]", name, shownValue(node)));
        }
        std::array<double, 3> read{};
        for (std::size_t i = 0; i < 3; ++i) {
            const NumberRange edge{0, range.max - range.min, range.unit};
            const Result<double> value = readNumber(file, name, *array->get(i), i < 2 ? range : edge);
            if (!value) return tl::unexpected(value.error());
            read[i] = *value;
        }
        *soft = {read[0], read[1], read[2]};
        return {};
    }
    Result<void> operator()(glm::vec3* colour) const {
        const std::optional<glm::vec3> rgb = colourFromText(node.value_or(std::string()));
        if (!rgb) {
            return wrong(
                file, node,
                fmt::format("{} is {}; expected red, green and blue as \"#rrggbb\"", name, shownValue(node)));
        }
        *colour = *rgb;
        return {};
    }
};

struct KeyText {
    std::string operator()(const std::string* text) const {
        if (!isUtf8(*text)) return "\"\"";
        std::ostringstream stream;
        stream << toml::value<std::string>(*text);
        return stream.str();
    }
    std::string operator()(const double* number) const { return fmt::format("{}", *number); }
    std::string operator()(const bool* flag) const { return *flag ? "true" : "false"; }
    std::string operator()(const SoftRange* range) const {
        return fmt::format("[{}, {}, {}]", range->lowest, range->highest, range->softEdge);
    }
    std::string operator()(const glm::vec3* colour) const {
        return fmt::format("\"{}\"", colourText(*colour));
    }
};

std::string textOf(const LayerKey& key) {
    return std::visit(KeyText{}, key.value);
}

Result<TextureLayer> layerFromToml(const fs::path& file, const std::string& name, const toml::node& node) {
    const toml::table* table = node.as_table();
    if (!table)
        return wrong(file, node, fmt::format("{} is not a layer; expected a table with a name", name));
    TextureLayer layer;
    const std::vector<LayerKey> keys = keysOf(layer);
    for (const auto& [key, value] : *table) {
        const std::string_view word = key.str();
        const auto found =
            std::find_if(keys.begin(), keys.end(), [&](const LayerKey& known) { return known.key == word; });
        const std::string keyName = fmt::format("{}: {:.40}", name, word);
        if (found == keys.end()) {
            std::string known;
            for (const LayerKey& one : keys) known += fmt::format("{}{}", known.empty() ? "" : ", ", one.key);
            return wrong(file, value,
                         fmt::format("{} is an unknown key; expected one of {}", keyName, known));
        }
        if (Result<void> read = std::visit(ReadKey{file, keyName, value, found->range}, found->value); !read)
            return tl::unexpected(read.error());
    }
    return layer;
}

Result<void> readBlend(const fs::path& file, const toml::node& node, planet::LayerSet& set) {
    const std::string word = node.value_or(std::string());
    const auto found = std::find(layerBlendNames.begin(), layerBlendNames.end(), word);
    if (found == layerBlendNames.end()) {
        return wrong(file, node,
                     fmt::format("blend is {}; expected \"weight\" or \"height\"", shownValue(node)));
    }
    set.blend = static_cast<planet::LayerBlend>(found - layerBlendNames.begin());
    return {};
}

Result<void> readSetKey(const fs::path& file, std::string_view key, const toml::node& node,
                        planet::LayerSet& set) {
    if (key == "blend") return readBlend(file, node, set);
    if (key == "blend_depth") {
        return readNumber(file, key, node, {0.05, 2, ""}).map([&](double v) { set.blendDepth = v; });
    }
    if (key == "layer") {
        return layersFromToml(file, key, node).map([&](std::vector<TextureLayer> layers) {
            set.layers = std::move(layers);
        });
    }
    return wrong(file, node,
                 fmt::format("{:.40} is an unknown key; expected blend, blend_depth or [[layer]]", key));
}

template <class Move>
void eachTexture(planet::LayerSet& set, const Move& move) {
    for (TextureLayer& layer : set.layers) {
        for (std::string* texture : {&layer.albedo, &layer.normal, &layer.roughness}) {
            if (!texture->empty()) *texture = move(fs::path(*texture)).string();
        }
    }
}

}  // namespace

Result<std::vector<TextureLayer>> layersFromToml(const fs::path& file, std::string_view name,
                                                 const toml::node& node) {
    const toml::array* array = node.as_array();
    if (!array) {
        return wrong(file, node,
                     fmt::format("{} is {}; expected layers, as [[layer]] or an array of tables", name,
                                 shownValue(node)));
    }
    if (array->size() > planet::maxLayers) {
        return wrong(
            file, node,
            fmt::format("{} has {} layers; expected at most {}", name, array->size(), planet::maxLayers));
    }
    std::vector<TextureLayer> layers;
    for (const toml::node& one : *array) {
        Result<TextureLayer> layer = layerFromToml(file, fmt::format("{} {}", name, layers.size() + 1), one);
        if (!layer) return tl::unexpected(layer.error());
        layers.push_back(std::move(*layer));
    }
    return layers;
}

std::string layerLine(const TextureLayer& layer) {
    TextureLayer copy = layer;
    TextureLayer defaults;
    const std::vector<LayerKey> keys = keysOf(copy), defaultKeys = keysOf(defaults);
    std::string text;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i > 0 && textOf(keys[i]) == textOf(defaultKeys[i])) continue;
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", keys[i].key, textOf(keys[i]));
    }
    return fmt::format("{{ {} }}", text);
}

namespace {

Result<planet::LayerSet> layerSetOf(const fs::path& file, const toml::table& document) {
    planet::LayerSet set;
    for (const auto& [key, node] : document) {
        if (Result<void> read = readSetKey(file, key.str(), node, set); !read)
            return tl::unexpected(read.error());
    }
    if (set.layers.empty())
        return planet::badInput(
            fmt::format("{}: has no layers; expected one [[layer]] or more", file.string()));
    return set;
}

}  // namespace

Result<planet::LayerSet> loadLayerSet(const fs::path& file) {
    return parseTomlFile(file).and_then(
        [&](const toml::table& document) { return layerSetOf(file, document); });
}

Result<planet::LayerSet> layerSetFromText(std::string_view text, const fs::path& place) {
    return parseTomlText(text, place).and_then([&](const toml::table& document) {
        return layerSetOf(place, document);
    });
}

std::string layerSetText(const planet::LayerSet& set) {
    std::string text = fmt::format(
        "# Texture layers of Worldy, the lowest first; each is drawn over the previous ones.\n"
        "# blend: by \"weight\", or by \"height\": the layer with the higher relief wins within "
        "blend_depth.\n"
        "blend = \"{}\"\nblend_depth = {}\n",
        layerBlendNames[static_cast<std::size_t>(set.blend)], set.blendDepth);
    bool first = true;
    for (TextureLayer layer : set.layers) {
        text += "\n[[layer]]\n";
        for (const LayerKey& key : keysOf(layer)) {
            text += fmt::format("{} = {}{}\n", key.key, textOf(key),
                                first && !key.meaning.empty() ? fmt::format("  # {}", key.meaning) : "");
        }
        first = false;
    }
    return text;
}

planet::LayerSet movedTo(const fs::path& newFolder, const fs::path& folder, planet::LayerSet set) {
    std::error_code status;
    const fs::path from = fs::absolute(folder, status).lexically_normal();
    const fs::path to = fs::absolute(newFolder, status).lexically_normal();
    eachTexture(set, [&](const fs::path& texture) {
        const fs::path whole = (from / texture).lexically_normal();
        const fs::path relative = whole.lexically_relative(to);
        const bool inside = !relative.empty() && *relative.begin() != "..";
        return inside ? relative : whole;
    });
    return set;
}

Result<void> saveLayerSet(const planet::LayerSet& set, const fs::path& folder, const fs::path& file) {
    std::error_code status;
    fs::create_directories(fs::absolute(file, status).parent_path(), status);
    return writeTextFile(file, layerSetText(movedTo(file.parent_path(), folder, set)));
}

fs::path layerFolderOf(const fs::path& setFile) {
    return setFile.empty() ? dataFolder() / "layers" : setFile.parent_path();
}

}  // namespace worldy
