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

// A pixel that shows a crack.
struct CrackPixel {
    int x = 0;                    // from the left
    int y = 0;                    // from the top
    std::uint32_t item = 0;       // the drawn item whose long skirt shows there
    std::uint32_t pair = noPair;  // index of the drawn pair at whose edge the skirt hangs
    bool leaks = false;           // the skirts as set do not cover the pixel
    double closedM = 0;           // distance with long skirts, metres along the view's direction
    double openM = 0;             // distance without skirts; infinity: nothing there
    double wallM = 0;             // distance of the farthest point of the long skirt in the pixel
    glm::dvec3 placeM{0, 0, 0};   // on that edge, metres from the planet's centre
};

struct CrackSpot {
    std::uint32_t pair = noPair;
    int pixels = 0;
    int leaking = 0;             // number of leaking pixels
    glm::ivec2 from{0, 0};       // first column and row of its bounding box
    glm::ivec2 to{0, 0};         // last column and row
    glm::dvec2 centre{0, 0};     // the pixels' mean, in pixels from the picture's top left corner
    glm::dvec3 placeM{0, 0, 0};  // of the pixel nearest to the centre
};

// Returns the clusters, the largest first, then from the top. Pixels that touch, corners included, and lie
// between the same two chunks form a cluster. Pixels may come in any order, each at most once, inside the
// picture.
std::vector<CrackSpot> crackSpots(std::span<const CrackPixel> pixels, int widthPx, int heightPx);

}  // namespace planet
