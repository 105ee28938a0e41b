// Cracks at rims of a sparse planet, where a coarse leaf lies beside chunks up to four levels deeper.
#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "planet/select/skirt_depth.h"
#include "tests/planet/gl/mixed_levels.h"
#include "tests/support/sparse_planet.h"
#include "tests/support/sudden_lod.h"

namespace planet::gl {
namespace {

// Tests that seams between a leaf and deeper chunks show no cracks.
struct Rim {
    glm::dvec3 placeM{0, 0, 0};
    int levels = 0;
    bool acrossFaces = false;
    bool atCorner = false;  // of the cube
};

class SparseCracks : public GlTest {
protected:
    SparseCracks() {
        target_.bind();
        LodSettings settings = suddenLod(1e-9);
        settings.frustumCulling = settings.horizonCulling = false;
        const View view = viewFromPose({}, planet_.tree().shape.radiusM, 1, 100, 100);
        const std::vector<DrawItem> items = planet_.select(view, settings);
        for (const EdgeGap& gap : edgeGaps(planet_.ground(items, false), view)) {
            const ChunkId& coarser = gap.coarser;
            if (gap.finer.level == coarser.level || gap.gapM < 5) continue;
            const glm::dvec3 cube = glm::abs(cubeFromSphere(glm::normalize(gap.placeM)));
            const double least = std::min({cube.x, cube.y, cube.z});
            rims_.push_back({gap.placeM, gap.finer.level - coarser.level, gap.finer.face != coarser.face,
                             least > 1 - 0.02});
        }
    }

    // From any side of a rim, above the ground.
    View viewOf(const Rim& rim, double awayM) {
        const auto within = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random_);
        };
        for (;;) {
            const glm::dvec3 up = glm::normalize(rim.placeM);
            const glm::dvec3 aside(within(-1, 1), within(-1, 1), within(-1, 1));
            View view;
            view.back = glm::normalize(glm::normalize(glm::cross(up, aside)) + within(0.15, 1.2) * up);
            view.right = glm::normalize(glm::cross(up, view.back));
            view.up = glm::cross(view.back, view.right);
            view.eyeM = rim.placeM + awayM * view.back;
            view.widthPx = 240;
            view.heightPx = 160;
            const double groundM = planet_.tree().shape.radiusM + residentHeightM(planet_.tree(), view.eyeM);
            if (glm::length(view.eyeM) > groundM + 100) return view;
        }
    }

    // Calls visit with views of rims of all kinds.
    template <class Visit>
    void forEachView(const Visit& visit) {
        std::set<std::tuple<int, bool, bool>> kinds;
        for (std::size_t i = 0; i < rims_.size(); ++i) {
            const Rim& rim = rims_[i];
            const bool isNew = kinds.insert({rim.levels, rim.acrossFaces, rim.atCorner}).second;
            if (!isNew && i % 97 != 0) continue;
            for (const double awayM : {400.0, 3000.0, 20000.0}) visit(rim, viewOf(rim, awayM));
        }
        for (const int levels : {1, 2, 3, 4}) {
            for (const bool acrossFaces : {false, true})
                EXPECT_TRUE(kinds.contains({levels, acrossFaces, false}) ||
                            kinds.contains({levels, acrossFaces, true}))
                    << levels << acrossFaces;
        }
        EXPECT_TRUE(kinds.contains({4, true, true}));
    }

    RenderTarget target_ = valueOf(RenderTarget::create(8, 8));
    MixedLevels planet_{test::sparsePlanet().wholeTree()};
    std::vector<Rim> rims_;
    std::mt19937 random_{7};
};

TEST_F(SparseCracks, AutomaticSkirtsLeakNothing) {
    std::size_t cracks = 0;
    int leakingWithoutRims = 0;
    int views = 0;
    forEachView([&](const Rim& rim, const View& view) {
        LodSettings settings = suddenLod(views % 3 == 0 ? 0.05 : 1.5);
        settings.morph = views % 2 == 0;
        settings.metric = views % 4 < 2 ? ErrorMetric::Additive : ErrorMetric::Tight;
        std::vector<DrawItem> items = planet_.select(view, settings);
        const CrackMap map = planet_.measure(view, items, false);
        EXPECT_EQ(map.leaking, 0) << views << ": " << rim.levels << rim.acrossFaces << rim.atCorner;
        cracks += map.pixels.size();
        // The sum of both errors alone is too little: a coarse leaf has none.
        std::vector<float> apartM(items.size(), 0);
        for (const DrawnPair& pair : drawnPairs(items)) {
            const float bothM = items[pair.finer].deltaCM + items[pair.coarser].deltaCM;
            apartM[pair.finer] = std::max(apartM[pair.finer], bothM);
            apartM[pair.coarser] = std::max(apartM[pair.coarser], bothM);
        }
        for (std::size_t i = 0; i < items.size(); ++i)
            items[i].skirtDepthM = automaticSkirtDepthM(planet_.tree(), items[i], apartM[i], 1);
        leakingWithoutRims += planet_.measure(view, items, false).leaking;
        ++views;
    });
    EXPECT_GT(views, 30);
    EXPECT_GT(cracks, 1000u) << "what the skirts hide";
    EXPECT_GT(leakingWithoutRims, 100);
}

TEST_F(SparseCracks, StitchedEdgesHaveNone) {
    int views = 0;
    std::uint32_t widest = 0;
    forEachView([&](const Rim& rim, const View& view) {
        LodSettings settings = suddenLod(views % 3 == 0 ? 0.05 : 1.5);
        settings.seams = SeamMode::Stitched;
        settings.morph = views % 2 == 0;
        Selection selection;
        selectChunks(planet_.tree(), view, settings, selection);
        EXPECT_EQ(planet_.measure(view, selection.draw, true).pixels.size(), 0u)
            << views << ": " << rim.levels << rim.acrossFaces << rim.atCorner;
        widest = std::max(widest, selection.counters.widestSeam);
        ++views;
    });
    EXPECT_EQ(widest, 3u) << "the most that chunks of 16 cells allow";
}

TEST_F(SparseCracks, NoGapIsWiderThanItsBound) {
    int pairs = 0;
    double most = 0;
    forEachView([&](const Rim&, const View& view) {
        for (const bool morph : {false, true}) {
            for (const ErrorMetric metric : {ErrorMetric::Additive, ErrorMetric::Tight}) {
                LodSettings settings = suddenLod(1.5);
                settings.morph = morph;
                settings.morphRange = 2;
                settings.metric = metric;
                const std::vector<DrawItem> items = planet_.select(view, settings);
                for (const EdgeGap& gap : edgeGaps(planet_.ground(items, false), view)) {
                    const DrawItem& finer = items[gap.pair.finer];
                    const DrawItem& coarser = items[gap.pair.coarser];
                    const auto boundM = static_cast<double>(mostApartM(
                        planet_.tree(), metric, finer, gap.pair.finerEdge, coarser, gap.pair.coarserEdge));
                    ASSERT_LE(gap.gapM, boundM * (1 + 1e-5) + 1e-6)
                        << toString(finer.id) << " beside " << toString(coarser.id);
                    if (gap.gapM > 1) most = std::max(most, gap.gapM / boundM);
                    ++pairs;
                }
            }
        }
    });
    EXPECT_GT(pairs, 3000);
    EXPECT_GT(most, 0.3) << "a bound, not a wild guess";
}

}  // namespace
}  // namespace planet::gl
