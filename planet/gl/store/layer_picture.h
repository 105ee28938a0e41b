// A picture of a texture layer in the renderer's input format.
#pragma once

#include <cstdint>
#include <vector>

namespace planet::gl {

// size x size texels, row 0 at the top.
struct LayerPicture {
    std::vector<std::uint8_t> albedo;   // RGBA: sRGB and relief
    std::vector<std::uint8_t> surface;  // RGBA: the normal's x and y, 128 is 0; roughness; unused
};

}  // namespace planet::gl
