#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "planet/chunk_explanation.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

TEST(PlanetExplain, FollowsAChunkFromTheQueueToTheScreen) {
    PagingSettings paging;
    paging.paused = true;
    auto planet = Planet::open(fakePyramid().source(), paging).value();
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    LodSettings lod = suddenLod();
    lod.tauPx = 1e-3;
    lod.maxLevel = 1;
    lod.frustumCulling = lod.horizonCulling = false;
    planet->step(view, lod, noUpload);
    std::set<std::size_t> places;
    for (const Face face : allFaces) {
        const ChunkExplanation root = explainChunk(*planet, {face, 0, 0, 0});
        EXPECT_EQ(root.notSplit, WhyNotSplit::WaitingInQueue);
        EXPECT_EQ(root.queueLength, 6u);
        EXPECT_EQ(explainChunk(*planet, {face, 1, 1, 1}).state, ChunkState::Requested);
        EXPECT_EQ(explainChunk(*planet, {face, 1, 1, 1}).queuePlace, root.queuePlace);
        places.insert(root.queuePlace.value_or(0));
    }
    EXPECT_EQ(places, (std::set<std::size_t>{1, 2, 3, 4, 5, 6}));
    paging.paused = false;
    ASSERT_TRUE(planet->setPaging(paging));
    ASSERT_TRUE(planet->settle(view, lod, noUpload, 60));
    for (const Face face : allFaces) {
        EXPECT_EQ(explainChunk(*planet, {face, 0, 0, 0}).state, ChunkState::Split);
        EXPECT_EQ(explainChunk(*planet, {face, 1, 1, 1}).notSplit, WhyNotSplit::LevelLimit);
    }
}

TEST(PlanetExplain, EachViewHasItsOwnReasons) {
    auto planet = Planet::open(fakePyramid().source(), {}).value();
    std::vector<ViewInput> views(2);
    for (ViewInput& view : views) {
        view.lodView = viewFromPose({}, 1e5, 1, 1280, 720);
        view.lod.frustumCulling = view.lod.horizonCulling = false;
        view.lod.maxLevel = 0;
        view.lod.tauPx = 1e-3;
    }
    views[1].lod.tauPx = 1e9;
    planet->step(views, noUpload);
    EXPECT_EQ(explainChunk(*planet, {Face::PosX, 0, 0, 0}, 0).notSplit, WhyNotSplit::LevelLimit);
    EXPECT_EQ(explainChunk(*planet, {Face::PosX, 0, 0, 0}, 1).notSplit, WhyNotSplit::GoodEnough);
}

}  // namespace
}  // namespace planet
