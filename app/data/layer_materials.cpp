#include "app/data/layer_materials.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "app/base/picture_file.h"
#include "app/base/report.h"
#include "app/settings/layer_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

Result<void> writeMaterial(const MakeLayersOptions& options, planet::Material material) {
    const planet::MaterialMaps maps = planet::makeMaterial(material, options.texels, options.seed);
    const std::string_view name = planet::materialNames[static_cast<std::size_t>(material)];
    const auto file = [&](const char* what) { return options.output / fmt::format("{}_{}.png", name, what); };
    return writeTexture({maps.size, 4, maps.albedo}, file("albedo"))
        .and_then([&] {
            return writeTexture({maps.size, 3, maps.normal}, file("normal"));
        })
        .and_then([&] {
            return writeTexture({maps.size, 1, maps.roughness}, file("roughness"));
        });
}

}  // namespace

Result<void> makeLayers(const MakeLayersOptions& options) {
    std::error_code status;
    fs::create_directories(options.output, status);
    if (status) {
        return planet::ioError(fmt::format("{}: cannot be created: {}; expected the name of a folder",
                                           options.output.string(), status.message()));
    }
    for (std::size_t i = 0; i < planet::materialNames.size(); ++i) {
        if (Result<void> made = writeMaterial(options, static_cast<planet::Material>(i)); !made) return made;
        if (!options.json) fmt::print("{}\n", planet::materialNames[i]);
    }
    if (options.json) {
        fmt::print("{}", jsonText({{"output", options.output.string()},
                                   {"texels", options.texels},
                                   {"seed", options.seed},
                                   {"materials", planet::materialNames},
                                   {"layer_sets", {"earth.toml", "two_layer_height_blend.toml"}}}));
    }
    return saveLayerSet(planet::earthLayers(), options.output, options.output / "earth.toml").and_then([&] {
        return saveLayerSet(planet::twoLayerHeightBlend(), options.output,
                            options.output / "two_layer_height_blend.toml");
    });
}

}  // namespace worldy
