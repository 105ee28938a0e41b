// The cube, the sphere, and the mapping between them.
//
// World axes are right-handed, in metres from the planet's centre: +z is the north pole, +x is latitude 0,
// longitude 0, and +y is latitude 0, longitude 90 east. A face is a square seen upright from outside the
// cube: u points to its right, v up, both in [-1, 1], and u x v is the outward normal. The four equatorial
// faces have north up; +z lies above +x and -z below it in the unfolded cube.
//
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

namespace planet {

enum class Face : std::uint8_t { PosX, NegX, PosY, NegY, PosZ, NegZ };
inline constexpr int faceCount = 6;
inline constexpr std::array<Face, faceCount> allFaces = {Face::PosX, Face::NegX, Face::PosY,
                                                         Face::NegY, Face::PosZ, Face::NegZ};

// Convert a face to and from its name: "x_pos", "x_neg", ... as in file names.
std::string_view faceName(Face face);
std::optional<Face> faceFromName(std::string_view name);

// The axes of a face: unit vectors along world axes.
struct FaceAxes {
    glm::dvec3 normal;
    glm::dvec3 u;
    glm::dvec3 v;
};
const FaceAxes& faceAxes(Face face);

// Returns the point of the cube [-1, 1]^3 at (u, v) of a face. It is exact: each component is +-1, +-u or
// +-v, so points on an edge or a corner are bit-identical for all faces.
glm::dvec3 cubePoint(Face face, double u, double v);

// Returns a point of the unit sphere by Nowell's mapping from the cube [-1, 1]^3. The mapping is symmetric in
// the axes, so the same cube point gives the same bits on every face.
glm::dvec3 sphereFromCube(const glm::dvec3& cube);

// Returns the cube point of a direction of any length but 0: the inverse of sphereFromCube, accurate to
// 1e-14.
glm::dvec3 cubeFromSphere(const glm::dvec3& direction);

struct FacePoint {
    Face face = Face::PosX;
    double u = 0;  // [-1, 1]
    double v = 0;  // [-1, 1]
};

// Returns the coordinates of a point of the cube's surface on its face; on an edge or corner, on the first
// face in enum order.
FacePoint facePointFromCube(const glm::dvec3& cube);
FacePoint facePointFromDirection(const glm::dvec3& direction);

struct Geographic {
    double latitudeRad = 0;   // [-pi/2, pi/2], north positive
    double longitudeRad = 0;  // [-pi, pi], east positive
};
glm::dvec3 directionFromGeographic(const Geographic& place);
Geographic geographicFromDirection(const glm::dvec3& direction);

}  // namespace planet
