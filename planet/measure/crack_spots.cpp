#include "planet/measure/crack_spots.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

namespace planet {

namespace {

constexpr std::int32_t nobody = -1;

// The crack pixel at each pixel of the picture, and the flags of those that belong to a cluster already.
struct Field {
    std::span<const CrackPixel> pixels;
    int widthPx;
    int heightPx;
    std::vector<std::int32_t> at;
    std::vector<bool> taken;

    Field(std::span<const CrackPixel> all, int width, int height)
        : pixels(all),
          widthPx(width),
          heightPx(height),
          at(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), nobody),
          taken(all.size(), false) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            assert(all[i].x >= 0 && all[i].x < width && all[i].y >= 0 && all[i].y < height);
            at[placeOf(all[i].x, all[i].y)] = static_cast<std::int32_t>(i);
        }
    }
    std::size_t placeOf(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(widthPx) + static_cast<std::size_t>(x);
    }
};

// Adds the neighbours of a pixel that belong to its cluster, and lists them.
void takeAround(Field& field, std::size_t index, std::vector<std::size_t>& members) {
    const CrackPixel& here = field.pixels[index];
    for (int y = std::max(here.y - 1, 0); y <= std::min(here.y + 1, field.heightPx - 1); ++y) {
        for (int x = std::max(here.x - 1, 0); x <= std::min(here.x + 1, field.widthPx - 1); ++x) {
            const std::int32_t other = field.at[field.placeOf(x, y)];
            if (other == nobody) continue;
            const auto beside = static_cast<std::size_t>(other);
            if (field.taken[beside] || field.pixels[beside].pair != here.pair) continue;
            field.taken[beside] = true;
            members.push_back(beside);
        }
    }
}

CrackSpot spotOf(const Field& field, std::span<const std::size_t> members) {
    const CrackPixel& first = field.pixels[members.front()];
    CrackSpot spot;
    spot.pair = first.pair;
    spot.from = spot.to = {first.x, first.y};
    for (const std::size_t member : members) {
        const CrackPixel& pixel = field.pixels[member];
        const glm::ivec2 at(pixel.x, pixel.y);
        ++spot.pixels;
        spot.leaking += pixel.leaks ? 1 : 0;
        spot.from = glm::min(spot.from, at);
        spot.to = glm::max(spot.to, at);
        spot.centre += glm::dvec2(at) + 0.5;
    }
    spot.centre /= spot.pixels;
    const auto away = [&](std::size_t member) {
        const CrackPixel& pixel = field.pixels[member];
        return glm::length(glm::dvec2(pixel.x, pixel.y) + 0.5 - spot.centre);
    };
    const auto nearest = std::min_element(members.begin(), members.end(),
                                          [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
    spot.placeM = field.pixels[*nearest].placeM;
    return spot;
}

}  // namespace

std::vector<CrackSpot> crackSpots(std::span<const CrackPixel> pixels, int widthPx, int heightPx) {
    Field field(pixels, widthPx, heightPx);
    std::vector<CrackSpot> spots;
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (field.taken[i]) continue;
        field.taken[i] = true;
        members.assign(1, i);
        for (std::size_t next = 0; next < members.size(); ++next) takeAround(field, members[next], members);
        spots.push_back(spotOf(field, members));
    }
    std::sort(spots.begin(), spots.end(), [](const CrackSpot& a, const CrackSpot& b) {
        return std::make_tuple(-a.pixels, a.from.y, a.from.x, a.pair) <
               std::make_tuple(-b.pixels, b.from.y, b.from.x, b.pair);
    });
    return spots;
}

}  // namespace planet
