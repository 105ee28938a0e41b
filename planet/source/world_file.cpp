#include "planet/source/world_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

#include "planet/base/try.h"
#include "planet/raster/image_names.h"
#include "planet/raster/raster_mosaic.h"
#include "planet/source/height_source.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/toml_file.h"

namespace planet {

namespace {

constexpr std::size_t mostLayers = 1000;

// A key of a layer, and how to read it.
struct LayerKey {
    std::string_view name;
    Result<void> (*read)(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer);
};

Result<void> addFile(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    TRY_ASSIGN(const auto text, readText(file, "files", node));
    if (text.empty())
        return badInput(
            fmt::format("{}: files has an empty path; expected a file or a pattern", placeOf(file, node)));
    layer.files.push_back(file.parent_path() / text);
    return {};
}

Result<void> readFiles(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    const toml::array* const list = node.as_array();
    if (!list) return addFile(file, node, layer);
    if (list->empty())
        return badInput(fmt::format("{}: files is empty; expected paths or patterns", placeOf(file, node)));
    for (const toml::node& each : *list) TRY(addFile(file, each, layer));
    return {};
}

Result<void> readScale(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    TRY_ASSIGN(layer.scale, readNumber(file, "scale", node, {-1e6, 1e6, ""}));
    if (layer.scale != 0) return {};
    return badInput(fmt::format("{}: scale is 0; expected another number", placeOf(file, node)));
}

Result<void> readVoids(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    if (node.is_number()) {
        layer.voids = LayerVoids::Height;
        TRY_ASSIGN(layer.voidM, readNumber(file, "voids", node, {-1e6, 1e6, "m"}));
        return {};
    }
    const auto* const text = node.as_string();
    if (text && *text == "below") {
        layer.voids = LayerVoids::Below;
    } else if (text && *text == "fill") {
        layer.voids = LayerVoids::Fill;
    } else {
        return badInput(fmt::format("{}: voids is {}; expected \"below\", \"fill\" or a height in metres",
                                    placeOf(file, node), shownValue(node)));
    }
    return {};
}

Result<void> readJoin(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    const auto* const text = node.as_string();
    if (text && *text == "replace") {
        layer.join = LayerJoin::Replace;
    } else if (text && *text == "max") {
        layer.join = LayerJoin::Max;
    } else if (text && *text == "add") {
        layer.join = LayerJoin::Add;
    } else {
        return badInput(fmt::format("{}: join is {}; expected \"replace\", \"max\" or \"add\"",
                                    placeOf(file, node), shownValue(node)));
    }
    return {};
}

Result<VerticalDatum> readDatum(const std::filesystem::path& file, const toml::node& node) {
    const auto* const text = node.as_string();
    const std::optional<VerticalDatum> datum = text ? verticalDatumNamed(text->get()) : std::nullopt;
    if (datum) return *datum;
    return badInput(fmt::format("{}: datum is {}; expected \"ellipsoid\", \"egm96\" or \"egm2008\"",
                                placeOf(file, node), shownValue(node)));
}

// A number of a place, and how to read it.
struct PlaceKey {
    std::string_view name;
    double ImagePlace::*value;
    NumberRange range;
    bool isNeeded;
};
constexpr std::array<PlaceKey, 4> placeKeys = {
    {{"lat", &ImagePlace::latitudeDeg, {-90, 90, "°"}, true},
     {"lon", &ImagePlace::longitudeDeg, {-360, 360, "°"}, true},
     {"width_m", &ImagePlace::widthM, {1e-3, 1e9, "m"}, true},
     {"heading", &ImagePlace::headingDeg, {-360, 360, "°"}, false}}};

Result<void> readPlace(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    const toml::table* const table = node.as_table();
    const auto wrong = [&](const std::string& what) {
        return badInput(fmt::format(
            "{}: {}; expected place = {{lat = 46.5, lon = 8.0, width_m = 8192}}, perhaps with heading = 30",
            placeOf(file, node), what));
    };
    if (!table) return wrong(fmt::format("place is {}", shownValue(node)));
    ImagePlace& place = layer.place.emplace();
    for (const auto& [key, value] : *table) {
        const auto known = std::ranges::find(placeKeys, key.str(), &PlaceKey::name);
        if (known == placeKeys.end()) return wrong(fmt::format("{} is no key of a place", key.str()));
        TRY_ASSIGN(place.*known->value, readNumber(file, known->name, value, known->range));
    }
    for (const PlaceKey& key : placeKeys) {
        if (key.isNeeded && !table->contains(key.name))
            return wrong(fmt::format("place has no {}", key.name));
    }
    return {};
}

// Reads the samples per side, or a list of the samples in a row and the rows.
Result<void> readRawSize(const std::filesystem::path& file, const toml::node& node, WorldLayer& layer) {
    const toml::array* const sides = node.as_array();
    if (sides && sides->size() != 2) {
        return badInput(fmt::format("{}: raw_size lists {} numbers; expected [columns, rows]",
                                    placeOf(file, node), sides->size()));
    }
    TRY_ASSIGN(const auto columns,
               readInteger(file, "raw_size", sides ? *sides->get(0) : node, {2, 1 << 22, "samples"}));
    layer.rawSize = static_cast<int>(columns);
    if (!sides) return {};
    TRY_ASSIGN(const auto rows, readInteger(file, "raw_size", *sides->get(1), {1, 1 << 22, "rows"}));
    layer.rawRows = static_cast<int>(rows);
    return {};
}

constexpr std::array layerKeys = {
    LayerKey{"name",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.name, readText(file, "name", node));
                 return {};
             }},
    LayerKey{"files", readFiles},
    LayerKey{"terrain",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.terrain, readText(file, "terrain", node));
                 return {};
             }},
    LayerKey{"detail",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(const auto text, readText(file, "detail", node));
                 layer.detail = "detail:" + text;
                 return {};
             }},
    LayerKey{"join", readJoin},
    LayerKey{"voids", readVoids},
    LayerKey{"feather_m",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.featherM, readNumber(file, "feather_m", node, {0, 1e6, "m"}));
                 return {};
             }},
    LayerKey{"on",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.on, readBool(file, "on", node));
                 return {};
             }},
    LayerKey{"scale", readScale},
    LayerKey{"offset_m",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.offsetM, readNumber(file, "offset_m", node, {-1e6, 1e6, "m"}));
                 layer.hasOffset = true;
                 return {};
             }},
    LayerKey{"datum",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.datum, readDatum(file, node));
                 return {};
             }},
    LayerKey{"place", readPlace},
    LayerKey{"raw_size", readRawSize},
    LayerKey{"raw_big_endian",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.rawBigEndian, readBool(file, "raw_big_endian", node));
                 return {};
             }},
    LayerKey{"raw_signed",
             [](const auto& file, const auto& node, WorldLayer& layer) -> Result<void> {
                 TRY_ASSIGN(layer.rawSigned, readBool(file, "raw_signed", node));
                 return {};
             }},
};

// A kind of layers, the name of its tables, and the keys that it knows.
struct TableKind {
    std::string_view table;
    bool (*knows)(std::string_view key);
};
constexpr TableKind elevationKind = {"elevation", [](std::string_view) { return true; }};
constexpr TableKind colourKind = {"colour", [](std::string_view key) {
                                      return key == "name" || key == "on" || key == "files" ||
                                             key == "feather_m";
                                  }};

std::string knownKeys(const TableKind& kind) {
    std::string names;
    for (const LayerKey& key : layerKeys) {
        if (kind.knows(key.name)) names += fmt::format("{}{}", names.empty() ? "" : ", ", key.name);
    }
    return names;
}

Result<void> checkPlace(const std::string& place, const WorldLayer& layer) {
    const bool saysRaw = layer.rawSize || layer.rawBigEndian || layer.rawSigned;
    if (layer.place && (layer.files.size() != 1 || isFilePattern(layer.files[0]))) {
        return badInput(fmt::format(
            "{}: place is for one image; expected files with one path, and a layer for each image", place));
    }
    if (saysRaw && (!layer.place || !isRawImage(layer.files[0]))) {
        return badInput(
            fmt::format("{}: raw_size, raw_big_endian and raw_signed describe a headerless file; expected a "
                        "layer with place and one .raw or .r16 file",
                        place));
    }
    return {};
}

// Layers whose heights stand on their own have a datum if the planet has one. Terrain, detail and heights that are added
// have none.
Result<void> checkDatum(const std::string& place, const WorldLayer& layer,
                        const std::optional<VerticalDatum>& planet) {
    const bool mayHaveOne = !layer.files.empty() && layer.join != LayerJoin::Add;
    if (layer.datum && !mayHaveOne) {
        return badInput(fmt::format(
            "{}: terrain, detail and heights that are added have no datum; expected a layer without datum",
            place));
    }
    if (layer.datum && !planet) {
        return badInput(fmt::format(
            "{}: the layer's datum is {}, but the world file does not say what the planet's heights are "
            "measured from; expected datum at its top too",
            place, nameOf(*layer.datum)));
    }
    if (planet && !layer.datum && mayHaveOne) {
        return badInput(fmt::format(
            "{}: the planet's datum is {}, but the layer does not say what its heights are measured from; "
            "expected datum in the layer too",
            place, nameOf(*planet)));
    }
    return {};
}

// Checks what one key alone cannot say.
Result<void> checkLayer(const std::string& place, const WorldLayer& layer, bool isFirst) {
    const int contents =
        (layer.files.empty() ? 0 : 1) + (layer.terrain.empty() ? 0 : 1) + (layer.detail.empty() ? 0 : 1);
    if (contents != 1) {
        return badInput(fmt::format("{}: a layer has {} of files, terrain and detail; expected exactly one",
                                    place, contents));
    }
    if (!layer.terrain.empty() && !layer.terrain.starts_with("noise:")) {
        return badInput(
            fmt::format("{}: terrain is \"{}\"; expected procedural terrain such as \"noise:ridged,seed=7\"",
                        place, layer.terrain));
    }
    if (layer.files.empty() && (layer.featherM > 0 || layer.voids != LayerVoids::Below)) {
        return badInput(fmt::format(
            "{}: only a layer of files has feather_m and voids, because terrain has no rim; expected "
            "none of them",
            place));
    }
    if (!layer.detail.empty() && ((isFirst && layer.on) || layer.join != LayerJoin::Replace ||
                                  layer.scale != 1 || layer.offsetM != 0)) {
        return badInput(fmt::format(
            "{}: detail refines what lies under it; expected a layer under it, and no join, scale or "
            "offset_m",
            place));
    }
    return checkPlace(place, layer);
}

Result<WorldLayer> readLayer(const std::filesystem::path& file, const toml::node& node, const TableKind& kind,
                             bool isFirst) {
    const toml::table* const table = node.as_table();
    const std::string place = placeOf(file, node);
    if (!table)
        return badInput(
            fmt::format("{}: a layer is {}; expected a table [[{}]]", place, shownValue(node), kind.table));
    WorldLayer layer;
    for (const auto& [key, value] : *table) {
        const auto known = std::ranges::find(layerKeys, key.str(), &LayerKey::name);
        if (known == layerKeys.end() || !kind.knows(key.str())) {
            return badInput(fmt::format("{}: {} is no key of a layer of {}; expected one of {}",
                                        placeOf(file, value), key.str(), kind.table, knownKeys(kind)));
        }
        TRY(known->read(file, value, layer));
    }
    TRY(checkLayer(place, layer, isFirst));
    if (layer.name.empty()) layer.name = defaultNameOf(layer);
    return layer;
}

// Reads the layers of a kind; none if there is no such table.
Result<std::vector<WorldLayer>> readLayers(const std::filesystem::path& file, const toml::table& table,
                                           const TableKind& kind) {
    std::vector<WorldLayer> layers;
    const toml::node* const node = table.get(kind.table);
    if (!node) return layers;
    const toml::array* const list = node->as_array();
    if (!list || list->empty() || list->size() > mostLayers) {
        return badInput(fmt::format("{}: has {} layers of {}; expected [1, {}] tables [[{}]]", file.string(),
                                    list ? list->size() : 0, kind.table, mostLayers, kind.table));
    }
    for (const toml::node& each : *list) {
        const bool isFirst = std::ranges::none_of(layers, &WorldLayer::on);
        TRY_ASSIGN(auto layer, readLayer(file, each, kind, isFirst));
        layers.push_back(std::move(layer));
    }
    return layers;
}

Result<WorldFile> worldFromTable(const toml::table& table, const std::filesystem::path& path) {
    WorldFile world;
    for (const auto& [key, value] : table) {
        if (key.str() == "fill_m") {
            TRY_ASSIGN(world.fillM, readNumber(path, "fill_m", value, {-1e6, 1e6, "m"}));
        } else if (key.str() == "datum") {
            TRY_ASSIGN(world.datum, readDatum(path, value));
        } else if (key.str() == "radius_m") {
            TRY_ASSIGN(world.radiusM, readNumber(path, "radius_m", value, {1, 1e9, "m"}));
        } else if (key.str() != elevationKind.table && key.str() != colourKind.table) {
            return badInput(
                fmt::format("{}: {} is no key of a world file; expected radius_m, fill_m, datum and tables "
                            "[[elevation]] and [[colour]]",
                            placeOf(path, value), key.str()));
        }
    }
    TRY_ASSIGN(world.layers, readLayers(path, table, elevationKind));
    TRY_ASSIGN(world.colours, readLayers(path, table, colourKind));
    if (world.layers.empty() && world.colours.empty()) {
        return badInput(fmt::format("{}: has no layers; expected [1, {}] tables [[elevation]] or [[colour]]",
                                    path.string(), mostLayers));
    }
    if (layersOn(world.layers).empty() && layersOn(world.colours).empty())
        return badInput(fmt::format("{}: no layer is on; expected at least one", path.string()));
    for (std::size_t i = 0; i < world.layers.size(); ++i)
        TRY(checkDatum(placeOf(path, *table["elevation"].as_array()->get(i)), world.layers[i], world.datum));
    return world;
}

// Returns a path as a world file in a folder names it. The parts of a list are separate paths.
std::string relativeTo(const std::filesystem::path& folder, const std::filesystem::path& path) {
    std::string text;
    std::istringstream parts(path.string());
    for (std::string part; std::getline(parts, part, '|');) {
        const std::filesystem::path whole = std::filesystem::absolute(part).lexically_normal();
        const std::filesystem::path near =
            whole.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
        text += fmt::format("{}{}", text.empty() ? "" : "|", near.empty() ? whole.string() : near.string());
    }
    return text;
}

void insertFiles(const WorldLayer& layer, const std::filesystem::path& folder, toml::table& table) {
    if (layer.files.size() == 1) {
        table.insert("files", relativeTo(folder, layer.files[0]));
        return;
    }
    toml::array files;
    for (const std::filesystem::path& file : layer.files) files.push_back(relativeTo(folder, file));
    table.insert("files", std::move(files));
}

void insertVoids(const WorldLayer& layer, toml::table& table) {
    if (layer.voids == LayerVoids::Fill) table.insert("voids", "fill");
    if (layer.voids == LayerVoids::Height) table.insert("voids", layer.voidM);
}

void insertPlace(const ImagePlace& place, toml::table& table) {
    toml::table inlined;
    for (const PlaceKey& key : placeKeys) {
        if (key.isNeeded || place.*key.value != 0) inlined.insert(key.name, place.*key.value);
    }
    inlined.is_inline(true);
    table.insert("place", std::move(inlined));
}

toml::table tableOf(const WorldLayer& layer, const std::filesystem::path& folder) {
    const WorldLayer plain;
    constexpr std::string_view kind = "detail:";
    toml::table table;
    if (layer.name != defaultNameOf(layer)) table.insert("name", layer.name);
    if (!layer.on) table.insert("on", false);
    if (!layer.files.empty()) insertFiles(layer, folder, table);
    if (!layer.terrain.empty()) table.insert("terrain", layer.terrain);
    if (!layer.detail.empty()) table.insert("detail", layer.detail.substr(kind.size()));
    if (layer.join != plain.join) table.insert("join", nameOf(layer.join));
    insertVoids(layer, table);
    if (layer.featherM != plain.featherM) table.insert("feather_m", layer.featherM);
    if (layer.scale != plain.scale) table.insert("scale", layer.scale);
    if (layer.hasOffset || layer.offsetM != plain.offsetM) table.insert("offset_m", layer.offsetM);
    if (layer.datum) table.insert("datum", nameOf(*layer.datum));
    if (layer.place) insertPlace(*layer.place, table);
    if (layer.rawRows) {
        table.insert("raw_size", toml::array{*layer.rawSize, *layer.rawRows});
    } else if (layer.rawSize) {
        table.insert("raw_size", *layer.rawSize);
    }
    if (layer.rawBigEndian) table.insert("raw_big_endian", true);
    if (layer.rawSigned) table.insert("raw_signed", true);
    return table;
}

}  // namespace

Result<WorldFile> readWorldFile(const std::filesystem::path& path) {
    TRY_ASSIGN(const auto table, parseTomlFile(path));
    return worldFromTable(table, path);
}

Result<WorldFile> worldFromText(std::string_view text, const std::filesystem::path& path) {
    TRY_ASSIGN(const auto table, parseTomlText(text, path));
    return worldFromTable(table, path);
}

std::string worldText(const WorldFile& world, const std::filesystem::path& folder) {
    const WorldFile plain;
    toml::table table;
    if (world.radiusM != plain.radiusM) table.insert("radius_m", world.radiusM);
    if (world.fillM != plain.fillM) table.insert("fill_m", world.fillM);
    if (world.datum) table.insert("datum", nameOf(*world.datum));
    const auto insertLayers = [&](const TableKind& kind, const std::vector<WorldLayer>& layers) {
        if (layers.empty()) return;
        toml::array tables;
        for (const WorldLayer& layer : layers) tables.push_back(tableOf(layer, folder));
        table.insert(kind.table, std::move(tables));
    };
    insertLayers(elevationKind, world.layers);
    insertLayers(colourKind, world.colours);
    std::ostringstream text;
    text << toml::toml_formatter(table) << '\n';
    return text.str();
}

std::vector<WorldLayer> layersOn(const std::vector<WorldLayer>& layers) {
    std::vector<WorldLayer> on;
    std::ranges::copy_if(layers, std::back_inserter(on), &WorldLayer::on);
    return on;
}

std::string defaultNameOf(const WorldLayer& layer) {
    if (!layer.files.empty()) return layer.files[0].filename().string();
    return layer.terrain.empty() ? layer.detail : layer.terrain;
}

std::string_view nameOf(LayerJoin join) {
    constexpr std::array<std::string_view, 3> names = {"replace", "max", "add"};
    return names[static_cast<std::size_t>(join)];
}

Result<std::vector<std::filesystem::path>> filesOfLayer(const WorldLayer& layer) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& named : layer.files) {
        if (isFilePattern(named)) {
            const std::vector<std::filesystem::path> found = filesOfPattern(named);
            if (found.empty()) {
                return ioError(fmt::format("{}: no file matches this pattern of layer \"{}\"", named.string(),
                                           layer.name));
            }
            files.insert(files.end(), found.begin(), found.end());
            continue;
        }
        if (isWorldFile(named)) {
            return badInput(
                fmt::format("{}: a world file cannot be a layer; expected rasters, an image or cube faces",
                            named.string()));
        }
        files.push_back(named);
    }
    if (files.size() <= mostRasters) return files;
    return badInput(
        fmt::format("{}: has {} files; expected at most {}", layer.name, files.size(), mostRasters));
}

}  // namespace planet
