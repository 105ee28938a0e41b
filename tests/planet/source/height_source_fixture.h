// What the tests of the height sources share: files written for them, and ways to sample.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {

using tests::TemporaryFolder;

template <class T>
struct Image {
    int width = 0;
    int height = 0;
    std::vector<T> samples;

    Image(int imageWidth, int imageHeight, const std::function<double(int column, int row)>& value)
        : width(imageWidth), height(imageHeight) {
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                samples.push_back(static_cast<T>(value(column, row)));
            }
        }
    }
};

struct Layout {
    int tile = 0;  // samples a side; 0 for rows
    int channels = 1;
    int bitsPerSample = 0;  // 0: the type's own
    bool asHalf = false;    // floats stored as halves
};

// OpenImageIO is not built for ThreadSanitizer, which would report the queue of its thread pool.
inline const bool imagesUseOneThread = OIIO::attribute("threads", 1);

template <class T>
constexpr OIIO::TypeDesc imageType() {
    if constexpr (std::is_same_v<T, std::int8_t>)
        return OIIO::TypeDesc::INT8;
    else
        return OIIO::BaseTypeFromC<T>::value;
}

// Channels beyond the first repeat it.
template <class T>
void writeImage(const std::filesystem::path& path, const Image<T>& image, const Layout& layout = {}) {
    const auto out = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(out) << OIIO::geterror();
    OIIO::ImageSpec spec(image.width, image.height, layout.channels,
                         layout.asHalf ? OIIO::TypeDesc(OIIO::TypeDesc::HALF) : imageType<T>());
    if (layout.channels == 2) {
        spec.channelnames = {"Y", "A"};
        spec.alpha_channel = 1;
    }
    if (layout.bitsPerSample != 0) spec.attribute("oiio:BitsPerSample", layout.bitsPerSample);
    spec.attribute("compression", "zip");
    spec.tile_width = spec.tile_height = layout.tile;
    if (layout.tile > 0) spec.tile_depth = 1;
    std::vector<T> samples;
    for (const T sample : image.samples) {
        samples.insert(samples.end(), static_cast<std::size_t>(layout.channels), sample);
    }
    ASSERT_TRUE(out->open(path.string(), spec)) << out->geterror();
    ASSERT_TRUE(out->write_image(imageType<T>(), samples.data())) << out->geterror();
    ASSERT_TRUE(out->close()) << out->geterror();
}

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

inline HeightSource mustOpen(const std::filesystem::path& path, const HeightSourceSettings& settings = {}) {
    Result<HeightSource> source = openHeightSource(path, settings);
    if (!source) throw std::runtime_error(source.error().message);
    return *source;
}

inline std::string errorOf(const std::filesystem::path& path, const HeightSourceSettings& settings = {}) {
    const Result<HeightSource> source = openHeightSource(path, settings);
    return source ? "opened" : source.error().message;
}

inline std::string colourErrorOf(const std::filesystem::path& path) {
    const Result<ColourSource> source = openColourSource(path);
    return source ? "opened" : source.error().message;
}

inline std::vector<float> sampled(const HeightSource& source, const SampleTile& tile) {
    std::vector<float> out(static_cast<std::size_t>(tile.columns) * static_cast<std::size_t>(tile.rows));
    const Result<void> done = source.sample(tile, out);
    if (!done) throw std::runtime_error(done.error().message);
    return out;
}

inline float sampledAt(const HeightSource& source, Face face, int faceCells, int column, int row) {
    return sampled(source, {face, faceCells, column, row, 1, 1})[0];
}

inline std::vector<float> sampledFace(const HeightSource& source, Face face, int faceCells) {
    return sampled(source, {face, faceCells, 0, 0, faceCells + 1, faceCells + 1});
}

// The grid's sample nearest to a place.
inline SampleTile tileNear(int faceCells, double latitudeDeg, double longitudeDeg) {
    const double rad = 3.14159265358979323846 / 180;
    const FacePoint point =
        facePointFromDirection(directionFromGeographic({latitudeDeg * rad, longitudeDeg * rad}));
    return {point.face,
            faceCells,
            static_cast<int>(std::lround((point.u + 1) / 2 * faceCells)),
            static_cast<int>(std::lround((point.v + 1) / 2 * faceCells)),
            1,
            1};
}

inline float sampledNear(const HeightSource& source, int faceCells, double latitudeDeg, double longitudeDeg) {
    return sampled(source, tileNear(faceCells, latitudeDeg, longitudeDeg))[0];
}

// The direction of a sample of a grid.
inline glm::dvec3 directionAt(Face face, int faceCells, int column, int row) {
    return sphereFromCube(cubePoint(face, 2.0 * column / faceCells - 1, 2.0 * row / faceCells - 1));
}

// The largest distance between a source's samples of a whole grid and a field of the sphere.
inline double largestError(const HeightSource& source, int faceCells,
                           const std::function<double(const glm::dvec3&)>& field) {
    double largest = 0;
    for (const Face face : allFaces) {
        const std::vector<float> heights = sampledFace(source, face, faceCells);
        std::size_t at = 0;
        for (int row = 0; row <= faceCells; ++row) {
            for (int column = 0; column <= faceCells; ++column) {
                const double exact = field(directionAt(face, faceCells, column, row));
                largest = std::max(largest, std::abs(double(heights[at++]) - exact));
            }
        }
    }
    return largest;
}

// Samples whole faces and counts the cube points asked through two faces or more, and those of them whose
// heights differ in any bit.
struct SharedPoints {
    int shared = 0;
    int different = 0;
};
inline SharedPoints sharedPoints(const HeightSource& source, int faceCells) {
    std::map<std::tuple<int, int, int>, std::vector<std::uint32_t>> bitsAt;
    for (const Face face : allFaces) {
        const std::vector<float> heights = sampledFace(source, face, faceCells);
        std::size_t at = 0;
        for (int row = 0; row <= faceCells; ++row) {
            for (int column = 0; column <= faceCells; ++column) {
                const glm::dvec3 p =
                    cubePoint(face, 2.0 * column / faceCells - 1, 2.0 * row / faceCells - 1) *
                    double(faceCells);
                bitsAt[{int(p.x), int(p.y), int(p.z)}].push_back(std::bit_cast<std::uint32_t>(heights[at++]));
            }
        }
    }
    SharedPoints points;
    for (const auto& [place, bits] : bitsAt) {
        if (bits.size() < 2) continue;
        ++points.shared;
        for (const std::uint32_t other : bits) {
            if (other == bits[0]) continue;
            ++points.different;
            break;
        }
    }
    return points;
}
constexpr int pointsOnEdges(int faceCells) {
    return 12 * (faceCells - 1) + 8;
}

// Whether random tiles of a face have the very bits of the whole face.
inline void expectTilesAgree(const HeightSource& source, int faceCells, int tiles) {
    std::mt19937 random(7);
    for (const Face face : allFaces) {
        const std::vector<float> whole = sampledFace(source, face, faceCells);
        for (int i = 0; i < tiles; ++i) {
            std::uniform_int_distribution<int> place(0, faceCells);
            SampleTile tile{face, faceCells, place(random), place(random), 0, 0};
            tile.columns = std::uniform_int_distribution<int>(1, faceCells + 1 - tile.firstColumn)(random);
            tile.rows = std::uniform_int_distribution<int>(1, faceCells + 1 - tile.firstRow)(random);
            const std::vector<float> part = sampled(source, tile);
            for (int row = 0; row < tile.rows; ++row) {
                for (int column = 0; column < tile.columns; ++column) {
                    const std::size_t inWhole = static_cast<std::size_t>(
                        (tile.firstRow + row) * (faceCells + 1) + tile.firstColumn + column);
                    const std::size_t inPart = static_cast<std::size_t>(row * tile.columns + column);
                    ASSERT_EQ(std::bit_cast<std::uint32_t>(part[inPart]),
                              std::bit_cast<std::uint32_t>(whole[inWhole]))
                        << faceName(face) << " column " << tile.firstColumn + column << " row "
                        << tile.firstRow + row;
                }
            }
        }
    }
}

// Noise in [0, most), the same at every call for a place.
inline double noise(int column, int row, double most) {
    std::uint32_t h =
        static_cast<std::uint32_t>(column) * 0x9E3779B1u ^ static_cast<std::uint32_t>(row) * 0x85EBCA77u;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return most * ((h ^ (h >> 15)) >> 8) / (1 << 24);
}

// A sum of spherical harmonics up to degree 3; within +-3000.
inline double smoothField(const glm::dvec3& d) {
    return 800 * d.x * d.y + 500 * d.z * (5 * d.z * d.z - 3) + 600 * d.x - 400 * d.y * d.z + 300;
}

}  // namespace planet
