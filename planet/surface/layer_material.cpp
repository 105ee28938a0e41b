#include "planet/surface/layer_material.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "planet/surface/tiling_noise.h"

namespace planet {

namespace {

using std::numbers::pi;

// The painted properties of a material, before they are converted to bytes.
struct Canvas {
    int size;
    std::vector<double> relief;      // any range
    std::vector<glm::dvec3> colour;  // sRGB
    std::vector<double> rough;       // [0, 1]

    explicit Canvas(int side) : size(side) {
        const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        relief.resize(count);
        colour.resize(count);
        rough.resize(count, 0.9);
    }
    std::size_t at(int x, int y) const {
        const auto wrap = [&](int i) { return static_cast<std::size_t>(i & (size - 1)); };
        return wrap(y) * static_cast<std::size_t>(size) + wrap(x);
    }
    template <class Paint>
    void each(const Paint& paint) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x)
                paint(glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size), at(x, y));
        }
    }
};

// A stream of pseudo-random numbers in [0, 1) from a seed.
struct Dice {
    std::uint32_t seed;
    std::uint32_t count = 0;
    double operator()() { return tilingRandom(count++, 0x51u, seed); }
    double operator()(double least, double most) { return least + (most - least) * (*this)(); }
    // Draws y before x in statements of their own, because the evaluation order of arguments is unspecified.
    glm::dvec2 place() {
        const double y = (*this)();
        const double x = (*this)();
        return {x, y};
    }
};

double smooth(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double grain(std::size_t texel, std::uint32_t seed) {
    return tilingRandom(static_cast<std::uint32_t>(texel), 3, seed) - 0.5;
}

// Returns ripples of wind or water, in whole waves across the square: a gentle rise and a steep fall.
double ripples(const glm::dvec2& place, const glm::dvec2& waves, double bend) {
    const double phase = waves.x * place.x + waves.y * place.y + bend;
    const double t = phase - std::floor(phase);
    return t < 0.68 ? smooth(0, 0.68, t) : 1 - smooth(0.68, 1, t);
}

void paintSand(Canvas& canvas, std::uint32_t seed) {
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        const glm::dvec2 bent = p + 0.02 * tilingNoise2(p, 4, seed + 11);
        const double broad = tilingFbm(p, 2, 4, seed);
        const double bend = 0.9 * tilingFbm(p, 3, 3, seed + 20);
        const double other = smooth(-0.15, 0.35, tilingFbm(p, 2, 2, seed + 30));
        const double train =
            glm::mix(ripples(bent, {3, 19}, bend), ripples(bent, {-2, 23}, 1.3 * bend), other);
        const double strength = 0.55 + 0.45 * smooth(-0.5, 0.5, tilingFbm(p, 3, 2, seed + 40));
        const double fine = tilingFbm(p, 48, 3, seed + 50);
        const double speck = grain(i, seed + 60);
        canvas.relief[i] = 0.34 * train * strength + 0.42 * broad + 0.03 * fine + 0.03 * speck;
        const double light =
            0.93 + 0.10 * (train - 0.5) * strength + 0.05 * broad + 0.05 * fine + 0.10 * speck;
        const glm::dvec3 hue = glm::mix(glm::dvec3(0.79, 0.68, 0.49), glm::dvec3(0.85, 0.77, 0.60),
                                        0.5 + 0.8 * tilingFbm(p, 4, 3, seed + 70));
        canvas.colour[i] = hue * light;
        if (speck > 0.485) canvas.colour[i] *= 0.72;
        canvas.rough[i] = 0.86 + 0.06 * speck;
    });
}

// Paints a bent blade of grass; higher relief hides what is below it.
void paintBlade(Canvas& canvas, Dice& dice, const glm::dvec3& hue) {
    const glm::dvec2 root = dice.place();
    const double clump = 2 * pi * tilingNoise(root, 5, 77);
    const double angle = clump + dice(-1.3, 1.3);
    const double bow = dice(-1.1, 1.1);
    const double length = dice(0.022, 0.060);
    const double width = dice(0.0016, 0.0034);
    const double height = dice(0.45, 1.0);
    const double shade = dice(0.72, 1.18);
    const int steps = static_cast<int>(length * canvas.size * 1.6) + 2;
    for (int step = 0; step < steps; ++step) {
        const double t = static_cast<double>(step) / (steps - 1);
        const double turn = angle + bow * t;
        const glm::dvec2 along(std::cos(turn), std::sin(turn));
        const glm::dvec2 middle = (root + along * (length * t)) * static_cast<double>(canvas.size);
        const double half = std::max(width * (1 - 0.8 * t) * canvas.size, 0.5);
        const double z = height * (0.25 + 0.75 * std::sin(0.5 * pi * std::min(1.25 * t, 1.0)));
        const int reach = static_cast<int>(half) + 1;
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                const double aside = x * -along.y + y * along.x;
                if (std::abs(aside) > half || x * x + y * y > (half + 0.7) * (half + 0.7)) continue;
                const std::size_t i = canvas.at(static_cast<int>(std::floor(middle.x)) + x,
                                                static_cast<int>(std::floor(middle.y)) + y);
                if (canvas.relief[i] >= z) continue;
                canvas.relief[i] = z;
                canvas.colour[i] = hue * (shade * (0.62 + 0.48 * t) * (1 + 0.16 * aside / half));
                canvas.rough[i] = 0.72;
            }
        }
    }
}

void paintGrass(Canvas& canvas, std::uint32_t seed) {
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        canvas.relief[i] = 0.10 * (tilingFbm(p, 12, 4, seed) + 1);
        canvas.colour[i] = glm::dvec3(0.20, 0.17, 0.10) * (0.9 + 0.4 * tilingFbm(p, 24, 3, seed + 5));
        canvas.rough[i] = 0.95;
    });
    Dice dice{seed + 10};
    for (int blade = 0; blade < 15000; ++blade) {
        const double dry = dice();
        glm::dvec3 hue = glm::mix(glm::dvec3(0.30, 0.41, 0.13), glm::dvec3(0.41, 0.47, 0.19), dice());
        if (dry > 0.88) hue = glm::mix(hue, glm::dvec3(0.60, 0.54, 0.30), dice(0.3, 0.9));
        paintBlade(canvas, dice, hue);
    }
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        canvas.colour[i] *= 1.0 + 0.14 * tilingFbm(p, 3, 3, seed + 90);
    });
}

// Paints a tree's crown as seen from above: a lumpy dome.
void paintCrown(Canvas& canvas, Dice& dice, std::uint32_t seed) {
    const glm::dvec2 middle = dice.place();
    const double usual = dice(0.012, 0.030);
    const double radius = usual * (dice() > 0.85 ? 1.3 : 1.0);
    const double stands = dice(0.25, 0.75);
    const bool conifer = dice() > 0.55;
    glm::dvec3 hue = conifer
                         ? glm::dvec3(0.145, 0.205, 0.105)
                         : glm::mix(glm::dvec3(0.165, 0.235, 0.085), glm::dvec3(0.235, 0.285, 0.110), dice());
    if (dice() > 0.985) hue = glm::dvec3(0.27, 0.24, 0.12);
    hue *= dice(0.8, 1.15);
    const int reach = static_cast<int>(1.35 * radius * canvas.size) + 1;
    const glm::ivec2 texel(glm::floor(middle * static_cast<double>(canvas.size)));
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const glm::dvec2 from = glm::dvec2(x, y) / (radius * canvas.size);
            const glm::dvec2 place = glm::dvec2(texel + glm::ivec2(x, y)) / static_cast<double>(canvas.size);
            const double lumps = tilingFbm(place, 64, 3, seed + 3);
            const double away = glm::length(from) * (1 + 0.30 * lumps);
            if (away >= 1) continue;
            const double dome = conifer ? std::pow(1 - away, 0.8) : std::sqrt(1 - away * away);
            const double z = stands + radius * (conifer ? 14.0 : 10.0) * dome + 0.14 * lumps;
            const std::size_t i = canvas.at(texel.x + x, texel.y + y);
            if (canvas.relief[i] >= z) continue;
            canvas.relief[i] = z;
            canvas.colour[i] = hue * (0.55 + 0.55 * dome + 0.30 * lumps);
            canvas.rough[i] = 0.82;
        }
    }
}

void paintForest(Canvas& canvas, std::uint32_t seed) {
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        canvas.relief[i] = 0.12 * tilingFbm(p, 16, 3, seed);
        canvas.colour[i] = glm::dvec3(0.075, 0.095, 0.045) * (1 + 0.4 * tilingFbm(p, 32, 3, seed + 1));
        canvas.rough[i] = 0.95;
    });
    Dice dice{seed + 10};
    for (int crown = 0; crown < 1900; ++crown) paintCrown(canvas, dice, seed);
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        canvas.colour[i] *=
            1.05 + 0.5 * tilingFbm(p, 96, 2, seed + 50) + 0.15 * tilingFbm(p, 3, 2, seed + 60);
    });
}

// A facet of broken stone: each cell leans in its own direction.
struct Facet {
    double height = 0;
    double facing = 0;  // [-1, 1], up the square: its brightness in light from there
    double crack = 0;   // distance to the border of the nearest cell, in cells
};
Facet facetAt(const glm::dvec2& place, int cells, std::uint32_t seed) {
    const CellPlace cell = tilingCells(place, cells, seed);
    const double turn = 2 * pi * (cell.id & 0xFFFFu) / 65536.0;
    const double lean = 0.3 + 0.7 * ((cell.id >> 16) & 0xFFu) / 255.0;
    const glm::dvec2 down(std::cos(turn), std::sin(turn));
    return {lean * glm::dot(cell.offset, down) + 0.5 * (cell.id >> 24) / 255.0, lean * down.y, cell.toBorder};
}

void paintRock(Canvas& canvas, std::uint32_t seed) {
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        const glm::dvec2 bent =
            p + 0.018 * tilingNoise2(p, 5, seed + 1) + 0.005 * tilingNoise2(p, 31, seed + 2);
        const Facet big = facetAt(bent, 6, seed + 3);
        const Facet middle = facetAt(bent + 0.3, 15, seed + 4);
        const Facet small = facetAt(bent, 41, seed + 5);
        const double ridges = tilingRidges(bent, 3, 6, seed + 6);
        // Strata run across the square, broken by the facets.
        const double beds = tilingNoise(glm::dvec2(0.5, bent.y + 0.02 * big.height), 34, seed + 7);
        const double fine = tilingFbm(p, 48, 4, seed + 8);
        const double split =
            (1 - smooth(0, 0.035, middle.crack)) * smooth(0.05, 0.35, tilingFbm(p, 3, 3, seed + 9));
        canvas.relief[i] = 0.50 * big.height + 0.24 * middle.height + 0.07 * small.height + 0.50 * ridges +
                           0.05 * fine + 0.05 * beds - 0.14 * split;
        const double stain =
            smooth(-0.5, 0.7, tilingFbm(bent, 5, 5, seed + 11) + 0.25 * (middle.height - 0.25));
        glm::dvec3 hue = glm::mix(glm::dvec3(0.455, 0.440, 0.425), glm::dvec3(0.475, 0.425, 0.370), stain);
        hue = glm::mix(hue, glm::dvec3(0.56, 0.545, 0.52), 0.45 * smooth(0.35, 0.8, ridges));
        const double light = 0.95 - 0.10 * big.facing - 0.10 * middle.facing - 0.06 * small.facing +
                             0.16 * (middle.height - 0.25) + 0.22 * fine + 0.09 * beds - 0.32 * split;
        canvas.colour[i] = hue * light;
        canvas.rough[i] = 0.80 + 0.12 * fine;
    });
}

void paintSnow(Canvas& canvas, std::uint32_t seed) {
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        const glm::dvec2 bent = p + 0.06 * tilingNoise2(p, 3, seed + 1);
        const double drifts = tilingFbm(bent, 3, 3, seed + 2);
        // Wind carves ridges: long across the square, short along it, with a sharp edge on one side.
        const double carved = tilingNoise(glm::dvec2(bent.x, 3.0 * bent.y), 6, seed + 3) +
                              0.5 * tilingNoise(glm::dvec2(bent.x, 4.0 * bent.y), 13, seed + 4);
        const double edge = std::max(carved, 0.0) * (carved > 0.25 ? 1.0 : smooth(0.0, 0.25, carved));
        const double fine = tilingFbm(p, 40, 4, seed + 5);
        const double sparkle = grain(i, seed + 6);
        canvas.relief[i] = 0.65 * drifts + 0.45 * edge + 0.05 * fine;
        const double light = 0.945 + 0.020 * drifts + 0.030 * (edge - 0.15) + 0.030 * fine + 0.02 * sparkle;
        canvas.colour[i] = glm::mix(glm::dvec3(0.945, 0.965, 0.995), glm::dvec3(0.995, 0.995, 0.990),
                                    smooth(-0.6, 0.6, drifts + edge)) *
                           light;
        canvas.rough[i] = 0.55 + 0.10 * fine + (sparkle > 0.47 ? -0.3 : 0.0);
    });
}

// Paints a pebble or a shell, half sunk.
void paintPebble(Canvas& canvas, Dice& dice, std::uint32_t seed) {
    const glm::dvec2 middle = dice.place();
    const double radius = 0.0035 + 0.013 * std::pow(dice(), 4.0);
    const double squeeze = dice(0.6, 1.0);
    const double turn = dice(0, 2 * pi);
    const glm::dvec3 hue =
        glm::mix(glm::dvec3(0.30, 0.29, 0.26), glm::dvec3(0.62, 0.58, 0.48), std::pow(dice(), 2.0));
    const int reach = static_cast<int>(radius * canvas.size / squeeze) + 1;
    const glm::ivec2 texel(glm::floor(middle * static_cast<double>(canvas.size)));
    const double ground = canvas.relief[canvas.at(texel.x, texel.y)];
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const glm::dvec2 from = glm::dvec2(x, y) / (radius * canvas.size);
            const glm::dvec2 turned(from.x * std::cos(turn) + from.y * std::sin(turn),
                                    (from.y * std::cos(turn) - from.x * std::sin(turn)) * squeeze);
            const double away = glm::dot(turned, turned);
            if (away >= 1) continue;
            const double dome = std::sqrt(1 - away);
            const double z = ground + 9 * radius * dome;
            const std::size_t i = canvas.at(texel.x + x, texel.y + y);
            if (canvas.relief[i] >= z) continue;
            canvas.relief[i] = z;
            canvas.colour[i] = hue * (0.6 + 0.5 * dome + 0.2 * grain(i, seed));
            canvas.rough[i] = 0.6;
        }
    }
}

void paintSeaBed(Canvas& canvas, std::uint32_t seed) {
    canvas.each([&](const glm::dvec2& p, std::size_t i) {
        const glm::dvec2 bent = p + 0.03 * tilingNoise2(p, 4, seed + 1);
        const double bend = 0.8 * tilingFbm(p, 3, 3, seed + 2);
        const double train = ripples(bent, {9, 7}, bend);
        const double across = 0.5 + 0.5 * std::sin(2 * pi * (11 * bent.x - 9 * bent.y + 1.2 * bend));
        const double broad = tilingFbm(p, 2, 4, seed + 3);
        const double fine = tilingFbm(p, 40, 4, seed + 4);
        const double weed = smooth(0.10, 0.50, tilingFbm(p, 4, 5, seed + 5)) *
                            smooth(0.25, 0.7, tilingRidges(bent, 14, 3, seed + 6));
        canvas.relief[i] = 0.30 * train + 0.10 * across + 0.45 * broad + 0.06 * fine + 0.30 * weed;
        const double light = 0.92 + 0.14 * (train - 0.5) + 0.06 * (across - 0.5) + 0.10 * broad + 0.18 * fine;
        const glm::dvec3 mud = glm::mix(glm::dvec3(0.47, 0.45, 0.37), glm::dvec3(0.60, 0.56, 0.44),
                                        smooth(-0.5, 0.6, broad + 0.4 * tilingFbm(p, 6, 3, seed + 7)));
        canvas.colour[i] =
            glm::mix(mud * light, glm::dvec3(0.19, 0.24, 0.14) * (0.9 + 0.6 * fine), 0.6 * weed);
        canvas.rough[i] = 0.75 + 0.1 * fine;
    });
    Dice dice{seed + 30};
    for (int pebble = 0; pebble < 420; ++pebble) paintPebble(canvas, dice, seed + 31);
}

// Returns the mean relief of a square of texels around each, wrapped, to tell hollows from heights.
std::vector<double> blurred(const Canvas& canvas, int reach) {
    const auto pass = [&](const std::vector<double>& from, bool alongX) {
        std::vector<double> to(from.size());
        for (int y = 0; y < canvas.size; ++y) {
            double sum = 0;
            const auto texel = [&](int step) { return alongX ? canvas.at(step, y) : canvas.at(y, step); };
            for (int step = -reach; step <= reach; ++step) sum += from[texel(step)];
            for (int x = 0; x < canvas.size; ++x) {
                to[texel(x)] = sum / (2 * reach + 1);
                sum += from[texel(x + reach + 1)] - from[texel(x - reach)];
            }
        }
        return to;
    };
    return pass(pass(canvas.relief, true), false);
}

// The parameters for turning a material's relief into textures.
struct Finish {
    double height = 0.03;      // of the whole relief, in sides of the texture
    double hollow = 0.3;       // strength with which hollows are darkened
    double hollowSize = 0.02;  // in sides
};

// Quantises to steps from 128: noise hides the steps, and files are a third smaller.
std::uint8_t byteOf(double share, int step) {
    const long steps = std::lround((255 * share - 128) / step);
    return static_cast<std::uint8_t>(std::clamp(128 + steps * step, 0L, 255L));
}

// Scales the relief to [0, 1].
void spreadRelief(Canvas& canvas) {
    const auto [least, most] = std::minmax_element(canvas.relief.begin(), canvas.relief.end());
    const double from = *least;
    const double range = std::max(*most - from, 1e-9);
    for (double& relief : canvas.relief) relief = (relief - from) / range;
}

MaterialMaps finished(Canvas& canvas, const Finish& finish) {
    spreadRelief(canvas);
    const std::vector<double> around =
        blurred(canvas, std::max(static_cast<int>(finish.hollowSize * canvas.size), 1));
    MaterialMaps maps;
    maps.size = canvas.size;
    maps.albedo.reserve(4 * canvas.relief.size());
    maps.normal.reserve(3 * canvas.relief.size());
    maps.roughness.reserve(canvas.relief.size());
    const double perSide = 0.5 * finish.height * canvas.size;
    for (int y = 0; y < canvas.size; ++y) {
        for (int x = 0; x < canvas.size; ++x) {
            const std::size_t i = canvas.at(x, y);
            const double open = std::clamp(1 + finish.hollow * 4 * (canvas.relief[i] - around[i]), 0.4, 1.25);
            for (int c = 0; c < 3; ++c) maps.albedo.push_back(byteOf(canvas.colour[i][c] * open, 2));
            maps.albedo.push_back(byteOf(canvas.relief[i], 4));
            const double along =
                perSide * (canvas.relief[canvas.at(x + 1, y)] - canvas.relief[canvas.at(x - 1, y)]);
            const double down =
                perSide * (canvas.relief[canvas.at(x, y + 1)] - canvas.relief[canvas.at(x, y - 1)]);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-along, down, 1));
            for (int c = 0; c < 3; ++c) maps.normal.push_back(byteOf((normal[c] * 127 + 128) / 255, 4));
            maps.roughness.push_back(byteOf(canvas.rough[i], 8));
        }
    }
    return maps;
}

}  // namespace

MaterialMaps makeMaterial(Material material, int size, std::uint32_t seed) {
    assert(size >= 16 && size <= 4096 && (size & (size - 1)) == 0);
    Canvas canvas(size);
    const std::uint32_t own = tilingHash(static_cast<std::uint32_t>(material), 0, seed);
    switch (material) {
        case Material::Sand:
            paintSand(canvas, own);
            return finished(canvas, {0.035, 0.25, 0.02});
        case Material::Grass:
            paintGrass(canvas, own);
            return finished(canvas, {0.03, 0.35, 0.02});
        case Material::Forest:
            paintForest(canvas, own);
            return finished(canvas, {0.10, 0.6, 0.03});
        case Material::Rock:
            paintRock(canvas, own);
            return finished(canvas, {0.12, 0.45, 0.03});
        case Material::Snow:
            paintSnow(canvas, own);
            return finished(canvas, {0.035, 0.08, 0.04});
        case Material::SeaBed:
            paintSeaBed(canvas, own);
            break;
    }
    return finished(canvas, {0.04, 0.35, 0.02});
}

}  // namespace planet
