// Colour sources made of a formula, and colour images written to files, for tests.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "planet/source/colour_source.h"

namespace planet::test {

// A source whose colour, in linear light, is a function of the direction alone.
ColourSource formulaColours(std::function<glm::dvec3(const glm::dvec3& direction)> colour,
                            int naturalFaceSize = 513);

// Patches, coasts and grain, with hard and soft edges.
glm::dvec3 mottled(const glm::dvec3& d);
ColourSource mottledColours(int naturalFaceSize = 513);

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
