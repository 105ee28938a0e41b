// The precision probe against the vertex shader itself, and its depth step against a depth buffer.
#include "planet/measure/precision_probe.h"

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

class PrecisionProbeOnGpu : public GlTest {};

TEST_F(PrecisionProbeOnGpu, ItsFloatsAreTheShaders) {
    PlanetShape shape;
    shape.faceCellsLog2 = 16;
    const HeightFunction height = [](const glm::dvec3& d) {
        return 2000 * std::sin(900 * d.x) * std::cos(700 * d.y);
    };
    TestPlanet planet(shape, 4);
    const ChunkId id = chunkAt(facePointFromDirection({0.6, 0.5, 0.4}), 8);
    planet.add(id, height);
    DrawItem& item = planet.items().front();
    const std::vector<std::int16_t> heights = chunkSteps(shape, id, height);
    const Geographic place = geographicFromDirection({0.6, 0.5, 0.4});
    const View view =
        viewFrom(shape, glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad), 4000);
    const VertexFrame frame = vertexFrame(shape, view.eyeM);
    const RenderTarget target = valueOf(RenderTarget::create(view.widthPx, view.heightPx, 1));
    target.bind();
    // A GPU may fuse a multiplication and an addition, which leaves out a rounding that the probe makes. Each of the two
    // that come last, of a coordinate and of the sum, is half a unit in the last place: 2^-24 of the distance.
    const double apart = planet.renderer().capabilities().software ? 2e-7 : 2e-7 + 2 * std::ldexp(1.0, -24);
    for (const bool stitched : {false, true}) {
        for (const float morph : {0.0f, 0.35f, 1.0f}) {
            item.morph = morph;
            item.edgeMorph = {morph, 0.5f * morph, 1, morph};
            item.coarserBy = {0, 1, 0, 2};
            RenderSettings settings;
            settings.stitched = stitched;
            const auto positions = valueOf(planet.renderer().readVertexPositions(view, {&item, 1}, settings));
            for (int i = 0; i < chunkVertexCount(shape); ++i) {
                const VertexPrecision probe = vertexPrecision(shape, frame, item, heights, stitched, view,
                                                              {i % chunkSize(shape), i / chunkSize(shape)});
                const glm::dvec3 drawn(positions[static_cast<std::size_t>(i)]);
                const double apartM = glm::length(drawn - (probe.shader.positionM - view.eyeM));
                ASSERT_LT(apartM, apart * probe.distanceM) << i;
                // And so is the error that it tells.
                const double errorM = glm::length(drawn + view.eyeM - probe.positionM);
                ASSERT_NEAR(probe.shader.errorM, errorM, apart * probe.distanceM) << i;
            }
        }
    }
}

// The ground seen straight from above lies where the depth buffer says, to a few of its steps.
TEST_F(PrecisionProbeOnGpu, TheDepthBufferKeepsDistancesToAFewSteps) {
    PlanetShape shape;
    TestPlanet planet(shape, 6);
    planet.addLevel(0, flat);
    for (const double altitudeM : {1e4, 3e5, 2e7}) {
        const View view = viewFrom(shape, 0, 0, altitudeM, -90, 0, 321, 241);
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
        const Projection& projection = planet.renderer().projection();
        const double distanceM = viewDistanceM(projection, static_cast<double>(picture.depthAt(160, 120)));
        // The middle of the face is a vertex of its root chunk.
        EXPECT_NEAR(distanceM, altitudeM, 8 * depthStepM(projection, altitudeM));
    }
}

}  // namespace
}  // namespace planet::gl
