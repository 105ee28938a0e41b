// Heights along the great circle between two places: the drawn surface beside the finest data, both as the triangles that
// are, or would be, drawn. Pure functions apart from reading the file; any thread.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "planet/measure/true_error.h"
#include "planet/paging/finest_heights.h"

namespace planet {

// The ground that a profile is measured on, independent of the planet's later steps.
struct ProfileGround {
    DrawnSnapshot drawn;
    std::array<HeldChunk, faceCount> roots;  // in face order; for places where no chunk is drawn
};
ProfileGround profileGroundOf(const ChunkTree& tree, std::span<const DrawItem> items, const View& view,
                              bool stitched);

struct ProfilePoint {
    glm::dvec3 direction{1, 0, 0};  // from the planet's centre, of length 1
    double alongM = 0;              // from the start, along the great circle at the planet's radius, metres
    double finestM = 0;  // height of the finest data above the radius, metres, with the exaggeration
    std::optional<double> drawnM{};  // the same of the drawn surface; none where no chunk is drawn
};

struct GroundProfile {
    std::vector<ProfilePoint> points;  // at equal steps, both ends included
    double radiusM = 0;                // of the planet
};

inline constexpr int mostProfilePoints = 4097;

// Measures count points, [2, mostProfilePoints], from one direction to another, of any length but 0. Between two opposite
// directions, any of the great circles is taken. goOn is called between points; if it returns false, the result is an Error
// of kind Cancelled. Other Errors name the file and the chunk that could not be read.
Result<GroundProfile> groundProfile(const ProfileGround& ground, FinestHeights& heights,
                                    const glm::dvec3& from, const glm::dvec3& to, int count,
                                    const std::function<bool()>& goOn = {});

// Figures of a profile. Lengths are in metres; slopes are in radians, positive upwards along the way.
struct ProfileSummary {
    double arcM = 0;         // along the great circle at the planet's radius
    double straightM = 0;    // between the two ends in space
    double onGroundM = 0;    // along the finest data, as far as the points show it
    double riseM = 0;        // from the first to the last point
    double slopeRad = 0;     // of the straight line, against the horizontal in its middle
    double steepestRad = 0;  // between two neighbouring points, the one of the largest magnitude
    double ascentM = 0;      // sum of all rises, >= 0
    double descentM = 0;     // sum of all falls, >= 0
    double lowestM = 0;      // of the finest data
    double highestM = 0;     // of the finest data
    double worstErrorM = 0;  // largest difference of the drawn surface from the finest data
    double worstAlongM = 0;  // where that is
    std::size_t drawn = 0;   // number of points with a drawn surface
};
ProfileSummary summaryOf(const GroundProfile& profile);

}  // namespace planet
