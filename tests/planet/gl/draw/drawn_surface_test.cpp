// The CPU's reference of what is drawn against what the vertex shader draws.
#include "planet/select/drawn_surface.h"

#include <random>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"
#include "tests/support/seam_patchwork.h"

namespace planet::gl {
namespace {

class DrawnSurfaceOnGpu : public GlTest {
protected:
    DrawnSurfaceOnGpu() : planet_(smallChunks(), 24 * 64) {
        target_.bind();
        for (const ChunkId& id : seamPatchwork()) planet_.add(id, mountains);
        morphAtRandom(planet_.items(), random_);
    }

    // The farthest that a vertex of the two lies apart, in its distance to the eye.
    double worstDifference(const View& view, bool stitched) {
        RenderSettings settings = plainSettings();
        settings.stitched = stitched;
        const auto drawn = valueOf(planet_.renderer().readVertexPositions(view, planet_.items(), settings));
        double worst = 0;
        std::size_t at = 0;
        for (const DrawItem& item : planet_.items()) {
            const DrawnGrid grid =
                drawnGrid(planet_.shape(), item, chunkSteps(planet_.shape(), item.id, mountains), stitched);
            for (const glm::dvec3& position : grid.positionM) {
                const glm::dvec3 fromEye = position - view.eyeM;
                worst =
                    std::max(worst, glm::length(glm::dvec3(drawn[at++]) - fromEye) / glm::length(fromEye));
            }
        }
        EXPECT_EQ(at, drawn.size());
        return worst;
    }

    RenderTarget target_ = valueOf(RenderTarget::create(8, 8));
    TestPlanet planet_;
    std::mt19937 random_{17};
};

TEST_F(DrawnSurfaceOnGpu, VerticesAreTheShadersWhateverMorphsAndIsStitched) {
    for (const View& view : {viewFrom({}, 33, 44, 700000), viewFrom({}, -50, -100, 30000)}) {
        for (const bool stitched : {false, true}) {
            morphAtRandom(planet_.items(), random_);
            EXPECT_LT(worstDifference(view, stitched), 1e-6) << stitched;
        }
    }
}

}  // namespace
}  // namespace planet::gl
