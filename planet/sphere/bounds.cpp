#include "planet/sphere/bounds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "planet/base/cpu_clones.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

namespace {

// The margin between samples. The square is sampled on a grid of g = side / sampleCells. Within a cell, a
// smooth f differs from the bilinear interpolation of its corners by at most g^2/8 (max |f_uu| + max |f_vv|):
// interpolation along u adds the first term, and interpolation of that along v the second. Bilinear
// interpolation stays within the convex hull of the corners. So a volume that contains all samples contains
// the whole square once it is enlarged by that margin.
//
// On a face, Nowell's mapping is d = (w, u sqrt(1/2 - v^2/6), v sqrt(1/2 - u^2/6)) with w = sqrt(1 - u^2/2 -
// v^2/2 + u^2 v^2/3). The second derivatives by u are
//   w_uu = -(1 - 2v^2/3)(2 - v^2) / (4 w^3), largest where w is smallest, at u = 1: w^2 = 1/2 - v^2/6, and
//          there at v = 0: |w_uu| <= sqrt(2);
//   zero for the second component; |v| / (12 (1/2 - u^2/6)^(3/2)) <= sqrt(3)/4 for the third.
// So |d_uu| <= sqrt(2 + 3/16) < 1.5, and by symmetry |d_vv| < 1.5.
constexpr int sampleCells = 8;
constexpr int samplesPerSide = sampleCells + 1;
constexpr double maxSecondDerivative = 1.5;

// Bounds the rounding of unit vectors, and of results of a few operations on them.
constexpr double boxRounding = 1e-14;

double marginBetweenSamples(double side) {
    const double g = side / sampleCells;
    return g * g / 8 * (2 * maxSecondDerivative) + boxRounding;
}

// Directions, each component by itself, so that several are computed at once. The last one is repeated up to a whole
// number of groups.
constexpr std::size_t groupSize = 8;
constexpr std::size_t sampleCount = samplesPerSide * samplesPerSide;
constexpr std::size_t paddedCount = (sampleCount + groupSize - 1) / groupSize * groupSize;
struct Samples {
    std::array<std::array<double, paddedCount>, 3> components{};

    glm::dvec3 operator[](std::size_t i) const {
        return {components[0][i], components[1][i], components[2][i]};
    }
};
constexpr std::size_t middleSample = sampleCount / 2;

// Places on a face, row by row, and what sphereFromCube multiplies u and v by. The normal's component of a point of the
// cube is 1 or -1, so u's factor depends on v alone, and v's on u alone.
struct Places {
    std::array<double, paddedCount> u, v, uFactor, vFactor;
};

// Returns the factor of u for a place's v, or the factor of v for its u.
double factorBeside(double other) {
    const double squared = other * other;
    return std::sqrt(1 - (squared + 1) / 2 + squared / 3);
}

// Computes sphereFromCube of cubePoint for places on a face, with the same bits: the axes have one component of 1 or -1,
// and adding 0 leaves no negative zero.
PLANET_CPU_CLONES void setDirections(const FaceAxes& axes, const Places& places, Samples& samples) {
    std::array<double, paddedCount> normal, u, v;
    for (std::size_t i = 0; i < paddedCount; ++i) {
        const double uu = places.u[i] * places.u[i], vv = places.v[i] * places.v[i];
        normal[i] = std::sqrt(1 - (uu + vv) / 2 + uu * vv / 3);
        u[i] = places.u[i] * places.uFactor[i];
        v[i] = places.v[i] * places.vFactor[i];
    }
    for (int c = 0; c < 3; ++c) {
        const double ofNormal = axes.normal[c], ofU = axes.u[c], ofV = axes.v[c];
        std::array<double, paddedCount>& out = samples.components[static_cast<std::size_t>(c)];
        for (std::size_t i = 0; i < paddedCount; ++i)
            out[i] = normal[i] * ofNormal + u[i] * ofU + v[i] * ofV + 0.0;
    }
}

Samples sampleDirections(Face face, const FaceSquare& square) {
    std::array<double, samplesPerSide> uOf{}, vOf{}, vFactorOf{}, uFactorOf{};
    for (std::size_t i = 0; i < samplesPerSide; ++i) {
        uOf[i] = square.u + square.side * static_cast<double>(i) / sampleCells;
        vOf[i] = square.v + square.side * static_cast<double>(i) / sampleCells;
        uFactorOf[i] = factorBeside(vOf[i]);
        vFactorOf[i] = factorBeside(uOf[i]);
    }
    Places places;
    for (std::size_t row = 0; row < samplesPerSide; ++row) {
        const std::size_t first = row * samplesPerSide;
        std::ranges::copy(uOf, places.u.begin() + first);
        std::ranges::copy(vFactorOf, places.vFactor.begin() + first);
        std::fill_n(places.v.begin() + first, samplesPerSide, vOf[row]);
        std::fill_n(places.uFactor.begin() + first, samplesPerSide, uFactorOf[row]);
    }
    for (auto* values : {&places.u, &places.v, &places.uFactor, &places.vFactor})
        std::fill(values->begin() + sampleCount, values->end(), (*values)[sampleCount - 1]);
    Samples samples;
    setDirections(faceAxes(face), places, samples);
    return samples;
}

// Eight components in a vector: GCC does not vectorise a search for the least or the largest of each.
using Group = double __attribute__((vector_size(groupSize * sizeof(double))));

// Eight directions.
struct DirectionGroup {
    Group x, y, z;
};

PLANET_ALWAYS_INLINE void loadGroup(const Samples& samples, std::size_t first, DirectionGroup& group) {
    std::memcpy(&group.x, samples.components[0].data() + first, sizeof(Group));
    std::memcpy(&group.y, samples.components[1].data() + first, sizeof(Group));
    std::memcpy(&group.z, samples.components[2].data() + first, sizeof(Group));
}

PLANET_ALWAYS_INLINE double leastIn(const Group& group) {
    const double a = std::min(group[0], group[4]), b = std::min(group[1], group[5]);
    const double c = std::min(group[2], group[6]), d = std::min(group[3], group[7]);
    return std::min(std::min(a, b), std::min(c, d));
}

PLANET_ALWAYS_INLINE double mostIn(const Group& group) {
    return -leastIn(-group);
}

// Finds the least and the largest component along each axis.
PLANET_CPU_CLONES void setRanges(const Samples& samples, const std::array<glm::dvec3, 3>& axes,
                                 glm::dvec3& least, glm::dvec3& most) {
    std::array<Group, 3> low, high;
    low.fill(Group{} + std::numeric_limits<double>::infinity());
    high.fill(Group{} - std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < paddedCount; i += groupSize) {
        DirectionGroup at;
        loadGroup(samples, i, at);
        for (std::size_t a = 0; a < axes.size(); ++a) {
            const Group along = axes[a].x * at.x + axes[a].y * at.y + axes[a].z * at.z;
            low[a] = along < low[a] ? along : low[a];
            high[a] = along > high[a] ? along : high[a];
        }
    }
    least = {leastIn(low[0]), leastIn(low[1]), leastIn(low[2])};
    most = {mostIn(high[0]), mostIn(high[1]), mostIn(high[2])};
}

// Finds the largest squared distance from a point.
PLANET_CPU_CLONES void setFarthest(const Samples& samples, const glm::dvec3& from, double& squared) {
    Group most{};
    for (std::size_t i = 0; i < paddedCount; i += groupSize) {
        DirectionGroup at;
        loadGroup(samples, i, at);
        const Group dx = at.x - from.x, dy = at.y - from.y, dz = at.z - from.z;
        const Group distance = dx * dx + dy * dy + dz * dz;
        most = distance > most ? distance : most;
    }
    squared = mostIn(most);
}

// Returns east along the middle row of the square, and north and up at its middle.
std::array<glm::dvec3, 3> localAxes(const Samples& samples) {
    const glm::dvec3 up = glm::normalize(samples[middleSample]);
    const glm::dvec3 along =
        samples[middleSample + sampleCells / 2] - samples[middleSample - sampleCells / 2];
    const glm::dvec3 east = glm::normalize(along - glm::dot(along, up) * up);
    return {east, glm::cross(up, east), up};
}

OrientedBox boxOf(const ChunkDirections& directions, double minRadiusM, double maxRadiusM) {
    OrientedBox box;
    box.axes = directions.axes;
    for (int a = 0; a < 3; ++a) {
        const double low = directions.low[a];
        const double high = directions.high[a];
        const double lowM = low * (low < 0 ? maxRadiusM : minRadiusM);
        const double highM = high * (high > 0 ? maxRadiusM : minRadiusM);
        box.centreM += box.axes[static_cast<std::size_t>(a)] * ((lowM + highM) / 2);
        box.halfSizeM[a] = (highM - lowM) / 2 + boxRounding * maxRadiusM;
    }
    return box;
}

DirectionCone coneOf(const Samples& samples, double margin) {
    DirectionCone cone;
    cone.axis = glm::normalize(samples[middleSample]);
    double squaredChord = 0;
    setFarthest(samples, cone.axis, squaredChord);
    // Uses the chord, because the cosine of a small angle loses all digits.
    cone.halfAngleRad = 2 * std::asin(std::min(1.0, (std::sqrt(squaredChord) + margin) / 2));
    return cone;
}

// Returns acos(adjacent / hypotenuse), accurate for small angles too.
double angleOf(double adjacent, double hypotenuse) {
    const double opposite = std::sqrt((hypotenuse - adjacent) * (hypotenuse + adjacent));
    return std::atan2(opposite, adjacent);
}

}  // namespace

ChunkDirections chunkDirections(const ChunkId& id) {
    const FaceSquare square = faceSquareOf(id);
    const Samples samples = sampleDirections(id.face, square);
    const double margin = marginBetweenSamples(square.side);
    ChunkDirections directions;
    directions.axes = localAxes(samples);
    setRanges(samples, directions.axes, directions.low, directions.high);
    directions.low -= margin;
    // No unit vector extends beyond 1 along an axis, so the top of the box needs no margin.
    directions.high = glm::min(directions.high + margin, glm::dvec3(1 + boxRounding));
    directions.cone = coneOf(samples, margin);
    return directions;
}

ChunkBounds chunkBounds(const ChunkDirections& directions, double radiusM, double minHeightM,
                        double maxHeightM) {
    assert(radiusM + minHeightM > 0 && minHeightM <= maxHeightM);
    ChunkBounds bounds;
    bounds.box = boxOf(directions, radiusM + minHeightM, radiusM + maxHeightM);
    bounds.cone = directions.cone;
    bounds.coneSine = std::sin(directions.cone.halfAngleRad);
    bounds.maxRadiusM = radiusM + maxHeightM;
    return bounds;
}

ChunkBounds chunkBounds(const ChunkId& id, double radiusM, double minHeightM, double maxHeightM) {
    return chunkBounds(chunkDirections(id), radiusM, minHeightM, maxHeightM);
}

double distanceM(const OrientedBox& box, const glm::dvec3& pointM) {
    const glm::dvec3 offset = pointM - box.centreM;
    double squared = 0;
    for (int a = 0; a < 3; ++a) {
        const double along = std::abs(glm::dot(offset, box.axes[static_cast<std::size_t>(a)]));
        const double beyond = std::max(0.0, along - box.halfSizeM[a]);
        squared += beyond * beyond;
    }
    return std::sqrt(squared);
}

Containment classify(const OrientedBox& box, const Plane& plane) {
    const double centre = glm::dot(plane.normal, box.centreM) + plane.offsetM;
    double reach = 0;
    for (int a = 0; a < 3; ++a) {
        reach += box.halfSizeM[a] * std::abs(glm::dot(plane.normal, box.axes[static_cast<std::size_t>(a)]));
    }
    if (centre < -reach) return Containment::Outside;
    return centre >= reach ? Containment::Inside : Containment::Crossing;
}

Horizon horizonOf(const glm::dvec3& eyeM, double occluderRadiusM) {
    Horizon horizon;
    horizon.occluderRadiusM = occluderRadiusM;
    const double eyeRadiusM = glm::length(eyeM);
    horizon.seesAll = eyeRadiusM <= occluderRadiusM || occluderRadiusM <= 0;
    if (horizon.seesAll) return horizon;
    horizon.eyeDirection = eyeM / eyeRadiusM;
    horizon.angleRad = angleOf(occluderRadiusM, eyeRadiusM);
    horizon.angleCosine = std::cos(horizon.angleRad);
    horizon.angleSine = std::sin(horizon.angleRad);
    return horizon;
}

namespace {

// Cosines of angles that differ by less than this may be in either order, because of rounding.
constexpr double cosineRounding = 1e-13;

// The cosine and the sine of an angle.
struct Turn {
    double cosine = 1;
    double sine = 0;
};
Turn operator+(const Turn& a, const Turn& b) {
    return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}
Turn operator-(const Turn& a) {
    return {a.cosine, -a.sine};
}

// A line of sight touches the occluder at angleRad from the eye's direction. Beyond that point it reaches a
// point of radius r at most acos(occluder / r) further round.
Containment classifyByAngles(const ChunkBounds& bounds, const Horizon& horizon) {
    const DirectionCone& cone = bounds.cone;
    const double toAxis = std::atan2(glm::length(glm::cross(horizon.eyeDirection, cone.axis)),
                                     glm::dot(horizon.eyeDirection, cone.axis));
    if (toAxis + cone.halfAngleRad < horizon.angleRad) return Containment::Inside;
    const double topM = std::max(bounds.maxRadiusM, horizon.occluderRadiusM);
    const double reach = horizon.angleRad + angleOf(horizon.occluderRadiusM, topM) + boxRounding;
    return toAxis - cone.halfAngleRad > reach ? Containment::Outside : Containment::Crossing;
}

}  // namespace

// Compares cosines instead of angles, which takes a fifth of the time, unless they are so close that rounding decides.
// The angles of the cone and of the horizon are at most pi / 2 each, so their difference lies in [-pi / 2, pi / 2] and
// their sum with the angle to the top in [0, 3 pi / 2]. Where a sine tells that the difference is negative, or the sum
// more than pi, no cosine can be compared.
Containment classify(const ChunkBounds& bounds, const Horizon& horizon) {
    if (horizon.seesAll) return Containment::Inside;
    const double cosine = glm::dot(horizon.eyeDirection, bounds.cone.axis);
    const Turn touch{horizon.angleCosine, horizon.angleSine};
    const Turn cone{std::sqrt(1 - bounds.coneSine * bounds.coneSine), bounds.coneSine};
    const Turn inner = touch + -cone;
    if (inner.sine > cosineRounding && cosine > inner.cosine + cosineRounding) return Containment::Inside;
    const bool isSurelyNotInside = inner.sine < -cosineRounding || cosine < inner.cosine - cosineRounding;
    const double topM = std::max(bounds.maxRadiusM, horizon.occluderRadiusM);
    const double occluderM = horizon.occluderRadiusM;
    const Turn top{occluderM / topM, std::sqrt((topM - occluderM) * (topM + occluderM)) / topM};
    const Turn outer = touch + top + cone;
    if (!isSurelyNotInside) return classifyByAngles(bounds, horizon);
    if (outer.sine > cosineRounding && cosine < outer.cosine - cosineRounding) return Containment::Outside;
    const bool isSurelyCrossing = outer.sine < -cosineRounding || cosine > outer.cosine + cosineRounding;
    return isSurelyCrossing ? Containment::Crossing : classifyByAngles(bounds, horizon);
}

// A triangle whose corners are within an angle a of a direction m, none nearer than r, has dot(point, m) >= r
// cos a at each corner, and so at every point. All faces are alike, and cells of finer levels are smaller, so
// the widest cell of one root chunk bounds all cells.
double radiusInsideTriangles(double lowestRadiusM, int rootCells) {
    assert(lowestRadiusM > 0 && rootCells > 0);
    const double cell = 2.0 / rootCells;
    double leastCosine = 1;
    for (int j = 0; j < rootCells; ++j) {
        for (int i = 0; i < rootCells; ++i) {
            const double u = -1 + cell * i;
            const double v = -1 + cell * j;
            const auto at = [&](double du, double dv) {
                return sphereFromCube(cubePoint(Face::PosX, u + du, v + dv));
            };
            const glm::dvec3 middle = at(cell / 2, cell / 2);
            for (const glm::dvec3& corner : {at(0, 0), at(cell, 0), at(0, cell), at(cell, cell)}) {
                leastCosine = std::min(leastCosine, glm::dot(middle, corner));
            }
        }
    }
    return lowestRadiusM * (leastCosine - boxRounding);
}

}  // namespace planet
