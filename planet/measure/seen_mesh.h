// Triangles as a rasteriser sees them, in doubles: which of them are at a pixel's centre, and how far away.
//
// A rasteriser moves vertices to a grid of 1/256 pixel or finer, so what it shows at a pixel's centre may lie
// that far beside it. On a triangle seen nearly edge-on that is a long way in depth: distances here come as
// the range that a triangle has within slackPx of the centre.
//
// Pure, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "planet/sphere/view.h"

namespace planet {

class SeenMesh {
public:
    // Two vertices of an edge may each be moved by half a step of the coarsest grid that OpenGL allows for
    // such pictures in use, 1/256 pixel, and the sample point lies between: twice that is on the safe side.
    static constexpr double slackPx = 1.0 / 128;

    // Distances are metres along the view's direction.
    struct Hit {
        std::uint32_t label = 0;
        double offPx = 0;  // from the pixel's centre to the triangle, 0 inside
        double nearestM = 0;
        double farthestM = 0;
        double distanceM = 0;  // at the centre, or of the triangle's nearest or farthest point to that
    };

    explicit SeenMesh(const View& view);

    // Corners in metres from the planet's centre. Parts behind the eye are left out.
    void add(const std::array<glm::dvec3, 3>& cornersM, std::uint32_t label = 0);

    // At the centre of the pixel, columns from the left and rows from the top: the triangle whose farthest
    // point within the slack is nearest; where there is none, the one that is closest to it in the picture.
    std::optional<Hit> frontAt(int x, int y) const;
    // The nearest that any triangle comes within the slack of the centre.
    std::optional<double> nearestAtM(int x, int y) const;

    // The point that a pixel's centre shows at a distance along the view's direction, metres from the
    // planet's centre.
    static glm::dvec3 pointAt(const View& view, int x, int y, double distanceM);

private:
    struct Corner {
        glm::dvec2 px;
        double inverse;  // of the distance, 1/m: linear over the picture
    };
    struct Triangle {
        std::array<Corner, 3> corners;
        glm::dvec2 low, high;  // box
        std::uint32_t label;
    };
    void addClipped(const std::array<Corner, 3>& corners, std::uint32_t label);
    static Hit hitOf(const Triangle& triangle, const glm::dvec2& centre);

    View view_;
    double scalePx_;
    std::vector<Triangle> triangles_;
};

}  // namespace planet
