#include "planet/surface/layer_material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "planet/surface/tiling_noise.h"

namespace planet {
namespace {

std::vector<Material> allMaterials() {
    return {Material::Sand, Material::Grass, Material::Forest,
            Material::Rock, Material::Snow,  Material::SeaBed};
}

// The mean step of brightness from each texel to the one right of it, or below it, in one column or row.
double stepAcross(const MaterialMaps& maps, int line, bool columns) {
    double sum = 0;
    for (int along = 0; along < maps.size; ++along) {
        const auto at = [&](int across) {
            const int x = columns ? across % maps.size : along;
            const int y = columns ? along : across % maps.size;
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(maps.size) +
                                       static_cast<std::size_t>(x));
            return maps.albedo[i] + maps.albedo[i + 1] + maps.albedo[i + 2];
        };
        sum += std::abs(at(line) - at(line + 1));
    }
    return sum / maps.size;
}

TEST(LayerMaterial, TheSameSeedGivesTheSameAndAnotherSeedAnother) {
    for (const Material material : allMaterials()) {
        const MaterialMaps once = makeMaterial(material, 64, 5), again = makeMaterial(material, 64, 5);
        EXPECT_EQ(once.albedo, again.albedo);
        EXPECT_EQ(once.normal, again.normal);
        EXPECT_EQ(once.roughness, again.roughness);
        EXPECT_NE(once.albedo, makeMaterial(material, 64, 6).albedo);
    }
}

TEST(LayerMaterial, TilesWithoutASeam) {
    for (const Material material : allMaterials()) {
        const MaterialMaps maps = makeMaterial(material, 128, 1);
        for (const bool columns : {true, false}) {
            double usual = 0, most = 0;
            for (int line = 0; line < maps.size - 1; ++line) {
                const double step = stepAcross(maps, line, columns);
                usual += step / (maps.size - 1);
                most = std::max(most, step);
            }
            EXPECT_LE(stepAcross(maps, maps.size - 1, columns), std::max(most, 1.3 * usual))
                << materialNames[static_cast<std::size_t>(material)];
        }
    }
}

TEST(LayerMaterial, NormalsAreUnitAndEvenOnAverage) {
    for (const Material material : allMaterials()) {
        const MaterialMaps maps = makeMaterial(material, 64, 1);
        double right = 0, up = 0;
        for (std::size_t i = 0; i < maps.normal.size(); i += 3) {
            const double x = (maps.normal[i] - 128) / 127.0, y = (maps.normal[i + 1] - 128) / 127.0,
                         z = (maps.normal[i + 2] - 128) / 127.0;
            EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), 1, 0.05);
            right += x, up += y;
        }
        EXPECT_NEAR(right / (64 * 64), 0, 0.03);
        EXPECT_NEAR(up / (64 * 64), 0, 0.03);
    }
}

TEST(TilingNoise, RepeatsAfterTheUnitSquare) {
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 place(tilingRandom(1, static_cast<std::uint32_t>(i), 1),
                               tilingRandom(2, static_cast<std::uint32_t>(i), 1));
        for (const glm::dvec2& turn : {glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(-2, 3)}) {
            EXPECT_NEAR(tilingFbm(place, 3, 4, 9), tilingFbm(place + turn, 3, 4, 9), 1e-9);
            EXPECT_NEAR(tilingRidges(place, 5, 3, 9), tilingRidges(place + turn, 5, 3, 9), 1e-9);
            EXPECT_NEAR(tilingCells(place, 7, 9).nearest, tilingCells(place + turn, 7, 9).nearest, 1e-9);
        }
    }
}

}  // namespace
}  // namespace planet
