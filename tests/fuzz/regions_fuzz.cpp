// Fuzzes regions files: what is read is written as the same regions, and demands of areas are at least as strict as those of
// places in them.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/settings/region_file.h"
#include "planet/tree/region_set.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace worldy;
using fuzz::isRead;
using fuzz::require;

void checkDemands(const std::vector<planet::Region>& regions) {
    const auto set = planet::RegionSet::make(regions, planet::PlanetShape{});
    require(isRead(set), "what is read is accepted");
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0.6, 0.8), glm::dvec3(0, 0, -1)}) {
        const planet::GroundArea area{{axis, 0.3}, -500, 2000};
        const planet::ChunkDemand wide = (*set)->demandIn(area);
        require(wide.tauFactor >= planet::leastTauFactor && wide.tauFactor <= planet::mostTauFactor,
                "factors lie in their range");
        for (const double aside : {0.0, 0.2}) {
            const glm::dvec3 at = glm::normalize(axis + aside * glm::dvec3(axis.y, axis.z, axis.x));
            const planet::ChunkDemand place =
                (*set)->demandIn({{at, 0}, 100, 100}, (*set)->partsIn(area, (*set)->allParts()));
            if (glm::dot(at, axis) < 0.956) continue;  // outside the cone
            require(wide.tauFactor <= place.tauFactor && wide.leastLevel >= place.leastLevel &&
                        wide.mostLevel >= place.mostLevel,
                    "an area is at least as strict as its places");
        }
        static_cast<void>((*set)->effectsIn(area, (*set)->allParts()));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto regions = regionsFromText(fuzz::textOf(data, size), "fuzzed.regions.toml");
    if (!isRead(regions)) return 0;
    const auto again = regionsFromText(regionsText(*regions), "written.regions.toml");
    require(isRead(again), "what is written can be read");
    require(*again == *regions, "what is read again is the same");
    for (const planet::Region& region : *regions)
        static_cast<void>(planet::outlinesOf(region, planet::earthRadiusM));
    checkDemands(*regions);
    return 0;
}
