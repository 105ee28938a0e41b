// Height sources made of a formula, and temporary folders, for tests.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>

#include "planet/height_source.h"

namespace planet::test {

// A source whose height, in metres, is a function of the direction alone.
inline HeightSource formulaSource(std::function<double(const glm::dvec3& direction)> height, double minM,
                                  double maxM, double stepM = 1, int naturalFaceSize = 129) {
    HeightSource source;
    source.description = "formula";
    source.naturalFaceSize = naturalFaceSize;
    source.stepM = stepM;
    source.minM = minM;
    source.maxM = maxM;
    source.sample = [height = std::move(height)](const SampleTile& tile,
                                                 std::span<float> out) -> Result<void> {
        std::size_t at = 0;
        for (int j = 0; j < tile.rows; ++j) {
            for (int i = 0; i < tile.columns; ++i) {
                const double u = 2.0 * (tile.firstColumn + i) / tile.faceCells - 1;
                const double v = 2.0 * (tile.firstRow + j) / tile.faceCells - 1;
                out[at++] = static_cast<float>(height(sphereFromCube(cubePoint(tile.face, u, v))));
            }
        }
        return {};
    };
    return source;
}

// Hills of several sizes, rough enough that every level differs from the next.
inline double hillsM(const glm::dvec3& d) {
    return std::round(2000 * std::sin(3 * d.x + 1) * std::cos(4 * d.y) + 700 * std::sin(17 * d.z + 9 * d.x) +
                      150 * std::sin(61 * d.y) * std::sin(67 * d.x + 5) +
                      40 * std::sin(311 * d.x + 251 * d.y));
}
inline HeightSource hillsSource(int naturalFaceSize = 129) {
    return formulaSource(hillsM, -3000, 3000, 1, naturalFaceSize);
}

// A fresh folder, removed with all that is in it.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "worldy-test-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace planet::test
