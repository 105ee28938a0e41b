// The state of a colour clipmap as plain data. It contains no GL, since embedding programs include it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/surface/colour_clipmap.h"

namespace planet::gl {

struct ColourClipmapState {
    ClipmapLayout layout;
    // The windows that are not empty, of the levels that are not kept whole, face by face.
    struct Window {
        Face face = Face::PosX;
        int level = 0;
        TexelRect texels;
    };
    std::vector<Window> windows;
    std::vector<ClipmapUpdate> updates;  // of the last move
    std::int64_t updatedTexels = 0;      // in the last move
    std::size_t baseBytes = 0;           // on the GPU: the levels that are kept whole
    std::size_t stackBytes = 0;          // on the GPU: the windows

    std::size_t bytes() const { return baseBytes + stackBytes; }
};

}  // namespace planet::gl
