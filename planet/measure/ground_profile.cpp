#include "planet/measure/ground_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <unordered_map>

#include "planet/base/try.h"
#include "planet/select/drawn_surface.h"

namespace planet {

namespace {

// Returns the place of a direction on a chunk's grid, in cells; outside of [0, cells] beside the chunk.
glm::dvec2 placeOn(const DrawnGrid& grid, const glm::dvec3& direction) {
    const FaceAxes& axes = faceAxes(grid.id.face);
    const glm::dvec3 cube = cubeFromSphere(direction);
    const FaceSquare square = faceSquareOf(grid.id);
    const glm::dvec2 onFace{glm::dot(axes.u, cube), glm::dot(axes.v, cube)};
    return (onFace - glm::dvec2(square.u, square.v)) * (grid.cells / square.side);
}

// Returns the distance from the planet's centre to the grid's surface in a direction. A triangle is flat, so its point at a
// place lies in a slightly different direction; the place is corrected by that difference until none is left.
double distanceTo(const DrawnGrid& grid, const glm::dvec3& direction) {
    const auto within = [&](const glm::dvec2& place) {
        return glm::clamp(place, glm::dvec2(0), glm::dvec2(grid.cells));
    };
    const glm::dvec2 wanted = placeOn(grid, direction);
    glm::dvec2 place = within(wanted);
    glm::dvec3 point = pointOn(grid, place.x, place.y);
    constexpr int mostSteps = 8;  // each reduces the difference by far more than ten
    constexpr double enoughCells = 1e-9;
    for (int step = 0; step < mostSteps; ++step) {
        const glm::dvec2 off = wanted - placeOn(grid, point);
        if (glm::length(off) < enoughCells) break;
        place = within(place + off);
        point = pointOn(grid, place.x, place.y);
    }
    return glm::length(point);
}

// Follows a profile's points from chunk to chunk, and keeps the surface of the last one.
class Ground {
public:
    Ground(const ProfileGround& ground, FinestHeights& heights) : ground_(ground), heights_(heights) {
        for (std::size_t i = 0; i < ground.drawn.items.size(); ++i) {
            const ChunkId& id = ground.drawn.items[i].id;
            byId_.emplace(id, i);
            deepest_ = std::max(deepest_, static_cast<int>(id.level));
        }
    }

    Result<void> measure(ProfilePoint& point) {
        const FacePoint place = facePointFromDirection(point.direction);
        const std::optional<std::size_t> item = itemAt(place);
        const double radiusM = ground_.drawn.shape.radiusM;
        if (item) point.drawnM = distanceTo(drawnSurface(*item), point.direction) - radiusM;
        const HeldChunk& top =
            item ? ground_.drawn.chunks[*item] : ground_.roots[static_cast<std::size_t>(place.face)];
        const ChunkId deepest = chunkAt(place, deepestLevelOf(ground_.drawn.shape));
        TRY_ASSIGN(const HeldChunk leaf, heights_.chunkUnder(top, deepest, ground_.drawn.resident));
        if (finest_.cells == 0 || finest_.id != leaf.id)
            finest_ = drawnGrid(ground_.drawn.shape, DrawItem{.id = leaf.id}, *leaf.heights, false);
        point.finestM = distanceTo(finest_, point.direction) - radiusM;
        return {};
    }

private:
    std::optional<std::size_t> itemAt(const FacePoint& place) const {
        for (int level = deepest_; level >= 0; --level) {
            if (const auto found = byId_.find(chunkAt(place, level)); found != byId_.end())
                return found->second;
        }
        return std::nullopt;
    }

    const DrawnGrid& drawnSurface(std::size_t item) {
        const DrawItem& drawn = ground_.drawn.items[item];
        if (drawn_.cells == 0 || drawn_.id != drawn.id) {
            drawn_ = drawnGrid(ground_.drawn.shape, drawn, *ground_.drawn.chunks[item].heights,
                               ground_.drawn.stitched);
        }
        return drawn_;
    }

    const ProfileGround& ground_;
    FinestHeights& heights_;
    std::unordered_map<ChunkId, std::size_t> byId_;
    int deepest_ = -1;
    DrawnGrid drawn_;
    DrawnGrid finest_;
};

glm::dvec3 anyAcross(const glm::dvec3& direction) {
    const glm::dvec3 axis = std::abs(direction.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(direction, axis));
}

}  // namespace

ProfileGround profileGroundOf(const ChunkTree& tree, std::span<const DrawItem> items, const View& view,
                              bool stitched) {
    ProfileGround ground{snapshotOf(tree, items, view, stitched), {}};
    for (std::size_t face = 0; face < ground.roots.size(); ++face) {
        const ChunkNode& node = tree.nodes[face];
        ground.roots[face] = {node.id, node.heights, node.children};
    }
    return ground;
}

Result<GroundProfile> groundProfile(const ProfileGround& ground, FinestHeights& heights,
                                    const glm::dvec3& from, const glm::dvec3& to, int count,
                                    const std::function<bool()>& goOn) {
    assert(count >= 2 && count <= mostProfilePoints);
    const glm::dvec3 start = glm::normalize(from);
    const glm::dvec3 end = glm::normalize(to);
    const glm::dvec3 across = glm::cross(start, end);
    const double sine = glm::length(across);
    const double angle = std::atan2(sine, glm::dot(start, end));
    const glm::dvec3 axis = sine > 1e-12 ? across / sine : anyAcross(start);
    const glm::dvec3 ahead = glm::cross(axis, start);
    GroundProfile profile{{}, ground.drawn.shape.radiusM};
    profile.points.reserve(static_cast<std::size_t>(count));
    Ground surface(ground, heights);
    for (int i = 0; i < count; ++i) {
        if (goOn && !goOn()) return cancelled();
        const double turned = angle * i / (count - 1);
        ProfilePoint point{start * std::cos(turned) + ahead * std::sin(turned), turned * profile.radiusM};
        TRY(surface.measure(point));
        profile.points.push_back(point);
    }
    return profile;
}

ProfileSummary summaryOf(const GroundProfile& profile) {
    ProfileSummary summary;
    if (profile.points.empty()) return summary;
    const ProfilePoint& first = profile.points.front();
    const ProfilePoint& last = profile.points.back();
    const auto positionM = [&](const ProfilePoint& point) {
        return point.direction * (profile.radiusM + point.finestM);
    };
    summary.arcM = last.alongM;
    summary.straightM = glm::distance(positionM(first), positionM(last));
    summary.riseM = last.finestM - first.finestM;
    summary.slopeRad =
        summary.straightM > 0 ? std::asin(std::clamp(summary.riseM / summary.straightM, -1.0, 1.0)) : 0;
    summary.lowestM = summary.highestM = first.finestM;
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
        const ProfilePoint& point = profile.points[i];
        summary.lowestM = std::min(summary.lowestM, point.finestM);
        summary.highestM = std::max(summary.highestM, point.finestM);
        if (point.drawnM) {
            ++summary.drawn;
            if (std::abs(*point.drawnM - point.finestM) > summary.worstErrorM) {
                summary.worstErrorM = std::abs(*point.drawnM - point.finestM);
                summary.worstAlongM = point.alongM;
            }
        }
        if (i == 0) continue;
        const ProfilePoint& before = profile.points[i - 1];
        const double stepM = glm::distance(positionM(before), positionM(point));
        const double riseM = point.finestM - before.finestM;
        summary.onGroundM += stepM;
        (riseM > 0 ? summary.ascentM : summary.descentM) += std::abs(riseM);
        if (stepM <= 0) continue;
        const double slopeRad = std::asin(std::clamp(riseM / stepM, -1.0, 1.0));
        if (std::abs(slopeRad) > std::abs(summary.steepestRad)) summary.steepestRad = slopeRad;
    }
    return summary;
}

}  // namespace planet
