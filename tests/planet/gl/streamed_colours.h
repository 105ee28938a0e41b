// Bare level ground in streamed colours: tiles made of a formula, brought to the renderer as paging would.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "planet/bake/colour_tile_sampling.h"
#include "planet/gl/store/tile_pool.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"
#include "tests/support/synthetic_colours.h"

namespace planet::gl {

inline constexpr int leaf = 2;  // of the colours' quadtree

inline glm::dvec3 smoothColour(const glm::dvec3& d) {
    return {0.35 + 0.25 * std::sin(4 * d.x + d.z), 0.35 + 0.25 * std::sin(5 * d.y),
            0.35 + 0.25 * std::cos(3 * d.z)};
}

inline int srgb(double linear) {
    const double value = std::clamp(linear, 0.0, 1.0);
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255 * encoded));
}

// Bare level ground, drawn in the streamed colours alone.
class StreamedColours : public GlTest {
protected:
    StreamedColours() : planet_({}, 24) {
        settings_.lighting = false;
        settings_.atmosphere = false;
        settings_.sea = false;
        planet_.addLevel(1, [](const glm::dvec3&) { return 0.0; });
    }

    void useFormat(ColourFormat format) {
        format_ = format;
        const Result<void> made =
            planet_.renderer().setColours(ColourPoolConfig{format, leaf, static_cast<std::uint32_t>(6 * 21)});
        ASSERT_TRUE(made) << made.error().message;
        slot_ = 0;
        TileChange reset;
        reset.resets = true;
        planet_.renderer().followColours({&reset, 1});
    }

    TileData tileOf(const ColourSource& source, const ChunkId& id) const {
        std::vector<std::uint8_t> rgb(colourTileBytes(ColourFormat::Lossless));
        EXPECT_TRUE(sampleColourTile(source, id, rgb));
        return {id, {}, colourTexels(format_, rgb)};
    }
    TileData plainTile(const ChunkId& id, const glm::ivec3& colour) const {
        std::vector<std::uint8_t> rgb;
        for (std::size_t i = 0; i < colourTileBytes(ColourFormat::Lossless) / 3; ++i)
            for (int channel = 0; channel < 3; ++channel)
                rgb.push_back(static_cast<std::uint8_t>(colour[channel]));
        return {id, {}, colourTexels(format_, rgb)};
    }

    template <class MakeTile>
    void addRoots(const MakeTile& make) {
        for (const Face face : allFaces) {
            TileChange change;
            change.firstSlot = slot_++;
            change.arrived = {make(ChunkId{face, 0, 0, 0})};
            planet_.renderer().followColours({&change, 1});
        }
    }
    template <class MakeTile>
    void addChildren(const ChunkId& parent, const MakeTile& make) {
        TileChange change;
        change.firstSlot = slot_;
        slot_ += quadrantCount;
        for (int q = 0; q < quadrantCount; ++q) change.arrived.push_back(make(childOf(parent, q)));
        planet_.renderer().followColours({&change, 1});
    }
    void removeChildren(const ChunkId& parent) {
        TileChange change;
        change.gone = parent;
        planet_.renderer().followColours({&change, 1});
    }
    template <class MakeTile>
    void addAll(const MakeTile& make) {
        addRoots(make);
        for (int level = 0; level < leaf; ++level) {
            for (const Face face : allFaces) {
                for (std::uint32_t y = 0; y < 1u << level; ++y) {
                    for (std::uint32_t x = 0; x < 1u << level; ++x)
                        addChildren({face, static_cast<std::uint8_t>(level), x, y}, make);
                }
            }
        }
    }

    Picture drawn(const View& view) {
        return drawPicture(planet_.renderer(), view, planet_.items(), settings_);
    }

    // Of the middle pixel, from straight above.
    glm::ivec3 colourFrom(double altitudeM, double latitudeDeg = 5, double longitudeDeg = 5) {
        return drawn(viewFrom({}, latitudeDeg, longitudeDeg, altitudeM, -90, 0, 33, 33)).at(16, 16);
    }

    TestPlanet planet_;
    RenderSettings settings_;
    ColourFormat format_ = ColourFormat::Lossless;
    std::uint32_t slot_ = 0;
};

// The direction of the ground at a pixel, row 0 at the top; none beside the planet.
inline std::optional<glm::dvec3> groundAt(const View& view, int column, int row) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double x = tanX * (2 * (column + 0.5) / view.widthPx - 1);
    const double y = tanX * (view.heightPx - 2 * (row + 0.5)) / view.widthPx;
    const glm::dvec3 ray = glm::normalize(-view.back + x * view.right + y * view.up);
    const double radiusM = PlanetShape().radiusM;
    const double along = glm::dot(ray, view.eyeM);
    const double under = along * along - glm::dot(view.eyeM, view.eyeM) + radiusM * radiusM;
    if (under < 0.02 * radiusM * radiusM) return std::nullopt;  // not at the limb
    return glm::normalize(view.eyeM + (-along - std::sqrt(under)) * ray);
}

// What is drawn of land: a fifth lighter than the image.
inline int furthestFromSource(const Picture& picture, const View& view) {
    int furthest = 0;
    for (int row = 0; row < view.heightPx; ++row) {
        for (int column = 0; column < view.widthPx; ++column) {
            const auto ground = groundAt(view, column, row);
            if (!ground) continue;
            const glm::dvec3 expected = 1.2 * smoothColour(*ground);
            const glm::ivec3 seen = picture.at(column, row);
            for (int channel = 0; channel < 3; ++channel)
                furthest = std::max(furthest, std::abs(seen[channel] - srgb(expected[channel])));
        }
    }
    return furthest;
}

}  // namespace planet::gl
