// Surveys of a small planet: the same bytes with any number of threads and wherever they were interrupted; planted
// regressions are found and placed; hostile files are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "planet/base/percentile.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_file.h"
#include "planet/measure/atlas_run.h"
#include "planet/measure/atlas_tree.h"
#include "planet/planet.h"
#include "planet/sphere/bounds.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using testing::HasSubstr;
using tests::contentOf;
using tests::TemporaryFolder;

AtlasSurvey smallSurvey(std::uint64_t most = 200) {
    AtlasSurvey survey;
    survey.bake = "fake.chk";
    survey.radiusM = fakePyramid().shape.radiusM;
    survey.settings = "[lod]\n";
    survey.widthPx = 640;
    survey.heightPx = 400;
    survey.grid.altitudesM = {survey.radiusM * 0.02, survey.radiusM * 0.2};
    survey.grid.headings = 2;
    survey.grid.most = most;
    return survey;
}

AtlasSettings smallSettings() {
    AtlasSettings settings;
    settings.input.lod.tauPx = 1;
    settings.paging.time = PagingTime::Simulated;
    settings.paging.badDisk.latencyMs = 4;
    settings.paging.badDisk.bandwidthMBs = 10;
    return settings;
}

AtlasWatch keepGoing() {
    return {[](const AtlasProgress&) { return true; },
            [](std::span<const AtlasViewpoint>) -> Result<void> { return {}; }};
}

std::vector<AtlasViewpoint> survey(const FakePyramid& pyramid, const AtlasSurvey& survey,
                                   const AtlasSettings& settings, std::size_t threads = 2,
                                   std::span<const AtlasViewpoint> revisited = {}) {
    std::vector<AtlasViewpoint> viewpoints;
    const auto open = [&]() -> Result<PlanetSource> { return pyramid.source(); };
    EXPECT_TRUE(runAtlas(open, survey, settings, revisited, threads, viewpoints, keepGoing()));
    return viewpoints;
}

const std::vector<AtlasViewpoint>& before() {
    static const std::vector<AtlasViewpoint> viewpoints =
        survey(fakePyramid(), smallSurvey(), smallSettings());
    return viewpoints;
}

std::vector<AtlasViewpoint> revisit(const FakePyramid& pyramid,
                                    const AtlasSettings& settings = smallSettings()) {
    AtlasSurvey again = smallSurvey();
    again.isRevisit = true;
    return survey(pyramid, again, settings, 2, before());
}

AtlasTree treeOf(const FakePyramid& pyramid) {
    return atlasTreeOf(pyramid.source(), [] { return true; }).value();
}

// NaN differs from itself.
bool areSame(std::span<const AtlasViewpoint> a, std::span<const AtlasViewpoint> b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
               return x.place == y.place && x.eyeM == y.eyeM &&
                      std::memcmp(x.figures.data(), y.figures.data(), sizeof x.figures) == 0;
           });
}

bool isAtOrUnder(const ChunkId& id, const ChunkId& top) {
    return id.level >= top.level && ancestorOf(id, top.level) == top;
}

constexpr ChunkId country{Face::PosX, 1, 1, 1};

FakePyramid withHalvedErrors() {
    FakePyramid pyramid = fakePyramid();
    for (auto& [id, chunk] : pyramid.chunks) {
        if (!isAtOrUnder(id, country)) continue;
        chunk.deltaCM /= 2;
        chunk.deltaTightM /= 2;
    }
    return pyramid;
}

const AtlasMeasureDiff& of(const std::vector<AtlasMeasureDiff>& diffs, AtlasMeasure measure) {
    return *std::find_if(diffs.begin(), diffs.end(), [&](const auto& one) { return one.measure == measure; });
}

double degreesFrom(const ChunkId& cell, const AtlasMove& move) {
    const double cosine = glm::dot(middleOf(cell), middleOf(before()[move.viewpoint].place.cell));
    return glm::degrees(std::acos(std::min(cosine, 1.0)));
}

TEST(Atlas, MeasuresWhatAViewerSeesAndPays) {
    for (const AtlasViewpoint& viewpoint : before()) {
        EXPECT_GT(figureOf(viewpoint.figures, AtlasMeasure::Triangles), 0);
        EXPECT_LE(figureOf(viewpoint.figures, AtlasMeasure::EpsPx), 1);
        EXPECT_TRUE(std::isnan(figureOf(viewpoint.figures, AtlasMeasure::MeasuredPx)));
        // Each of the reads takes at least half of the latency.
        const double bytes = figureOf(viewpoint.figures, AtlasMeasure::BytesRead);
        EXPECT_GE(figureOf(viewpoint.figures, AtlasMeasure::SharpS), bytes > 0 ? 0.002 + bytes / 10e6 : 0);
    }
}

TEST(Atlas, ASlowerDiskTakesLongerUntilItIsSharp) {
    AtlasSettings slow = smallSettings();
    slow.paging.badDisk.latencyMs *= 2;
    slow.paging.badDisk.bandwidthMBs /= 2;
    const auto now = revisit(fakePyramid(), slow);
    for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_NEAR(figureOf(now[i].figures, AtlasMeasure::SharpS),
                    2 * figureOf(before()[i].figures, AtlasMeasure::SharpS), 0.01);
        EXPECT_EQ(figureOf(now[i].figures, AtlasMeasure::BytesRead),
                  figureOf(before()[i].figures, AtlasMeasure::BytesRead));
    }
}

TEST(Atlas, AViewThatIsNotSharpInTimeHasNoTimeUntilItIs) {
    std::vector<double> wanted;
    for (const AtlasViewpoint& viewpoint : before())
        wanted.push_back(figureOf(viewpoint.figures, AtlasMeasure::BytesRead));
    // The disk reads in time what the view with the lower median wants, but not what the largest ones want.
    const double bytesInTime = 1.05 * percentileOf(std::vector(wanted), 0.5);
    AtlasSettings slow = smallSettings();
    slow.paging.badDisk.bandwidthMBs = bytesInTime / atlasTimeoutS * 1e-6;
    const auto now = revisit(fakePyramid(), slow);
    std::size_t unsharp = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const AtlasFigures& figures = now[i].figures;
        const bool isSharp = !std::isnan(figureOf(figures, AtlasMeasure::SharpS));
        EXPECT_EQ(isSharp, !std::isnan(figureOf(figures, AtlasMeasure::BytesRead)));
        EXPECT_GT(figureOf(figures, AtlasMeasure::Triangles), 0);
        EXPECT_TRUE(isSharp || wanted[i] > 0.9 * bytesInTime) << wanted[i];
        EXPECT_TRUE(!isSharp || wanted[i] < 1.1 * bytesInTime) << wanted[i];
        if (!isSharp) ++unsharp;
    }
    EXPECT_GT(unsharp, 0u);
    ASSERT_LT(unsharp, now.size());
    // A figure that one of two surveys lacks is not compared.
    const auto diffs = compareViewpoints(before(), now).value();
    EXPECT_EQ(of(diffs, AtlasMeasure::SharpS).compared, now.size() - unsharp);
}

TEST(Atlas, MeasuresTheTrueErrorWithinItsBound) {
    AtlasSurvey with = smallSurvey(24);
    with.measuresError = true;
    double most = 0;
    for (const AtlasViewpoint& viewpoint : survey(fakePyramid(), with, smallSettings())) {
        EXPECT_LE(figureOf(viewpoint.figures, AtlasMeasure::MeasuredPx),
                  figureOf(viewpoint.figures, AtlasMeasure::DrawnBoundPx) * 1.001 + 1e-3);
        most = std::max(most, figureOf(viewpoint.figures, AtlasMeasure::MeasuredPx));
    }
    EXPECT_GT(most, 0.1);
}

// The whole planet is drawn as its six roots, in whose bounds some of the eyes are.
TEST(Atlas, AnEyeInTheBoundsOfACoarseChunkHasNoBoundOfTheError) {
    AtlasSettings coarse = smallSettings();
    coarse.input.lod.maxLevel = 0;
    const AtlasSurvey with = smallSurvey();
    const auto planet = Planet::open(fakePyramid().source(), coarse.paging).value();
    std::size_t inside = 0, outside = 0;
    for (const AtlasViewpoint& viewpoint : survey(fakePyramid(), with, coarse)) {
        const View view = viewFromPose(poseOf(with, viewpoint), with.radiusM, glm::radians(with.fovDeg),
                                       with.widthPx, with.heightPx);
        bool isAtSurface = false, isInside = false;
        for (std::size_t face = 0; face < faceCount; ++face) {
            const ChunkNode& root = planet->tree().nodes[face];
            ASSERT_EQ(root.id.level, 0);
            const double distance = distanceM(root.bounds.box, view.eyeM);
            isInside = isInside || distance == 0;
            isAtSurface = isAtSurface || distance <= static_cast<double>(root.deltaCM);
        }
        const double epsPx = figureOf(viewpoint.figures, AtlasMeasure::EpsPx);
        if (isInside) {
            EXPECT_TRUE(std::isinf(epsPx)) << toString(viewpoint.place.cell);
            EXPECT_TRUE(std::isinf(figureOf(viewpoint.figures, AtlasMeasure::DrawnBoundPx)));
        }
        if (!isAtSurface) {
            EXPECT_LT(epsPx, screenScalePx(with)) << toString(viewpoint.place.cell);
        }
        inside += isInside;
        outside += !isAtSurface;
    }
    EXPECT_GT(inside, 0u);
    EXPECT_GT(outside, 0u);
}

TEST(Atlas, APredictedErrorHasNoBoundFromTheWidthOfTheViewOn) {
    AtlasSurvey quarter;
    quarter.widthPx = 1000;
    quarter.fovDeg = 90;
    EXPECT_NEAR(screenScalePx(quarter), 500, 1e-9);
    EXPECT_EQ(atlasBoundPx(499, 500), 499);
    EXPECT_EQ(atlasBoundPx(500, 500), INFINITY);
    EXPECT_TRUE(std::isnan(atlasBoundPx(NAN, 500)));
}

TEST(Atlas, ABoundThatIsLostIsTheLargestIncreaseAndOneThatStaysLostIsNone) {
    std::vector<AtlasViewpoint> old(before().begin(), before().begin() + 4), now = old;
    const auto eps = [](AtlasViewpoint& viewpoint) -> double& {
        return viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)];
    };
    eps(old[0]) = eps(now[0]) = eps(now[1]) = eps(old[2]) = INFINITY;
    eps(now[3]) = eps(old[3]) + 7;
    const auto diffs = compareViewpoints(old, now).value();
    const AtlasMeasureDiff& diff = of(diffs, AtlasMeasure::EpsPx);
    EXPECT_EQ(diff.compared, 4u);
    EXPECT_EQ(diff.grew, 2u);
    EXPECT_EQ(diff.shrank, 1u);
    EXPECT_EQ(diff.moves[0].viewpoint, 1u);
    EXPECT_EQ(diff.moves[1].viewpoint, 3u);
    EXPECT_EQ(diff.moves[2].viewpoint, 2u);
    const AtlasLimit limit = *atlasLimitFromText("eps_px=+1000000%");
    EXPECT_TRUE(isExceeded(limit, 0.5, INFINITY));
    EXPECT_FALSE(isExceeded(limit, INFINITY, INFINITY));
    EXPECT_FALSE(isExceeded(limit, INFINITY, 0.5));
    EXPECT_TRUE(isExceeded(*atlasLimitFromText("eps_px=-10%"), INFINITY, 0.5));
}

TEST(Atlas, ACellShowsTheLargestIncreaseOfItsHeadingsOrElseTheLargestDecrease) {
    EXPECT_EQ(worseChange(-3, 0.5), 0.5);
    EXPECT_EQ(worseChange(1, 0.5), 1);
    EXPECT_EQ(worseChange(-3, 0), -3);
    EXPECT_EQ(worseChange(NAN, -2), -2);
    EXPECT_EQ(worseChange(INFINITY, -2), INFINITY);

    const AtlasGrid grid = smallSurvey().grid;
    std::vector<AtlasViewpoint> now = before();
    const auto triangles = [](AtlasViewpoint& viewpoint) -> double& {
        return viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::Triangles)];
    };
    for (const AtlasCell& cell : changedCellsOf(grid, changesOf(before(), now)))
        EXPECT_EQ(figureOf(cell.values, AtlasMeasure::Triangles), 0);
    // The last viewpoints are both headings of the last two cells, which are not split.
    const std::size_t count = now.size();
    triangles(now[count - 1]) -= 9;
    triangles(now[count - 2]) += 4;
    triangles(now[count - 3]) -= 5;
    const auto cells = changedCellsOf(grid, changesOf(before(), now));
    const auto valueOf = [&](const AtlasPlace& place) {
        const auto found = std::ranges::find_if(cells, [&](const AtlasCell& cell) {
            return cell.cell == place.cell && cell.altitude == place.altitude;
        });
        return figureOf(found->values, AtlasMeasure::Triangles);
    };
    EXPECT_EQ(valueOf(now[count - 1].place), 4);
    EXPECT_EQ(valueOf(now[count - 3].place), -5);
}

TEST(Atlas, AnyNumberOfThreadsGivesTheSameViewpoints) {
    EXPECT_TRUE(areSame(survey(fakePyramid(), smallSurvey(), smallSettings(), 1), before()));
    EXPECT_TRUE(areSame(survey(fakePyramid(), smallSurvey(), smallSettings(), 5), before()));
}

TEST(Atlas, ACancelledSurveyGivesTheSameBytesWhenItIsContinued) {
    const TemporaryFolder folder;
    const auto open = []() -> Result<PlanetSource> { return fakePyramid().source(); };
    const AtlasTree tree = treeOf(fakePyramid());
    const auto surveyInto = [&](const std::string& name, std::size_t cancelAfter) {
        auto resumed = AtlasWriter::resume(folder / name).value();
        Atlas atlas;
        std::optional<AtlasWriter> fresh;
        if (resumed)
            atlas = resumed->atlas;
        else
            fresh.emplace(AtlasWriter::create(folder / name, smallSurvey(), tree).value());
        AtlasWriter& writer = resumed ? resumed->writer : *fresh;
        AtlasWatch watch = keepGoing();
        std::size_t taken = 0;
        watch.take = [&](std::span<const AtlasViewpoint> viewpoints) -> Result<void> {
            if (taken >= cancelAfter) return cancelled();
            taken += viewpoints.size();
            return writer.append(viewpoints);
        };
        const auto ran = runAtlas(open, smallSurvey(), smallSettings(), {}, 2, atlas.viewpoints, watch);
        if (ran) {
            EXPECT_TRUE(writer.finish());
        }
        return ran.has_value();
    };
    EXPECT_TRUE(surveyInto("whole.atlas", 1000));
    EXPECT_FALSE(surveyInto("parts.atlas", 40));
    // A killed program may leave a record half written.
    std::ofstream(unfinishedAtlas(folder / "parts.atlas"), std::ios::app | std::ios::binary)
        << std::string("\3\0\0\0\x20\0\0\0", 8);
    EXPECT_FALSE(surveyInto("parts.atlas", 50));
    EXPECT_TRUE(surveyInto("parts.atlas", 1000));
    EXPECT_EQ(contentOf(folder / "parts.atlas"), contentOf(folder / "whole.atlas"));
    EXPECT_FALSE(std::filesystem::exists(unfinishedAtlas(folder / "parts.atlas")));
    const Atlas atlas = loadAtlas(folder / "whole.atlas").value();
    EXPECT_TRUE(atlas.isFinished);
    EXPECT_EQ(atlas.survey, smallSurvey());
    EXPECT_TRUE(areSame(atlas.viewpoints, before()));
    EXPECT_TRUE(changesBetween(atlas.tree, tree).empty());
}

TEST(Atlas, AnUnchangedPlanetHasNoDifference) {
    const auto diffs = compareViewpoints(before(), revisit(fakePyramid())).value();
    EXPECT_EQ(diffs.size(), 7u);
    for (const AtlasMeasureDiff& diff : diffs) {
        EXPECT_EQ(diff.compared, before().size());
        EXPECT_TRUE(diff.moves.empty());
    }
    EXPECT_TRUE(changesBetween(treeOf(fakePyramid()), treeOf(fakePyramid())).empty());
}

TEST(Atlas, ACountryWithHalvedErrorsIsFoundAndPlaced) {
    const FakePyramid halved = withHalvedErrors();
    const auto diffs = compareViewpoints(before(), revisit(halved)).value();
    const AtlasMeasureDiff& triangles = of(diffs, AtlasMeasure::Triangles);
    ASSERT_GT(triangles.shrank, 0u);
    // The quarter of a face is 45 degrees wide, so its corners are 32 degrees from its middle.
    EXPECT_LT(degreesFrom(country, triangles.moves.back()), 50);
    const auto changes = changesBetween(treeOf(fakePyramid()), treeOf(halved));
    for (const AtlasChunkChange& change : changes) {
        EXPECT_TRUE(isAtOrUnder(change.chunk, country)) << toString(change.chunk);
        EXPECT_EQ(change.change, AtlasChange::Error);
        EXPECT_FLOAT_EQ(change.newDeltaCM, change.oldDeltaCM / 2);
    }
    EXPECT_FALSE(changes.empty());
    const auto areas = changedAreas(changes, 1);
    ASSERT_EQ(areas.size(), 1u);
    EXPECT_EQ(areas[0].cell, country);
    EXPECT_DOUBLE_EQ(areas[0].leastRatio, 0.5);
}

TEST(Atlas, ChangedLeavesAboveTheLevelOfAreasAreAreasOfTheirOwn) {
    const auto changes = changesBetween(treeOf(fakePyramid()), treeOf(withHalvedErrors()));
    const int belowAll = deepestLevelOf(fakePyramid().shape) + 3;
    int finest = 0;
    for (const AtlasChunkChange& change : changes) finest = std::max(finest, int{change.chunk.level});
    const auto areas = changedAreas(changes, belowAll);
    ASSERT_EQ(areas.size(), std::size_t{1} << 2 * (finest - country.level));
    for (const AtlasChangedArea& area : areas) {
        EXPECT_EQ(area.cell.level, finest) << toString(area.cell);
        EXPECT_TRUE(isAtOrUnder(area.cell, country));
        EXPECT_EQ(area.sum(), 1u);
        EXPECT_DOUBLE_EQ(area.leastRatio, 0.5);
    }
    EXPECT_TRUE(changedAreas({}, belowAll).empty());
}

TEST(Atlas, ACoarseLeafThatChangedIsListedBesideFinerAreas) {
    const ChunkId leaf{Face::NegY, 2, 1, 1};
    const ChunkId fine{Face::PosX, 7, 5, 6};
    const auto areas = changedAreas({{leaf, AtlasChange::Heights, 1, 1},
                                     {ancestorOf(fine, 0), AtlasChange::Error, 1, 2},
                                     {ancestorOf(fine, 4), AtlasChange::Error, 1, 2},
                                     {ancestorOf(fine, 6), AtlasChange::Error, 1, 4},
                                     {fine, AtlasChange::Heights, 1, 1}},
                                    5);
    ASSERT_EQ(areas.size(), 2u);
    EXPECT_EQ(areas[0].cell, ancestorOf(fine, 5));
    EXPECT_EQ(areas[0].sum(), 2u);
    EXPECT_DOUBLE_EQ(areas[0].mostRatio, 4);
    EXPECT_EQ(areas[1].cell, leaf);
    EXPECT_EQ(areas[1].sum(), 1u);
}

TEST(Atlas, ARegionWithALimitedLevelIsFoundAndPlaced) {
    AtlasSettings limited = smallSettings();
    const Geographic middle = geographicFromDirection(middleOf(country));
    Region region;
    region.name = "limited";
    region.circles.push_back({{glm::degrees(middle.latitudeRad), glm::degrees(middle.longitudeRad)},
                              fakePyramid().shape.radiusM * 0.8});
    region.mostLevel = 1;
    limited.regions = {region};
    const auto diffs = compareViewpoints(before(), revisit(fakePyramid(), limited)).value();
    const AtlasMeasureDiff& eps = of(diffs, AtlasMeasure::EpsPx);
    ASSERT_GT(eps.grew, 0u);
    EXPECT_GT(eps.moves.front().by(), 0.2);
    EXPECT_LT(degreesFrom(country, eps.moves.front()), 60);
    EXPECT_TRUE(
        isExceeded(*atlasLimitFromText("eps_px=+0.2"), eps.moves.front().before, eps.moves.front().now));
}

TEST(Atlas, ChangedHeightsAddedAndRemovedChunksAreTold) {
    FakePyramid changed = fakePyramid();
    const ChunkId leaf{Face::NegY, static_cast<std::uint8_t>(deepestLevelOf(changed.shape)), 3, 1};
    std::vector<std::int32_t> steps(changed.chunks.at(leaf).heights.begin(),
                                    changed.chunks.at(leaf).heights.end());
    ++steps[5];
    changed.chunks.at(leaf).heights = std::vector<std::int16_t>(steps.begin(), steps.end());
    const auto heights = changesBetween(treeOf(fakePyramid()), treeOf(changed));
    ASSERT_EQ(heights.size(), 1u);
    EXPECT_EQ(heights[0].chunk, leaf);
    EXPECT_EQ(heights[0].change, AtlasChange::Heights);

    FakePyramid pruned = fakePyramid();
    ChunkData& parent = pruned.chunks.at(parentOf(leaf));
    parent.children = {};
    parent.deltaCM = parent.deltaTightM = 0;
    const auto removed = changesBetween(treeOf(fakePyramid()), treeOf(pruned));
    ASSERT_EQ(removed.size(), 5u);
    EXPECT_EQ(removed[0].chunk, parentOf(leaf));
    for (std::size_t i = 1; i < 5; ++i) {
        EXPECT_EQ(removed[i].change, AtlasChange::Removed);
        EXPECT_EQ(parentOf(removed[i].chunk), parentOf(leaf));
    }
    EXPECT_EQ(changesBetween(treeOf(pruned), treeOf(fakePyramid()))[1].change, AtlasChange::Added);
}

TEST(AtlasLimit, IsReadAndApplied) {
    const AtlasLimit up = *atlasLimitFromText("eps_px=+0.2");
    EXPECT_TRUE(isExceeded(up, 1, 1.25));
    EXPECT_FALSE(isExceeded(up, 1, 1.15));
    EXPECT_FALSE(isExceeded(up, 1, 0));
    const AtlasLimit down = *atlasLimitFromText("triangles=-10%");
    EXPECT_TRUE(isExceeded(down, 100, 89));
    EXPECT_FALSE(isExceeded(down, 100, 91));
    EXPECT_FALSE(isExceeded(down, 100, 200));
    EXPECT_EQ(atlasLimitFromText("error_px=+1")->measure, AtlasMeasure::MeasuredPx);
    EXPECT_FALSE(atlasLimitFromText("chunks=+0")->measure);
    EXPECT_FALSE(isExceeded(up, 1, NAN));
    EXPECT_FALSE(isExceeded(*atlasLimitFromText("eps_px=+0"), 1, 1));
    for (const char* text : {"", "eps_px", "eps_px=", "eps_px=1", "eps_px=+", "eps_px=+1x", "eps_px=+-1",
                             "eps_px=+nan", "eps_px=+inf", "foo=+1", "=+1", "chunks=-1", "chunks=+1%"})
        EXPECT_FALSE(atlasLimitFromText(text)) << text;
    for (const char* text : {"eps_px=+0.2", "triangles=-10%", "chunks=+3"})
        EXPECT_EQ(textOf(*atlasLimitFromText(text)), text);
}

class AtlasFile : public testing::Test {
protected:
    AtlasFile() {
        AtlasWriter writer =
            AtlasWriter::create(folder_ / "a.atlas", smallSurvey(), treeOf(fakePyramid())).value();
        EXPECT_TRUE(writer.append(std::span(before()).first(20)));
        EXPECT_TRUE(writer.append(std::span(before()).subspan(20, 7)));
        EXPECT_TRUE(writer.finish());
        const std::string text = contentOf(folder_ / "a.atlas");
        bytes_.resize(text.size());
        std::memcpy(bytes_.data(), text.data(), text.size());
    }
    std::string problemOf(std::span<const std::byte> bytes) const {
        const auto atlas = atlasFromBytes(bytes, "a.atlas");
        return atlas ? std::string() : atlas.error().message;
    }
    const TemporaryFolder folder_;
    std::vector<std::byte> bytes_;
};

TEST_F(AtlasFile, ACutFileIsAnUnfinishedAtlasOrRefused) {
    for (std::size_t size = 0; size < bytes_.size(); size += size < 200 ? 1 : 37) {
        const auto atlas = atlasFromBytes(std::span(bytes_).first(size), "a.atlas");
        if (atlas) {
            EXPECT_FALSE(atlas->isFinished);
            EXPECT_THAT(atlas->viewpoints.size(), testing::AnyOf(0, 20, 27));
        } else {
            EXPECT_THAT(atlas.error().message, testing::StartsWith("a.atlas: "));
        }
    }
}

TEST_F(AtlasFile, ChangedBytesAreNoticed) {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> changed = bytes_;
        const std::size_t at = random() % changed.size();
        changed[at] ^= static_cast<std::byte>(1 + random() % 255);
        const auto atlas = atlasFromBytes(changed, "a.atlas");
        EXPECT_TRUE(!atlas || !atlas->isFinished) << at;
    }
}

TEST_F(AtlasFile, OtherFilesAreRefusedWithWhatIsWrong) {
    EXPECT_THAT(problemOf({}), HasSubstr("is not an atlas"));
    std::vector<std::byte> other = bytes_;
    other[8] = std::byte{9};
    EXPECT_THAT(problemOf(other), HasSubstr("version 9 of atlases is unknown; expected 1"));
    std::vector<std::byte> longer = bytes_;
    longer.resize(longer.size() + 3);
    EXPECT_THAT(problemOf(longer), HasSubstr("3 bytes after its end"));
    EXPECT_THAT(loadAtlas(folder_ / "none.atlas").error().message, HasSubstr("none.atlas"));
    EXPECT_FALSE(loadAtlas(folder_.path()));
}

// Values that no checksum stops are checked one by one.
TEST_F(AtlasFile, BadValuesAreRefused) {
    const auto problemWith = [&](const std::function<void(AtlasSurvey&, AtlasViewpoint&)>& change) {
        AtlasSurvey survey = smallSurvey();
        AtlasViewpoint viewpoint = before().front();
        change(survey, viewpoint);
        AtlasWriter writer = AtlasWriter::create(folder_ / "b.atlas", survey, {}).value();
        EXPECT_TRUE(writer.append({&viewpoint, 1}));
        EXPECT_TRUE(writer.finish());
        const auto atlas = loadAtlas(folder_ / "b.atlas");
        return atlas ? std::string() : atlas.error().message;
    };
    EXPECT_EQ(problemWith([](AtlasSurvey&, AtlasViewpoint&) {}), "");
    const double nan = NAN;
    EXPECT_THAT(problemWith([&](AtlasSurvey& s, AtlasViewpoint&) { s.radiusM = nan; }), HasSubstr("radius"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.widthPx = 1; }),
                HasSubstr("picture size"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.fovDeg = 180; }),
                HasSubstr("field of view"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.grid.altitudesM = {}; }),
                HasSubstr("altitudes"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) {
                    s.grid.altitudesM = {5, 5};
                }),
                HasSubstr("altitudes"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.grid.altitudesM.assign(17, 1); }),
                HasSubstr("17 altitudes"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.grid.headings = 0; }),
                HasSubstr("headings"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.grid.pitchDeg = 1; }),
                HasSubstr("pitch"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.grid.finestLevel = 30; }),
                HasSubstr("levels"));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint&) { s.grid.most = 1u << 30; }),
                HasSubstr("viewpoints"));
    const char* const damaged = "viewpoint 0 is damaged";
    EXPECT_THAT(
        problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.place.cell.face = static_cast<Face>(6); }),
        HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.place.cell.level = 20; }),
                HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.place.cell.x = 1000; }),
                HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.place.altitude = 2; }),
                HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.place.heading = 2; }),
                HasSubstr(damaged));
    EXPECT_THAT(problemWith([&](AtlasSurvey&, AtlasViewpoint& v) { v.eyeM = nan; }), HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.figures[1] = -1; }), HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.figures[3] = INFINITY; }),
                HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey&, AtlasViewpoint& v) { v.figures[1] = -INFINITY; }),
                HasSubstr(damaged));
    EXPECT_THAT(problemWith([](AtlasSurvey& s, AtlasViewpoint& v) { v.eyeM = -s.radiusM; }),
                HasSubstr(damaged));
}

TEST_F(AtlasFile, TheHugeErrorsOfEarlierSurveysAreReadAsNoBound) {
    std::vector<AtlasViewpoint> old(before().begin(), before().begin() + 3);
    const auto eps = static_cast<std::size_t>(AtlasMeasure::EpsPx);
    old[0].figures[eps] = 1.9e9;
    old[1].figures[eps] = INFINITY;
    AtlasWriter writer = AtlasWriter::create(folder_ / "old.atlas", smallSurvey(), {}).value();
    ASSERT_TRUE(writer.append(old));
    ASSERT_TRUE(writer.finish());
    const Atlas atlas = loadAtlas(folder_ / "old.atlas").value();
    EXPECT_EQ(atlas.viewpoints[0].figures[eps], INFINITY);
    EXPECT_EQ(atlas.viewpoints[1].figures[eps], INFINITY);
    EXPECT_EQ(atlas.viewpoints[2].figures[eps], old[2].figures[eps]);
}

TEST_F(AtlasFile, NamesTellAtlasesAndUnfinishedOnes) {
    EXPECT_TRUE(isNamedAtlas("a.atlas"));
    EXPECT_TRUE(isNamedAtlas("x/a.atlas.part"));
    EXPECT_FALSE(isNamedAtlas("a.part"));
    EXPECT_FALSE(isNamedAtlas("a.chk"));
    EXPECT_EQ(finishedAtlas(unfinishedAtlas("x/a.atlas")), "x/a.atlas");
    EXPECT_EQ(finishedAtlas("a.atlas"), "a.atlas");
}

TEST_F(AtlasFile, HasOneWriterAtATime) {
    const AtlasWriter first = AtlasWriter::create(folder_ / "c.atlas", smallSurvey(), {}).value();
    EXPECT_THAT(AtlasWriter::create(folder_ / "c.atlas", smallSurvey(), {}).error().message,
                HasSubstr("is being written by another survey"));
    EXPECT_THAT(AtlasWriter::resume(folder_ / "c.atlas").error().message,
                HasSubstr("is being written by another survey"));
}

}  // namespace
}  // namespace planet
