// Colour faces that disagree along every edge of the cube.
#pragma once

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace tests {

// Writes grey_x_pos.pgm and so on, 9 x 9 pixels: six faces, each of one grey of its own.
inline void writeGreyFaces(const TemporaryFolder& folder) {
    int grey = 0;
    for (const char* face : {"x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg"}) {
        std::ofstream stream(folder.path() / (std::string("grey_") + face + ".pgm"), std::ios::binary);
        stream << "P5\n9 9\n255\n" << std::string(9 * 9, static_cast<char>(grey));
        grey += 51;
    }
}

}  // namespace tests
