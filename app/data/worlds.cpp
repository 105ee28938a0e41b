#include "app/data/worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "app/base/places.h"
#include "app/data/own_colour.h"
#include "planet/source/terrain.h"

namespace worldy {

namespace {

constexpr std::string_view prefix = "preset:";

World world(const char* name, const char* title, const char* about, std::string source, double radiusM,
            std::optional<int> faceSize) {
    World made{name, title, about, {}};
    made.request.source = std::move(source);
    made.request.settings.radiusM = radiusM;
    made.request.settings.faceSize = faceSize;
    made.request.colour = ownColourImage(made.request.source);
    return made;
}

}  // namespace

std::vector<World> worlds() {
    const double earthRadiusM = planet::BakeSettings{}.radiusM;
    const std::string earth = earthElevation().string();
    // The grid is twice as fine as the samples of the image, so a step of the grid has half the relief of a
    // sample.
    const planet::DetailTerrain detail{.strength = 2};
    return {
        world("earth", "Earth",
              "Built-in elevation and bathymetry, 9 km, with the Andes at Aconcagua and the coast at "
              "Vancouver at 90 m.",
              earthWorld().string(), earthRadiusM, std::nullopt),
        world("earth-amplified", "Earth amplified",
              "Earth with fractal detail: 1.2 km at this face size, 100 m at 131073.",
              planet::terrainText({detail, earth}), earthRadiusM, 8193),
        world("moon", "Moon",
              "Craters of many sizes on rolling ground. Moon-sized. Use preset \"airless moon\".",
              "noise:craters,seed=11", 1'737'400, 2049),
        world("ridged", "Ridged world", "Mountain chains with sharp crests, the size of Mars.",
              "noise:ridged,seed=4,gain=0.6,amplitude_m=12000,feature_deg=25,offset_m=1500", 3'389'500, 2049),
    };
}

bool isWorldName(const std::filesystem::path& path) {
    return path.string().starts_with(prefix);
}

planet::Result<World> worldNamed(const std::filesystem::path& name) {
    const std::string wanted = name.string().substr(std::min(prefix.size(), name.string().size()));
    std::vector<std::string> names;
    for (World& world : worlds()) {
        if (world.name == wanted) return std::move(world);
        names.push_back(world.name);
    }
    return planet::badInput(fmt::format("{}: no such preset; expected {}{}", name.string(), prefix,
                                        fmt::join(names, fmt::format(", {}", prefix))));
}

planet::Result<NamedSource> sourceNamed(const std::filesystem::path& named,
                                        const planet::BakeSettings& settings) {
    if (!isWorldName(named)) return NamedSource{named, settings};
    const planet::Result<World> world = worldNamed(named);
    if (!world) return tl::unexpected(world.error());
    NamedSource found{world->request.source, settings};
    if (settings.radiusM == planet::BakeSettings{}.radiusM)
        found.settings.radiusM = world->request.settings.radiusM;
    if (!settings.faceSize) found.settings.faceSize = world->request.settings.faceSize;
    return found;
}

}  // namespace worldy
