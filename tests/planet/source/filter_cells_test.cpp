// Samples of a coarse grid that are taken with the filter of a finer one.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "planet/source/height_source.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/terrain.h"
#include "tests/planet/source/height_source_fixture.h"

namespace planet {
namespace {

// Compares every fourth sample of a fine grid with the same places of a coarser one of so many cells, on the edges of a
// face and inside it.
void expectSameAtSharedPlaces(const HeightSource& source, const std::string& name, int coarse = 256) {
    constexpr int side = 37;
    const int fine = 4 * coarse;
    const int last = coarse - side + 1;
    int differ = 0;
    for (const Face face : {Face::PosX, Face::NegY, Face::PosZ}) {
        for (const auto& [column, row] :
             {std::pair{0, 0}, std::pair{95 * last / 220, 40 * last / 220}, std::pair{last, last}}) {
            const SampleTile tile{face, coarse, column, row, side, side, fine};
            const SampleTile finer{face, fine, 4 * column, 4 * row, 4 * (side - 1) + 1, 4 * (side - 1) + 1};
            const auto shared = sampled(source, tile);
            const auto all = sampled(source, finer);
            for (int j = 0; j < side; ++j) {
                for (int i = 0; i < side; ++i) {
                    const auto at = static_cast<std::size_t>(j * side + i);
                    const auto place = static_cast<std::size_t>(4 * j * finer.columns + 4 * i);
                    differ += shared[at] != all[place];
                }
            }
        }
    }
    EXPECT_EQ(differ, 0) << name;
}

TEST(FilterCells, MakeTheHeightsOfACoarseGridThoseOfAFinerOne) {
    for (const TerrainSettings& settings :
         {TerrainSettings{FractalTerrain{}}, TerrainSettings{RidgedTerrain{}},
          TerrainSettings{FaultTerrain{}}, TerrainSettings{MidpointTerrain{}},
          TerrainSettings{CraterTerrain{}}}) {
        const auto source = makeTerrain(settings);
        ASSERT_TRUE(source);
        expectSameAtSharedPlaces(*source, source->description);
    }
}

TEST(FilterCells, MakeTheHeightsOfACoarseGridOfAFileThoseOfAFinerOne) {
    const auto path = std::filesystem::path(WORLDY_SOURCE_DIR) / "data/earth/elevation.tif";
    const auto earth = openHeightSource(path, {});
    ASSERT_TRUE(earth) << earth.error().message;
    expectSameAtSharedPlaces(*earth, "equirectangular");
    const auto detailed = amplified(*earth, DetailTerrain{});
    ASSERT_TRUE(detailed);
    expectSameAtSharedPlaces(*detailed, "detail");
}

TEST(FilterCells, MakeTheHeightsOfACoarseGridOfFacesThoseOfAFinerOne) {
    constexpr int coarse = 64;
    // The finer grid has 256 cells: two samples stand in each, or fewer than one.
    for (const int size : {33, 513, 175}) {
        const TemporaryFolder folder;
        for (const Face face : allFaces) {
            writeImage(folder / ("face_" + std::string(faceName(face)) + ".png"),
                       Image<std::uint16_t>(size, size, [&](int column, int row) {
                           const double x = 2.0 * column / (size - 1) - 1;
                           const double y = 1 - 2.0 * row / (size - 1);
                           const glm::dvec3 d = sphereFromCube(cubePoint(face, x, y));
                           return std::round(30'000 +
                                             9'000 * std::sin(40 * d.x + 3) * std::cos(37 * d.y - d.z) +
                                             800 * std::sin(900 * d.x + 700 * d.z));
                       }));
        }
        const auto faces = openHeightSource(folder / "face_x_pos.png", {});
        ASSERT_TRUE(faces) << faces.error().message;
        expectSameAtSharedPlaces(*faces, std::to_string(size), coarse);
    }
}

TEST(FilterCells, AverageOverTheCellsOfTheirOwnGrid) {
    const auto path = std::filesystem::path(WORLDY_SOURCE_DIR) / "data/earth/elevation.tif";
    const auto earth = openHeightSource(path, {});
    ASSERT_TRUE(earth);
    const SampleTile tile{Face::PosX, 64, 10, 10, 33, 33};
    SampleTile sharp = tile;
    sharp.filterCells = 4096;
    const auto averaged = sampled(*earth, tile);
    const auto exact = sampled(*earth, sharp);
    double difference = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        difference = std::max(difference, std::abs(static_cast<double>(averaged[i] - exact[i])));
    EXPECT_GT(difference, 50);
}

}  // namespace
}  // namespace planet
