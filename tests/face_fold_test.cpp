#include "planet/face_fold.h"

#include <gtest/gtest.h>

namespace planet {
namespace {

constexpr int cells = 8;

glm::dvec3 pointOf(const FaceGridPoint& point) {
    return cubePoint(point.face, 2.0 * point.column / cells - 1, 2.0 * point.row / cells - 1);
}

TEST(FaceFold, APointOverAnEdgeLiesOnTheNextFaceAsFarDownFromTheEdge) {
    for (const Face face : allFaces) {
        const FaceAxes& axes = faceAxes(face);
        for (int over = 1; over <= cells; ++over) {
            const double down = 1 - 2.0 * over / cells;
            for (int along = 0; along <= cells; ++along) {
                const double at = 2.0 * along / cells - 1;
                EXPECT_EQ(pointOf(foldedOver({face, cells + over, along}, cells)),
                          axes.u + at * axes.v + down * axes.normal);
                EXPECT_EQ(pointOf(foldedOver({face, -over, along}, cells)),
                          -axes.u + at * axes.v + down * axes.normal);
                EXPECT_EQ(pointOf(foldedOver({face, along, cells + over}, cells)),
                          axes.v + at * axes.u + down * axes.normal);
                EXPECT_EQ(pointOf(foldedOver({face, along, -over}, cells)),
                          -axes.v + at * axes.u + down * axes.normal);
            }
        }
    }
}

}  // namespace
}  // namespace planet
