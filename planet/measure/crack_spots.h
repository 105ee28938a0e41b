// Connects pixels where ground is missing between chunks into clusters. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace planet {

inline constexpr std::uint32_t noPair = ~std::uint32_t{0};

// A pixel that a crack goes through.
struct CrackPixel {
    int x = 0;                    // from the left
    int y = 0;                    // from the top
    std::uint32_t item = 0;       // the drawn item whose long skirt shows there
    std::uint32_t pair = noPair;  // index of the drawn pair whose edge that skirt hangs from
    bool leaks = false;           // the skirts as set do not hide it
    double closedM = 0;  // to what the pixel shows with long skirts, metres along the view's direction,
    double openM = 0;    // and without any: infinity where there is nothing
    double wallM = 0;    // to the farthest point of the long skirt that the pixel may show
    glm::dvec3 placeM{0, 0, 0};  // on the edge over it, metres from the planet's centre
};

struct CrackSpot {
    std::uint32_t pair = noPair;
    int pixels = 0;
    int leaking = 0;             // of them
    glm::ivec2 from{0, 0};       // the box around it: its first column and row,
    glm::ivec2 to{0, 0};         // and its last
    glm::dvec2 centre{0, 0};     // the pixels' mean, in pixels from the picture's top left corner
    glm::dvec3 placeM{0, 0, 0};  // of the pixel nearest to the centre
};

// Returns the clusters, the largest first, then from the top. Pixels that touch, corners included, and lie
// between the same two chunks form a cluster. Pixels may come in any order, each at most once, inside the
// picture.
std::vector<CrackSpot> crackSpots(std::span<const CrackPixel> pixels, int widthPx, int heightPx);

}  // namespace planet
