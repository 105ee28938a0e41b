// Colour sources made of a formula, and colour images written to files, for tests.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "planet/source/colour_source.h"

namespace planet::test {

// A source whose colour, in linear light, is a function of the direction alone.
inline ColourSource formulaColours(std::function<glm::dvec3(const glm::dvec3& direction)> colour,
                                   int naturalFaceSize = 513) {
    ColourSource source;
    source.description = "formula";
    source.naturalFaceSize = naturalFaceSize;
    source.sample = [colour = std::move(colour)](const SampleTile& tile,
                                                 std::span<glm::vec3> out) -> Result<void> {
        std::size_t at = 0;
        for (int j = 0; j < tile.rows; ++j) {
            for (int i = 0; i < tile.columns; ++i) {
                const double u = 2.0 * (tile.firstColumn + i) / tile.faceCells - 1;
                const double v = 2.0 * (tile.firstRow + j) / tile.faceCells - 1;
                out[at++] = glm::vec3(colour(sphereFromCube(cubePoint(tile.face, u, v))));
            }
        }
        return {};
    };
    return source;
}

// Patches, coasts and grain, with hard and soft edges.
inline glm::dvec3 mottled(const glm::dvec3& d) {
    const double land = std::sin(5 * d.x + 2 * std::sin(3 * d.y)) * std::cos(4 * d.z) > 0.1 ? 1 : 0;
    const double grain = 0.5 + 0.25 * std::sin(91 * d.x + 37 * d.z) + 0.25 * std::sin(83 * d.y);
    return land * glm::dvec3(0.25, 0.35, 0.08) * (0.4 + grain) +
           (1 - land) * glm::dvec3(0.01, 0.04, 0.13) * (0.8 + 0.4 * grain);
}
inline ColourSource mottledColours(int naturalFaceSize = 513) {
    return formulaColours(mottled, naturalFaceSize);
}

// An image whose samples are a function of column, row and channel, in the type's own units.
template <class T>
void writeColours(const std::filesystem::path& path, int width, int height, int channels,
                  const std::function<double(int column, int row, int channel)>& value, int tileSide = 0) {
    std::vector<T> samples;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            for (int channel = 0; channel < channels; ++channel)
                samples.push_back(static_cast<T>(value(column, row, channel)));
        }
    }
    const auto out = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(out) << OIIO::geterror();
    const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.tile_width = spec.tile_height = tileSide;
    if (tileSide > 0) spec.tile_depth = 1;
    ASSERT_TRUE(out->open(path.string(), spec)) << out->geterror();
    ASSERT_TRUE(out->write_image(type, samples.data())) << out->geterror();
    ASSERT_TRUE(out->close()) << out->geterror();
}

}  // namespace planet::test
