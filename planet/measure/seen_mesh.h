// Finds the triangles at a pixel's centre and their distances as a rasteriser does, but in doubles.
//
// A rasteriser snaps vertices to a grid of 1/256 pixel or finer, so the point that it shows at a pixel's
// centre may be off by that much. On a triangle seen nearly edge-on, this is a large difference in depth. So
// distances are ranges: those of a triangle within slackPx of the centre.
//
// Pure functions, any thread.
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
    // Two vertices of an edge may each move by half a step of the coarsest grid in use, 1/256 pixel, and the
    // sample point lies between them. Twice that is a safe margin.
    static constexpr double slackPx = 1.0 / 128;

    // Distances are metres along the view's direction.
    struct Hit {
        std::uint32_t label = 0;
        double offPx = 0;  // from the pixel's centre to the triangle, 0 inside
        double nearestM = 0;
        double farthestM = 0;
        double distanceM = 0;  // at the centre, or else at the triangle's nearest or farthest point
    };

    explicit SeenMesh(const View& view);

    // Adds a triangle and clips the part behind the eye. cornersM: metres from the planet's centre.
    void add(const std::array<glm::dvec3, 3>& cornersM, std::uint32_t label = 0);

    // Returns, among the triangles at a pixel's centre, the one whose farthest point within the slack is
    // nearest. If there is none, returns the triangle closest to the centre in the picture. Columns count
    // from the left, rows from the top.
    std::optional<Hit> frontAt(int x, int y) const;
    // Returns the smallest distance of any triangle within the slack of the centre.
    std::optional<double> nearestAtM(int x, int y) const;

    // Returns the point at a pixel's centre and at a distance along the view's direction, metres from the
    // planet's centre.
    static glm::dvec3 pointAt(const View& view, int x, int y, double distanceM);

private:
    struct Corner {
        glm::dvec2 px;
        double inverse;  // of the distance, 1/m: linear in the picture
    };
    struct Triangle {
        std::array<Corner, 3> corners;
        glm::dvec2 low, high;  // bounding box
        std::uint32_t label;
    };
    void addClipped(const std::array<Corner, 3>& corners, std::uint32_t label);
    static Hit hitOf(const Triangle& triangle, const glm::dvec2& centre);

    View view_;
    double scalePx_;
    std::vector<Triangle> triangles_;
};

}  // namespace planet
