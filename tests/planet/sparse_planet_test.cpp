// The runtime and the meters over a sparse planet.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "planet/bake/file_report.h"
#include "planet/chunk_explanation.h"
#include "planet/measure/pick.h"
#include "planet/measure/pop_meter.h"
#include "planet/measure/true_error.h"
#include "planet/paging/normal_tile.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "planet/select/drawn_surface.h"
#include "planet/select/lod_select.h"
#include "tests/support/random_view.h"
#include "tests/support/sparse_planet.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/texel_slope.h"

namespace planet {
namespace {

using test::sparsePlanet;

const ChunkTree& sparseTree() {
    static const ChunkTree tree = sparsePlanet().wholeTree();
    return tree;
}

void ignoreUpload(std::uint32_t, StepsView) {}

// Above a place of the cube, looking about the horizon.
View viewAt(const glm::dvec3& cube, double altitudeM, double headingDeg = 60, double pitchDeg = -25) {
    const Geographic place = geographicFromDirection(sphereFromCube(cube));
    return viewFromPose({.latitudeDeg = glm::degrees(place.latitudeRad),
                         .longitudeDeg = glm::degrees(place.longitudeRad),
                         .altitudeM = altitudeM,
                         .headingDeg = headingDeg,
                         .pitchDeg = pitchDeg},
                        sparseTree().shape.radiusM, 1.1, 640, 400);
}

FacePoint placeAt(const glm::dvec3& cube) {
    return facePointFromCube(cube);
}

// Beside the rims of the planet's patches.
const std::array<glm::dvec3, 4> rims = {
    {{0.25, 0.14, 1}, {1, -0.18, 0.999}, {0.99, 0.985, 1}, {-1, -0.99, -0.98}}};

Selection selected(const ChunkTree& tree, const View& view, const LodSettings& settings) {
    Selection selection;
    selectChunks(tree, view, settings, selection);
    return selection;
}

TrueErrorReport measured(const DrawnSnapshot& snapshot) {
    FinestHeights heights(sparsePlanet().file);
    return measureTrueError(snapshot, heights).value();
}

TEST(SparsePlanet, hasLeavesOnSeveralLevels) {
    const ChunkFileInfo& info = sparsePlanet().file->info();
    EXPECT_EQ(deepestLevelOf(info.shape), 9);
    EXPECT_EQ(info.coarsestLeafLevel, 5);
    EXPECT_EQ(sparseTree().residentChunks, info.chunks);
    EXPECT_TRUE(isSparse(sparseTree()));
    const auto report = verifyFile(*sparsePlanet().file, nullptr);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->problemCount, 0u) << report->problems.front();
}

TEST(SparsePlanet, isDrawnDownToTheLeavesOfEachPlace) {
    const auto planet = Planet::open(sparsePlanet().path(), PagingSettings{});
    ASSERT_TRUE(planet) << planet.error().message;
    LodSettings all = suddenLod(1e-9);
    all.frustumCulling = all.horizonCulling = false;
    ASSERT_TRUE((*planet)->settle(viewAt(rims[0], 5000), all, ignoreUpload, 120));
    const ChunkFileInfo& info = sparsePlanet().file->info();
    EXPECT_EQ((*planet)->selection().draw.size(), leafCountOf(info.chunks));
    EXPECT_EQ((*planet)->selection().counters.waiting, 0u);
    EXPECT_EQ((*planet)->paging()[BlockKind::Heights].failed, 0u);
    EXPECT_EQ((*planet)->paging()[BlockKind::Heights].capacity, info.chunks);
    EXPECT_TRUE((*planet)->takeProblems().empty());
}

TEST(SparsePlanet, explainsThatNoSourceIsFinerUnderACoarseLeaf) {
    const auto planet = Planet::open(sparsePlanet().path(), PagingSettings{});
    ASSERT_TRUE(planet);
    const LodSettings settings = suddenLod(0.01);
    const View view = viewAt(rims[0], 2000, 0, -90);
    ASSERT_TRUE((*planet)->settle(view, settings, ignoreUpload, 60));
    const FacePoint coarse = placeAt({0.245, 0.14, 1});
    const FacePoint fine = placeAt({0.252, 0.14, 1});
    const ChunkExplanation leaf = explainChunk(**planet, chunkAt(coarse, 5));
    EXPECT_EQ(leaf.state, ChunkState::Drawn);
    EXPECT_EQ(leaf.notSplit, WhyNotSplit::SourceLimit);
    EXPECT_EQ(leaf.deltaCM, 0);
    const ChunkExplanation under = explainChunk(**planet, chunkAt(coarse, 9));
    EXPECT_EQ(under.state, ChunkState::NotInFile);
    EXPECT_EQ(under.decidedBy, chunkAt(coarse, 5));
    const ChunkExplanation deep = explainChunk(**planet, chunkAt(fine, 9));
    EXPECT_EQ(deep.state, ChunkState::Drawn);
    EXPECT_EQ(deep.notSplit, WhyNotSplit::GoodEnough);
}

TEST(SparsePlanet, leavesHaveNoErrorHoweverMuchTheyAreExaggerated) {
    ChunkTree tree = sparsePlanet().wholeTree();
    for (const double factor : {0.5, 3.0}) {
        setExaggeration(tree, factor);
        forEachNode(tree, [&](NodeIndex, const ChunkNode& node) {
            if (node.childrenState == ChildrenState::None) {
                ASSERT_EQ(node.deltaCM, 0);
                ASSERT_EQ(node.deltaTightM, 0);
                return;
            }
            for (NodeIndex q = 0; q < quadrantCount; ++q) {
                ASSERT_GE(node.deltaCM, tree.nodes[node.firstChild + q].deltaCM);
                ASSERT_GE(node.deltaTightM, tree.nodes[node.firstChild + q].deltaTightM);
            }
        });
    }
}

// The definition: every sample of every leaf under a drawn chunk against the drawn point at its place.
double largestFacingPx(const ChunkTree& tree, const DrawItem& item, const View& view, bool stitched) {
    const int cells = chunkCells(tree.shape);
    const DrawnGrid drawn = drawnGrid(tree.shape, item, *tree.nodes[item.node].heights, stitched);
    double most = 0;
    std::vector<NodeIndex> open = {item.node};
    while (!open.empty()) {
        const ChunkNode& node = tree.nodes[open.back()];
        open.pop_back();
        if (node.childrenState != ChildrenState::None) {
            for (NodeIndex q = 0; q < quadrantCount; ++q) open.push_back(node.firstChild + q);
            continue;
        }
        const int levels = node.id.level - item.id.level;
        const FaceSquare square = faceSquareOf(node.id);
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const double x =
                    std::ldexp(static_cast<int>(node.id.x - (item.id.x << levels)) * cells + i, -levels);
                const double y =
                    std::ldexp(static_cast<int>(node.id.y - (item.id.y << levels)) * cells + j, -levels);
                const glm::dvec3 direction = sphereFromCube(cubePoint(
                    item.id.face, square.u + square.side * i / cells, square.v + square.side * j / cells));
                const std::int32_t step = (*node.heights)[static_cast<std::size_t>(j * (cells + 1) + i)];
                const glm::dvec3 a = positionM(tree.shape, direction, heightM(tree.shape, step)) - view.eyeM;
                const glm::dvec3 b = pointOn(drawn, x, y) - view.eyeM;
                most =
                    std::max(most, screenScalePx(view) * glm::length(glm::normalize(a) - glm::normalize(b)));
            }
        }
    }
    return most;
}

TEST(SparsePlanet, trueErrorIsThatOfTheSamplesOfAllLeaves) {
    const ChunkTree& tree = sparseTree();
    int mixed = 0;
    int i = 0;
    for (const glm::dvec3& rim : rims) {
        for (const double altitudeM : {4000.0, 60'000.0, 400'000.0}) {
            LodSettings settings = suddenLod(4);
            settings.morph = i % 2 == 0;
            settings.seams = i % 3 == 0 ? SeamMode::Stitched : SeamMode::Skirts;
            const bool stitched = settings.seams == SeamMode::Stitched;
            const View view = viewAt(rim, altitudeM, 60.0 * i, -70);
            const Selection selection = selected(tree, view, settings);
            const TrueErrorReport report = measured(snapshotOf(tree, selection.draw, view, stitched));
            ASSERT_EQ(report.chunks.size(), selection.draw.size());
            for (std::size_t at = 0; at < report.chunks.size(); ++at) {
                const DrawItem& item = selection.draw[at];
                const bool overRim = item.deltaCM > 20 && item.id.level < 5;
                if (!overRim && at % 41 != 0) continue;
                mixed += overRim;
                const double expected = largestFacingPx(tree, item, view, stitched);
                ASSERT_NEAR(report.chunks[at].facingPx, expected, 1e-6 + 1e-6 * expected)
                    << toString(item.id);
            }
            if (!stitched) {
                EXPECT_EQ(report.violations, 0u);
            } else {
                EXPECT_EQ(report.violations, report.violationsInSeams);
            }
            ++i;
        }
    }
    EXPECT_GT(mixed, 10);
}

TEST(SparsePlanet, nothingDrawnIsFurtherOffThanItsBound) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> turn(0, 360);
    std::uint64_t samples = 0;
    for (int i = 0; i < 24; ++i) {
        LodSettings settings = suddenLod(1 + i % 3);
        settings.morph = i % 2 == 0;
        settings.morphRange = 1;
        settings.metric = i % 4 < 2 ? ErrorMetric::Additive : ErrorMetric::Tight;
        const View view =
            viewAt(rims[static_cast<std::size_t>(i) % rims.size()],
                   std::exp(std::uniform_real_distribution<double>(7.8, 13)(random)), turn(random));
        const Selection selection = selected(sparseTree(), view, settings);
        const TrueErrorReport report = measured(snapshotOf(sparseTree(), selection.draw, view, false));
        EXPECT_EQ(report.violations, 0u) << i;
        samples += report.samples;
    }
    EXPECT_GT(samples, 100'000u);
}

TEST(SparsePlanet, fadesAcrossARimStayWithinTheBound) {
    // A descent in steps, so that edges at rims fade between levels.
    LodSettings settings;
    settings.tauPx = 2;
    Selection selection;
    double altitudeM = 60'000;
    for (int frame = 0; frame < 60; ++frame, altitudeM *= 0.93) {
        const View view = viewAt(rims[0], altitudeM, 20, -60);
        selectChunks(sparseTree(), view, settings, selection, 0.05);
        if (frame % 6 != 0) continue;
        const TrueErrorReport report = measured(snapshotOf(sparseTree(), selection.draw, view, false));
        EXPECT_EQ(report.violations, 0u) << frame;
    }
}

TEST(SparsePlanet, aRayHitsTheLeafOfItsPlace) {
    const View view = viewAt({0.2503, 0.14, 1}, 8000, 0, -90);
    const Selection selection = selected(sparseTree(), view, suddenLod(1e-3));
    int coarse = 0;
    int fine = 0;
    for (int i = -20; i <= 20; ++i) {
        const glm::dvec3 direction = -view.back + 0.01 * i * view.right;
        const auto hit = pickSurface(sparseTree(), selection.draw, view.eyeM, direction);
        ASSERT_TRUE(hit);
        const double groundM = residentHeightM(sparseTree(), hit->positionM) + sparseTree().shape.radiusM;
        EXPECT_NEAR(glm::length(hit->positionM), groundM, 1e-3) << i << " " << toString(hit->id);
        coarse += hit->id.level == 5;
        fine += hit->id.level == 9;
    }
    EXPECT_GT(coarse, 3);
    EXPECT_GT(fine, 3);
}

// ---- normals

class SparseNormals : public testing::Test {
protected:
    NormalDeriver deriver() const {
        std::array<HeldChunk, faceCount> roots;
        for (std::size_t face = 0; face < faceCount; ++face) {
            const ChunkNode& root = sparseTree().nodes[face];
            roots[face] = {root.id, root.heights, root.children};
        }
        return {sparseTree().storedShape, roots,
                [](const ChunkId& parent, BlockLocation location, StepsView heights) {
                    return sparsePlanet().file->readChildren(parent, location, heights);
                }};
    }
};

TEST_F(SparseNormals, endWhereNoHeightsAreFiner) {
    NormalDeriver normals = deriver();
    EXPECT_EQ(normalLeafLevel(sparseTree().shape), 5);
    const std::vector<test::FineBox> patches = test::rimPatches(16 << 9);
    // Tiles of level 1 have the grid of chunks of level 5.
    for (int q = 0; q < quadrantCount; ++q) {
        const ChunkId id = childOf({Face::PosZ, 0, 0, 0}, q);
        const bool hasPatch = std::any_of(patches.begin(), patches.end(), [&](const test::FineBox& patch) {
            return test::overlap(id, patch);
        });
        EXPECT_EQ(normals.tile(id)->isRefined, hasPatch) << q;
    }
    EXPECT_FALSE(normals.tile({Face::NegY, 1, 0, 1})->isRefined);
    EXPECT_TRUE(normals.tile(chunkAt(placeAt({0.252, 0.13, 1}), 4))->isRefined);
    EXPECT_FALSE(normals.tile(chunkAt(placeAt({0.252, 0.13, 1}), 5))->isRefined);
}

TEST_F(SparseNormals, areThoseOfADensePlanetWhereHeightsAreFine) {
    NormalDeriver normals = deriver();
    const ChunkId id = chunkAt(placeAt({0.26, 0.14, 1}), 5);
    const TileData tile = normals.tile(id).value();
    const int cells = tileCells << 5;
    const PlanetShape& shape = sparseTree().storedShape;
    int compared = 0;
    for (int j = tileBorderBefore + 2; j < tileTexels - 20; j += 7) {
        for (int i = tileBorderBefore + 2; i < tileTexels - 20; i += 5) {
            const int column = static_cast<int>(id.x) * tileCells - tileBorderBefore + i;
            const int row = static_cast<int>(id.y) * tileCells - tileBorderBefore + j;
            const auto heightAt = [&](int c, int r) {
                return test::roughM(
                    sphereFromCube(cubePoint(Face::PosZ, 2.0 * c / cells - 1, 2.0 * r / cells - 1)));
            };
            const auto isFine = [&](int c, int r) {
                const FacePoint place{Face::PosZ, 2.0 * c / cells - 1, 2.0 * r / cells - 1};
                return test::overlap(chunkAt(place, 9), test::rimPatches(16 << 9)[0]);
            };
            const bool fine = isFine(column - 1, row) && isFine(column + 1, row) && isFine(column, row - 1) &&
                              isFine(column, row + 1);
            if (!fine) continue;
            const auto [u, v] = slopeOfTexel(tile, i, j);
            const double perUnit = cells / 4.0 / shape.radiusM;
            const double expectedU = (heightAt(column + 1, row) - heightAt(column - 1, row)) * perUnit;
            const double expectedV = (heightAt(column, row + 1) - heightAt(column, row - 1)) * perUnit;
            ASSERT_NEAR(u, expectedU, 1e-3 * std::abs(expectedU) + 1e-6);
            ASSERT_NEAR(v, expectedV, 1e-3 * std::abs(expectedV) + 1e-6);
            ++compared;
        }
    }
    EXPECT_GT(compared, 100);
}

TEST_F(SparseNormals, betweenTheVerticesOfACoarseLeafAreItsOwnSlopes) {
    NormalDeriver normals = deriver();
    // A tile of level 4 whose border reaches over the rim at x = 1/4. Its chunks of level 8 do not exist
    // there.
    constexpr double coarseCell = 2.0 / 512;
    const ChunkId id = chunkAt(placeAt({0.252, 0.13, 1}), 4);
    const TileData tile = normals.tile(id).value();
    // The middle of the leaf's last cell before the rim, on a line of its grid.
    const glm::dvec3 cube{0.25 - coarseCell / 2, 33 * coarseCell, 1};
    const FacePoint place = placeAt(cube);
    const double cells = tileCells << 4;
    const auto texelAt = [&](double along, std::uint32_t tileAt) {
        return static_cast<int>(std::lround((along + 1) / 2 * cells)) - static_cast<int>(tileAt) * tileCells +
               tileBorderBefore;
    };
    const auto [u, v] = slopeOfTexel(tile, texelAt(place.u, id.x), texelAt(place.v, id.y));
    const FaceAxes& axes = faceAxes(Face::PosZ);
    const double slope = static_cast<double>(u) * axes.u.x + static_cast<double>(v) * axes.v.x;
    const glm::dvec3 half{coarseCell / 2, 0, 0};
    const double riseM =
        test::roughM(sphereFromCube(cube + half)) - test::roughM(sphereFromCube(cube - half));
    const double expected = riseM / coarseCell / sparseTree().storedShape.radiusM;
    EXPECT_GT(std::abs(expected), 0.01);
    EXPECT_NEAR(slope, expected, 1e-3 * std::abs(expected) + 1e-6);
}

TEST_F(SparseNormals, ArePagedWhileFlyingOverARim) {
    PagingSettings settings;
    settings.normals = true;
    const auto planet = Planet::open(sparsePlanet().path(), settings);
    ASSERT_TRUE(planet);
    ViewInput input{viewAt(rims[0], 3000, 0, -50), suddenLod(1)};
    input.normals = {.enabled = true};
    ASSERT_TRUE((*planet)->settle(std::span(&input, 1), ignoreUpload, 60));
    EXPECT_EQ((*planet)->paging()[BlockKind::Normals].failed, 0u);
    EXPECT_GT((*planet)->tiles(BlockKind::Normals).residentTiles, 20u);
    for (const TileNode& node : (*planet)->tiles(BlockKind::Normals).nodes) {
        if (node.id.level > 1 && node.parent != noNode) {
            EXPECT_NE(node.id.face, Face::NegX);
        }
    }
}

}  // namespace
}  // namespace planet
