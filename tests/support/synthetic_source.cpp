#include "tests/support/synthetic_source.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "tests/support/tile_directions.h"

namespace planet::test {

HeightSource formulaSource(std::function<double(const glm::dvec3& direction)> height, double minM,
                           double maxM, double stepM, int naturalFaceSize) {
    HeightSource source;
    source.description = "formula";
    source.naturalFaceSize = naturalFaceSize;
    source.stepM = stepM;
    source.minM = minM;
    source.maxM = maxM;
    source.sample = [height = std::move(height)](const SampleTile& tile,
                                                 std::span<float> out) -> Result<void> {
        std::size_t at = 0;
        forEachDirection(
            tile, [&](const glm::dvec3& direction) { out[at++] = static_cast<float>(height(direction)); });
        return {};
    };
    return source;
}

double hillsM(const glm::dvec3& d) {
    return std::round(2000 * std::sin(3 * d.x + 1) * std::cos(4 * d.y) + 700 * std::sin(17 * d.z + 9 * d.x) +
                      150 * std::sin(61 * d.y) * std::sin(67 * d.x + 5) +
                      40 * std::sin(311 * d.x + 251 * d.y));
}

HeightSource hillsSource(int naturalFaceSize) {
    return formulaSource(hillsM, -3000, 3000, 1, naturalFaceSize);
}

}  // namespace planet::test
