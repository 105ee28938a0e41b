#include "tests/support/synthetic_colours.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "tests/support/tile_directions.h"

namespace planet::test {

ColourSource formulaColours(std::function<glm::dvec3(const glm::dvec3& direction)> colour,
                            int naturalFaceSize) {
    ColourSource source;
    source.description = "formula";
    source.naturalFaceSize = naturalFaceSize;
    source.sample = [colour = std::move(colour)](const SampleTile& tile,
                                                 std::span<glm::vec3> out) -> Result<void> {
        std::size_t at = 0;
        forEachDirection(tile,
                         [&](const glm::dvec3& direction) { out[at++] = glm::vec3(colour(direction)); });
        return {};
    };
    return source;
}

glm::dvec3 mottled(const glm::dvec3& d) {
    const double land = std::sin(5 * d.x + 2 * std::sin(3 * d.y)) * std::cos(4 * d.z) > 0.1 ? 1 : 0;
    const double grain = 0.5 + 0.25 * std::sin(91 * d.x + 37 * d.z) + 0.25 * std::sin(83 * d.y);
    return land * glm::dvec3(0.25, 0.35, 0.08) * (0.4 + grain) +
           (1 - land) * glm::dvec3(0.01, 0.04, 0.13) * (0.8 + 0.4 * grain);
}

ColourSource mottledColours(int naturalFaceSize) {
    return formulaColours(mottled, naturalFaceSize);
}

}  // namespace planet::test
