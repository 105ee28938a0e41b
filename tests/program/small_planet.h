// A small elevation image, and a chunk file baked from it by the program itself.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "tests/program/run_program.h"

namespace worldy {

inline constexpr int hillsWidth = 256;
inline constexpr int hillsHeight = 128;

// A plain grey image of hills, equirectangular: a value of 0 to 200 at each pixel.
inline int hillAt(int column, int row) {
    const double x = 2 * 3.14159265358979 * column / hillsWidth, y = 3.14159265358979 * row / hillsHeight;
    return static_cast<int>(100 + 100 * std::sin(6 * x) * std::sin(y) * std::cos(5 * y));
}

inline std::filesystem::path writeHills(const TemporaryFolder& folder) {
    const std::filesystem::path file = folder.path() / "hills.pgm";
    std::ofstream stream(file, std::ios::binary);
    stream << "P5\n" << hillsWidth << " " << hillsHeight << "\n255\n";
    for (int row = 0; row < hillsHeight; ++row) {
        for (int column = 0; column < hillsWidth; ++column)
            stream.put(static_cast<char>(hillAt(column, row)));
    }
    return file;
}

// Writes hills.pgm and planet.chk, a small planet with mountains that show. The program bakes it once for all tests.
inline void bakePlanet(const TemporaryFolder& folder) {
    static const std::string planet = [] {
        const TemporaryFolder once;
        writeHills(once);
        const Ran baked = runWorldy(
            once, "bake hills.pgm -o planet.chk --chunk-size 17 --radius 100000 --metres-per-unit 20");
        EXPECT_EQ(baked.exitCode, 0) << baked.errors;
        return contentOf(once.path() / "planet.chk");
    }();
    ASSERT_NE(planet, "");
    writeHills(folder);
    std::ofstream(folder.path() / "planet.chk", std::ios::binary) << planet;
}

}  // namespace worldy
