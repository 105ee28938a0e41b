#include "planet/sphere/face_fold.h"

#include <gtest/gtest.h>

namespace planet {
namespace {

constexpr int foldCells = 8;

glm::dvec3 pointOf(const FaceGridPoint& point) {
    return cubePoint(point.face, 2.0 * point.column / foldCells - 1, 2.0 * point.row / foldCells - 1);
}

TEST(FaceFold, APointOverAnEdgeLiesOnTheNextFaceAsFarDownFromTheEdge) {
    for (const Face face : allFaces) {
        const FaceAxes& axes = faceAxes(face);
        for (int over = 1; over <= foldCells; ++over) {
            const double down = 1 - 2.0 * over / foldCells;
            for (int along = 0; along <= foldCells; ++along) {
                const double at = 2.0 * along / foldCells - 1;
                EXPECT_EQ(pointOf(foldedOver({face, foldCells + over, along}, foldCells)),
                          axes.u + at * axes.v + down * axes.normal);
                EXPECT_EQ(pointOf(foldedOver({face, -over, along}, foldCells)),
                          -axes.u + at * axes.v + down * axes.normal);
                EXPECT_EQ(pointOf(foldedOver({face, along, foldCells + over}, foldCells)),
                          axes.v + at * axes.u + down * axes.normal);
                EXPECT_EQ(pointOf(foldedOver({face, along, -over}, foldCells)),
                          -axes.v + at * axes.u + down * axes.normal);
            }
        }
    }
}

}  // namespace
}  // namespace planet
