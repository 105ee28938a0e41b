// The parts of mosaics: heights may change only where a part that has changed has influence.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "planet/source/sample_tiles.h"
#include "planet/sphere/cube_sphere.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::gridAround;
using test::radPerDeg;
using test::SampleGrid;
using test::writeRaster;

constexpr int tileSamples = 100;
constexpr int tilesAcross = 3;

struct MosaicPlace {
    const char* name;
    int epsg;
    double longitudeDeg;
    double latitudeDeg;
    double step;
};

// A folder with a mosaic of 3 x 3 tiles that abut.
class RasterParts : public testing::TestWithParam<MosaicPlace> {
protected:
    RasterParts() {
        for (int tile = 0; tile < tilesAcross * tilesAcross; ++tile) writeTile(tile, 0);
    }

    SampleGrid gridOf(int tile) const {
        const MosaicPlace& place = GetParam();
        SampleGrid grid = gridAround(place.epsg, place.longitudeDeg, place.latitudeDeg,
                                     tilesAcross * tileSamples, tilesAcross * tileSamples, place.step);
        grid.x += tile % tilesAcross * tileSamples * grid.step;
        grid.y -= tile / tilesAcross * tileSamples * grid.step;
        grid.width = grid.height = tileSamples;
        return grid;
    }

    std::filesystem::path pathOf(int tile) const { return folder / fmt::format("tiles/{}.tif", tile); }

    // Writes rough heights, raised by a number of metres. Negative: the corner that is next to the middle of the mosaic
    // gets a void instead.
    void writeTile(int tile, double raisedM) const {
        std::filesystem::create_directories(folder / "tiles");
        std::vector<float> samples;
        for (int row = 0; row < tileSamples; ++row) {
            for (int column = 0; column < tileSamples; ++column) {
                const bool isVoid = raisedM < 0 && row > tileSamples - 20 && column > tileSamples - 20;
                const double heightM = 500 + 300 * std::sin(3.0 * row + tile) * std::cos(5.0 * column);
                samples.push_back(
                    static_cast<float>(isVoid ? -9999 : std::round(heightM + std::max(raisedM, 0.0))));
            }
        }
        writeRaster(pathOf(tile), gridOf(tile), samples, {.type = GDT_Int16, .noData = -9999});
    }

    HeightSource open(const std::string& settings) const {
        writeBytes(folder / "world.toml", "[[elevation]]\nfiles = \"tiles/*.tif\"\n" + settings);
        return mustOpen(folder / "world.toml");
    }

    // Returns a square of the grid of a face around the mosaic, which is about 3 degrees wide.
    static SampleTile around(int filterCells) {
        const MosaicPlace& place = GetParam();
        constexpr int cells = 2048;
        const FacePoint middle = facePointFromDirection(
            directionFromGeographic({place.latitudeDeg * radPerDeg, place.longitudeDeg * radPerDeg}));
        const auto first = [](double along) {
            return std::clamp(static_cast<int>((along + 1) / 2 * cells) - 80, 0, cells - 160);
        };
        return {middle.face, cells, first(middle.u), first(middle.v), 161, 161, filterCells};
    }

    // The heights around the mosaic, and what they depend on.
    struct Sampled {
        std::vector<float> heights;
        std::vector<SourcePart> parts;
    };
    Sampled sampled(const std::string& settings, const SampleTile& tile) const {
        const HeightSource source = open(settings);
        Sampled result{std::vector<float>(samplesIn(tile)),
                       source.parts(std::numbers::pi / 2 / tile.filterCells).value()};
        EXPECT_TRUE(source.sample(tile, result.heights));
        return result;
    }

    // Changes the mosaic, and expects that heights change, and only inside of the caps of parts that have changed.
    template <class Edit>
    void expectOnlyInside(const std::string& settings, int filterCells, const Edit& edit) {
        SCOPED_TRACE(settings + fmt::format("filter of {} cells", filterCells));
        const SampleTile tile = around(filterCells);
        const Sampled before = sampled(settings, tile);
        edit();
        const Sampled after = sampled(settings, tile);
        std::vector<SourcePart> changed;
        const auto addMissing = [&](const Sampled& from, const Sampled& in) {
            std::ranges::copy_if(from.parts, std::back_inserter(changed), [&](const SourcePart& part) {
                return std::ranges::find(in.parts, part) == in.parts.end();
            });
        };
        addMissing(before, after);
        addMissing(after, before);
        int inside = 0;
        int outside = 0;
        for (int i = 0; i < tile.columns * tile.rows; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (before.heights[at] == after.heights[at]) continue;
            const glm::dvec3 place =
                directionOf(tile.face, tile.faceCells, tile.firstColumn + i % tile.columns,
                            tile.firstRow + i / tile.columns);
            const bool isInside = std::ranges::any_of(changed, [&](const SourcePart& part) {
                return glm::dot(part.centre, place) >= std::cos(part.radiusRad);
            });
            ++(isInside ? inside : outside);
        }
        EXPECT_GT(inside, 20);
        EXPECT_EQ(outside, 0);
        partsChanged_ = changed.size();
    }

    const TemporaryFolder folder;
    std::size_t partsChanged_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Grids, RasterParts,
                         testing::Values(MosaicPlace{"degrees", 4326, 10, 30, 0.01},
                                         MosaicPlace{"north", 4326, 20, 70, 0.01},
                                         MosaicPlace{"utm", 32632, 10, 30, 1000}),
                         [](const auto& place) { return place.param.name; });

TEST_P(RasterParts, aTileThatChangesIsOnePart) {
    for (const int filterCells : {2048, 256, 64}) {
        expectOnlyInside("", filterCells, [&] { writeTile(0, 100); });
        EXPECT_EQ(partsChanged_, 2u);
        expectOnlyInside("voids = 200\n", filterCells, [&] { writeTile(0, -1); });
        EXPECT_EQ(partsChanged_, 2u);
    }
}

TEST_P(RasterParts, aTileThatIsRemovedIsOnePart) {
    expectOnlyInside("", 512, [&] { std::filesystem::remove(pathOf(8)); });
    EXPECT_EQ(partsChanged_, 1u);
}

TEST_P(RasterParts, aBlendAtTheRimReachesFurther) {
    for (const char* const feather : {"feather_m = 20000\n", "feather_m = 100000\n"}) {
        writeTile(0, 0);
        expectOnlyInside(feather, 2048, [&] { writeTile(0, -1); });
        EXPECT_EQ(partsChanged_, 2u);
    }
}

TEST_P(RasterParts, filledVoidsMakeTheMosaicOnePart) {
    expectOnlyInside("voids = \"fill\"\n", 2048, [&] { writeTile(0, -1); });
    EXPECT_EQ(open("voids = \"fill\"\n").parts(1e-3).value().size(), 2u);
}

}  // namespace
}  // namespace planet
