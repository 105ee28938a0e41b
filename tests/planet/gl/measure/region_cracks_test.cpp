// The crack meter over the borders of regions.
#include "planet/gl/measure/crack_meter.h"

#include <set>
#include <utility>

#include "tests/planet/gl/mixed_levels.h"
#include "tests/support/random_regions.h"
#include "tests/support/sudden_lod.h"

namespace planet::gl {
namespace {

// Everything is resident, so levels differ only because of the errors and the regions.
MixedLevels regionPlanet(std::mt19937& random) {
    ChunkTree tree = residentTree(fakePyramid(), 4);
    setRegions(tree,
               RegionSet::make(randomRegions(random, tree.shape.radiusM, 12), tree.storedShape).value());
    return MixedLevels(std::move(tree));
}

// The drawn pairs across a border, as differences of levels.
std::multiset<int> borderPairs(const std::vector<DrawItem>& items) {
    std::multiset<int> pairs;
    for (const DrawnPair& pair : drawnPairs(items)) {
        const DrawItem& finer = items[pair.finer];
        const DrawItem& coarser = items[pair.coarser];
        if (finer.tauFactor != coarser.tauFactor || finer.limit != coarser.limit)
            pairs.insert(finer.id.level - coarser.id.level);
    }
    return pairs;
}

class RegionCracks : public GlTest {
protected:
    RegionCracks() { target_.bind(); }
    RenderTarget target_ = valueOf(RenderTarget::create(8, 8));  // a context alone has nothing to draw into
    std::mt19937 random_{81};
};

TEST_F(RegionCracks, StitchedBordersHaveNone) {
    std::multiset<int> met;
    for (int planets = 0; planets < 4; ++planets) {
        MixedLevels planet = regionPlanet(random_);
        for (int i = 0; i < 16; ++i) {
            const View view = planet.viewFromAbove(random_, 160, 100);
            LodSettings settings = suddenLod(i % 3 == 0 ? 1 : 4);
            settings.seams = SeamMode::Stitched;
            settings.morph = i % 2 == 0;
            const std::vector<DrawItem> items = planet.select(view, settings);
            EXPECT_EQ(planet.measure(view, items, true).pixels.size(), 0u) << planets << " " << i;
            met.merge(borderPairs(items));
        }
    }
    for (const int levels : {0, 1, 2, 3}) EXPECT_GT(met.count(levels), 4u) << levels;
}

TEST_F(RegionCracks, AutomaticSkirtsLeakNothingAndWithoutThemBordersDo) {
    std::size_t cracks = 0;
    std::size_t leaks = 0;
    for (int planets = 0; planets < 4; ++planets) {
        MixedLevels planet = regionPlanet(random_);
        for (int i = 0; i < 80; ++i) {
            const View view = planet.viewFromAbove(random_, 200, 125);
            LodSettings settings = suddenLod(i % 3 == 0 ? 1 : 4);
            settings.seams = SeamMode::Skirts;
            settings.morph = i % 2 == 0;
            const CrackMap map = planet.measure(view, planet.select(view, settings), false);
            EXPECT_EQ(map.leaking, 0) << planets << " " << i;
            cracks += map.pixels.size();
            settings.seams = SeamMode::None;
            leaks +=
                static_cast<std::size_t>(planet.measure(view, planet.select(view, settings), false).leaking);
        }
    }
    EXPECT_GT(cracks, 40u) << "what the skirts hide";
    EXPECT_EQ(leaks, cracks);
}

}  // namespace
}  // namespace planet::gl
