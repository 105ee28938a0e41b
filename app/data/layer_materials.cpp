#include "app/data/layer_materials.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "app/base/report.h"
#include "app/settings/layer_file.h"
#include "planet/base/atomic_file.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Result;

Result<void> writeTexture(const fs::path& file, std::span<const std::uint8_t> bytes, int size, int channels) {
    return planet::writeAtomically(file, [&](const fs::path& temporary) -> Result<void> {
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(temporary.string());
        OIIO::ImageSpec spec(size, size, channels, OIIO::TypeDesc::UINT8);
        spec.attribute("png:compressionLevel", 9);
        // The fourth channel is relief, so colour must not be multiplied by it.
        spec.attribute("oiio:UnassociatedAlpha", 1);
        if (output && output->open(temporary.string(), spec) &&
            output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) && output->close())
            return {};
        const std::string why = output ? output->geterror() : OIIO::geterror();
        return planet::ioError(
            fmt::format("{}: cannot be written: {}; expected a writable folder", file.string(), why));
    });
}

Result<void> writeMaterial(const MakeLayersOptions& options, planet::Material material) {
    const planet::MaterialMaps maps = planet::makeMaterial(material, options.texels, options.seed);
    const std::string_view name = planet::materialNames[static_cast<std::size_t>(material)];
    const auto file = [&](const char* what) { return options.output / fmt::format("{}_{}.png", name, what); };
    return writeTexture(file("albedo"), maps.albedo, maps.size, 4)
        .and_then([&] { return writeTexture(file("normal"), maps.normal, maps.size, 3); })
        .and_then([&] { return writeTexture(file("roughness"), maps.roughness, maps.size, 1); });
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
