// Compares six cube faces along the 12 edges of the cube. The outermost samples of a face lie on the edges,
// so both faces of an edge hold the same samples there. Internal to the library.
#pragma once

#include <array>
#include <string>

#include "planet/base/result.h"
#include "planet/source/height_raster.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

struct FaceEdgeCheck {
    std::string stem;         // of the files' names, for the message
    int size = 0;             // samples a side, at least 2
    double toleranceM = 0;    // differences up to this are rounding
    bool hasMissing = false;  // samples of height fillM may be missing ones, which agree with anything
    float fillM = 0;
};

// Reads the outermost samples of all faces, in the order of allFaces. The Error names the two faces and sides
// that differ most, by how many metres and where, and on how many edges there are differences. Any thread.
Result<void> checkFaceEdges(const std::array<HeightRaster, faceCount>& faces, const FaceEdgeCheck& check);

}  // namespace planet
