// The positions that the vertex shader really makes, against doubles.
#include <cstring>
#include <random>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

PlanetShape earthToTheCentimetre() {
    PlanetShape shape;
    shape.faceCellsLog2 = maxFaceCellsLog2;
    return shape;
}

class VertexShader : public GlTest {
protected:
    VertexShader() { target_.bind(); }

    // A chunk of random heights that holds a point of a face.
    DrawItem uploadChunk(std::uint32_t slot, const FacePoint& point, int level) {
        std::uniform_int_distribution<std::int32_t> step(-mostStep_, mostStep_);
        heights_.resize(static_cast<std::size_t>(chunkVertexCount(shape_)));
        for (std::int32_t& height : heights_) height = step(random_);
        renderer_.upload(slot, heights_);
        DrawItem item;
        item.id = chunkAt(point, level);
        item.slot = slot;
        return item;
    }

    glm::dvec3 reference(const ChunkId& id, int vertex, std::int32_t step) const {
        const int size = chunkSize(shape_);
        const FaceSquare square = faceSquareOf(id);
        const double u = square.u + square.side * (vertex % size) / (size - 1);
        const double v = square.v + square.side * (vertex / size) / (size - 1);
        return positionM(shape_, sphereFromCube(cubePoint(id.face, u, v)), heightM(shape_, step));
    }

    int vertexNearest(const ChunkId& id, const FacePoint& point) const {
        const FaceSquare square = faceSquareOf(id);
        const int cells = chunkCells(shape_);
        const auto along = [&](double at, double from) {
            return static_cast<int>(std::lround((at - from) / square.side * cells));
        };
        return along(point.v, square.v) * (cells + 1) + along(point.u, square.u);
    }

    glm::dvec3 randomOffset(double lengthM) {
        std::normal_distribution<double> normal;
        return lengthM * glm::normalize(glm::dvec3(normal(random_), normal(random_), normal(random_)));
    }

    // Every vertex of one chunk, seen from within a kilometre of one of them.
    void expectExact(const FacePoint& point, int level) {
        const DrawItem item = uploadChunk(0, point, level);
        const auto nearest = static_cast<std::size_t>(vertexNearest(item.id, point));
        View view;
        view.eyeM = reference(item.id, static_cast<int>(nearest), heights_[nearest]) + randomOffset(950);
        const auto positions = valueOf(renderer_.readVertexPositions(view, {&item, 1}, RenderSettings{}));
        ASSERT_EQ(positions.size(), heights_.size());
        int within2Km = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const glm::dvec3 expected = reference(item.id, static_cast<int>(i), heights_[i]) - view.eyeM;
            const double error = glm::length(glm::dvec3(positions[i]) - expected);
            const double away = glm::length(expected);
            worst_ = std::max(worst_, error / away);
            if (away < 2000) {
                worstNearM_ = std::max(worstNearM_, error);
                ++within2Km;
            }
        }
        EXPECT_GT(within2Km, 0);
    }

    RenderTarget target_ = valueOf(RenderTarget::create(8, 8));
    PlanetShape shape_ = earthToTheCentimetre();
    ChunkRenderer renderer_ = valueOf(ChunkRenderer::create({shape_, 4, {}}));
    std::vector<std::int32_t> heights_;
    std::int32_t mostStep_ = 8000;
    std::mt19937 random_{11};
    double worst_ = 0;
    double worstNearM_ = 0;
};

TEST_F(VertexShader, IsWithinAMillimetreOfDoublesAtEveryLevel) {
    for (int level = 0; level <= deepestLevelOf(shape_); ++level) {
        for (const Face face : allFaces) {
            // The middle (of two faces a pole), an edge, a corner, close to an edge, and somewhere.
            for (const auto& [u, v] :
                 {std::pair{0.0, 0.0}, {1.0, 0.3}, {-1.0, -1.0}, {0.99999, -0.6}, {0.37, 0.71}})
                expectExact({face, u, v}, level);
        }
        EXPECT_LT(worstNearM_, 1e-3) << "level " << level;
        EXPECT_LT(worst_, 4e-7) << "level " << level;
    }
    RecordProperty("worstNearM", fmt::format("{}", worstNearM_));
    RecordProperty("worstOverDistance", fmt::format("{}", worst_));
}

TEST_F(VertexShader, IsAsExactFromOrbitAndOnAPlanetOfOneLevel) {
    shape_.faceCellsLog2 = shape_.chunkCellsLog2;
    for (const double altitudeM : {10.0, 1e4, 1e6, 1e8}) {
        const View view = viewFrom(shape_, 41, 13, altitudeM);
        for (const Face face : allFaces) {
            const DrawItem item = uploadChunk(0, {face, 0, 0}, 0);
            const auto positions = valueOf(renderer_.readVertexPositions(view, {&item, 1}, RenderSettings{}));
            for (std::size_t i = 0; i < positions.size(); ++i) {
                const glm::dvec3 expected = reference(item.id, static_cast<int>(i), heights_[i]) - view.eyeM;
                ASSERT_LT(glm::length(glm::dvec3(positions[i]) - expected), 4e-7 * glm::length(expected));
            }
        }
    }
}

TEST_F(VertexShader, DrawsFractionsOfTheQuantumAsExactly) {
    shape_.fractionBits = 7;
    shape_.quantumM = 1.0 / 128;
    renderer_ = valueOf(ChunkRenderer::create({shape_, 4, {}}));
    mostStep_ = 1'000'000;  // beyond 16 bits
    for (const int level : {0, 5, 11, 17, deepestLevelOf(shape_)}) {
        for (const Face face : allFaces) expectExact({face, 0.37, 0.71}, level);
        EXPECT_LT(worstNearM_, 1e-3) << "level " << level;
        EXPECT_LT(worst_, 4e-7) << "level " << level;
        const DrawItem item = uploadChunk(0, {Face::NegY, 0.2, -0.7}, level);
        const View view = viewFrom(shape_, -30, -80, 4000);
        const auto positions = valueOf(renderer_.readVertexPositions(view, {&item, 1}, RenderSettings{}));
        const VertexFrame frame = vertexFrame(shape_, view.eyeM);
        const int size = chunkSize(shape_);
        const std::int32_t spacing = fineCellsPerVertex(shape_, level);
        for (int i = 0; i < size * size; ++i) {
            const auto gridU = static_cast<std::int32_t>(item.id.x) * (size - 1) + i % size;
            const auto gridV = static_cast<std::int32_t>(item.id.y) * (size - 1) + i / size;
            const auto index = static_cast<std::size_t>(i);
            const glm::vec3 mirrored =
                vertexFromEyeM(frame, item.id.face, gridU * spacing, gridV * spacing, heights_[index]);
            EXPECT_LT(glm::length(positions[index] - mirrored), 4e-7f * glm::length(mirrored));
        }
    }
}

TEST_F(VertexShader, AgreesWithItsMirrorOnTheCpu) {
    const int level = 9;
    const DrawItem item = uploadChunk(0, {Face::NegY, 0.2, -0.7}, level);
    const View view = viewFrom(shape_, -30, -80, 4000);
    const auto positions = valueOf(renderer_.readVertexPositions(view, {&item, 1}, RenderSettings{}));
    const VertexFrame frame = vertexFrame(shape_, view.eyeM);
    const int size = chunkSize(shape_);
    const std::int32_t spacing = fineCellsPerVertex(shape_, level);
    for (int i = 0; i < size * size; ++i) {
        const auto gridU = static_cast<std::int32_t>(item.id.x) * (size - 1) + i % size;
        const auto gridV = static_cast<std::int32_t>(item.id.y) * (size - 1) + i / size;
        const auto index = static_cast<std::size_t>(i);
        const glm::vec3 mirrored =
            vertexFromEyeM(frame, item.id.face, gridU * spacing, gridV * spacing, heights_[index]);
        EXPECT_LT(glm::length(positions[index] - mirrored), 4e-7f * glm::length(mirrored));
    }
}

TEST_F(VertexShader, VerticesThatLevelsShareAreTheSameToTheLastBit) {
    const FacePoint place{Face::PosZ, 0.123, -0.456};
    const std::vector<std::int16_t> flatHeights(static_cast<std::size_t>(chunkVertexCount(shape_)), 1234);
    for (int level = 2; level < deepestLevelOf(shape_); level += 3) {
        std::array<DrawItem, 2> items;
        items[0].id = chunkAt(place, level);
        items[1].id = childOf(items[0].id, 0);
        for (std::uint32_t slot = 0; slot < 2; ++slot) {
            items[slot].slot = slot;
            renderer_.upload(slot, flatHeights);
        }
        const glm::dvec3 ground = reference(items[0].id, 0, 1234);
        View view;
        view.eyeM = ground + randomOffset(3000);
        const auto positions = valueOf(renderer_.readVertexPositions(view, items, RenderSettings{}));
        const int size = chunkSize(shape_);
        for (int row = 0; row <= size / 2; ++row) {
            for (int column = 0; column <= size / 2; ++column) {
                const glm::vec3& parent = positions[static_cast<std::size_t>(row * size + column)];
                const glm::vec3& child =
                    positions[static_cast<std::size_t>(size * size + 2 * (row * size + column))];
                ASSERT_EQ(std::memcmp(&parent, &child, sizeof parent), 0)
                    << level << " " << row << " " << column;
            }
        }
    }
}

TEST_F(VertexShader, TheCubeIsDrawnInsideTheSphere) {
    RenderSettings settings;
    settings.cube = true;
    const View view = viewFrom(shape_, 20, 30, 3e6);
    for (const Face face : allFaces) {
        const DrawItem item = uploadChunk(1, {face, 0.4, -0.4}, 2);
        const auto positions = valueOf(renderer_.readVertexPositions(view, {&item, 1}, settings));
        const FaceSquare square = faceSquareOf(item.id);
        const int size = chunkSize(shape_);
        for (int i = 0; i < size * size; ++i) {
            const glm::dvec3 cube = cubePoint(face, square.u + square.side * (i % size) / (size - 1),
                                              square.v + square.side * (i / size) / (size - 1));
            const auto index = static_cast<std::size_t>(i);
            const glm::dvec3 expected = cube * (shape_.radiusM / std::sqrt(3.0)) +
                                        static_cast<double>(heights_[index]) * glm::normalize(cube) -
                                        view.eyeM;
            EXPECT_LT(glm::length(glm::dvec3(positions[index]) - expected), 3.0);
        }
    }
}

}  // namespace
}  // namespace planet::gl
