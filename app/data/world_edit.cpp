#include "app/data/world_edit.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <span>
#include <system_error>
#include <utility>

#include "planet/base/atomic_file.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

bool isPlain(const planet::HeightSourceSettings& s) {
    return !s.metresPerUnit && !s.offsetM && !s.noDataValue && s.fillM == 0 && !s.rawSize && !s.rawBits &&
           !s.rawSigned && !s.rawBigEndian;
}

planet::WorldLayer layerOfFiles(std::span<const fs::path> files) {
    planet::WorldLayer layer;
    layer.files.assign(files.begin(), files.end());
    layer.name = planet::defaultNameOf(layer);
    return layer;
}

// Returns the layers of a source that is no world file: one, or detail over those of its source.
Result<std::vector<planet::WorldLayer>> layersOf(const fs::path& source) {
    if (!planet::isTerrainText(source)) return std::vector{layerOfFiles({&source, 1})};
    const Result<planet::TerrainSource> terrain = planet::terrainFromText(source);
    if (!terrain) return tl::unexpected(terrain.error());
    planet::WorldLayer layer;
    std::vector<planet::WorldLayer> layers;
    if (terrain->of.empty()) {
        layer.terrain = source.string();
    } else {
        const Result<WorldEdit> below = editOf(terrain->of, {});
        if (!below) return tl::unexpected(below.error());
        layers = below->layers;
        // Without its source, the text ends with ",of=" or is "detail:of=".
        std::string text = planet::terrainText({terrain->settings, "."});
        text.resize(text.size() - std::string_view("of=.").size());
        if (text.ends_with(',')) text.pop_back();
        layer.detail = text;
    }
    layer.name = planet::defaultNameOf(layer);
    layers.push_back(layer);
    return layers;
}

// Returns the world without the layers that are off.
planet::WorldFile worldToBake(const WorldEdit& edit) {
    planet::WorldFile world = edit;
    world.layers = planet::layersOn(edit.layers);
    world.colours = planet::layersOn(edit.colours);
    return world;
}

Result<void> write(const std::string& text, const fs::path& file) {
    Result<planet::AtomicFile> out = planet::AtomicFile::create(file);
    if (!out) return tl::unexpected(out.error());
    return out->append(std::as_bytes(std::span(text))).and_then([&] { return out->commit(); });
}

}  // namespace

Result<WorldEdit> editOf(const fs::path& source, const planet::HeightSourceSettings& settings) {
    if (!isPlain(settings)) {
        return planet::badInput(fmt::format(
            "{}: was opened with units, an offset, a no-data value, a fill or a raw format, which layers do "
            "not have; expected a world file with scale, offset_m and voids",
            source.string()));
    }
    if (planet::isWorldFile(source)) return planet::readWorldFile(source);
    return layersOf(source).map([](std::vector<planet::WorldLayer> layers) {
        WorldEdit edit;
        edit.layers = std::move(layers);
        return edit;
    });
}

bool sameWorld(const WorldEdit& a, const WorldEdit& b) {
    return planet::worldText(a, "/") == planet::worldText(b, "/");
}

Result<void> checkEdit(const WorldEdit& edit) {
    if (planet::layersOn(edit.layers).empty())
        return planet::badInput("no layer is on; expected at least one");
    const fs::path place = "/edited layers";
    const Result<planet::WorldFile> world = planet::worldFromText(planet::worldText(edit, "/"), place);
    if (world) return {};
    planet::Error error = world.error();
    // The line is one of a file that nobody sees.
    const std::string prefix = place.string() + ": ";
    if (error.message.starts_with(prefix)) error.message.erase(0, prefix.size());
    if (error.message.starts_with("line ")) error.message.erase(0, error.message.find(": ") + 2);
    return tl::unexpected(std::move(error));
}

void addLayer(WorldEdit& edit, std::span<const fs::path> files) {
    planet::WorldLayer layer = layerOfFiles(files);
    layer.datum = edit.datum;
    edit.layers.push_back(std::move(layer));
}

Result<fs::path> writeForBake(const WorldEdit& edit, const fs::path& folder, const std::string& stem) {
    if (Result<void> good = checkEdit(edit); !good) return tl::unexpected(std::move(good).error());
    // The name of the file stands in messages and in the chunk file, so it has no hash.
    const planet::WorldFile world = worldToBake(edit);
    const std::string content = planet::worldText(world, folder);
    const fs::path own = folder / fmt::format("{:016x}", XXH3_64bits(content.data(), content.size()));
    const fs::path file = own / (stem + ".toml");
    std::error_code problem;
    if (fs::exists(file, problem)) return file;
    fs::create_directories(own, problem);
    if (problem)
        return planet::ioError(fmt::format("{}: cannot be created: {}", own.string(), problem.message()));
    return write(planet::worldText(world, own), file).map([&] { return file; });
}

Result<void> saveWorld(const WorldEdit& edit, const fs::path& file) {
    if (file.extension() != ".toml") {
        return planet::badInput(
            fmt::format("{}: is no name of a world file; expected one that ends with .toml", file.string()));
    }
    return checkEdit(edit).and_then([&] {
        const fs::path whole = fs::absolute(file);
        return write(planet::worldText(edit, whole.parent_path()), whole);
    });
}

}  // namespace worldy
