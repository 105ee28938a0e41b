// Compares six cube faces along the 12 edges of the cube. The outermost samples of a face lie on the edges,
// so both faces of an edge have the same samples there. Internal to the library.
#pragma once

#include <array>
#include <string>

#include "planet/base/result.h"
#include "planet/raster/height_raster.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// The outermost samples of the faces, and how to compare them.
struct FaceLines {
    int size = 0;             // samples per side, >= 2
    bool hasMissing = false;  // samples equal to `fill` may be missing and agree with any value
    float fill = 0;
};

// Both functions read the outermost samples of all faces, in the order of allFaces, on any thread. stem: of
// the files' names, for messages.

// Checks that the faces agree. The Error names the two faces and sides that differ most, the difference in
// metres and its place, and the number of edges with differences. Differences up to toleranceM count as
// rounding.
Result<void> checkHeightEdges(const std::array<HeightRaster, faceCount>& faces, const FaceLines& lines,
                              const std::string& stem, double toleranceM);

// The edges with visible seams: more than a tenth of their samples differ by more than 0.1, in linear light
// clamped to [0, 1].
struct ColourSeams {
    int edges = 0;
    std::string notice{};  // names the two faces and sides that differ most; empty if there are no seams
};
Result<ColourSeams> findColourSeams(const std::array<HeightRaster, faceCount>& faces, const FaceLines& lines,
                                    const std::string& stem);

}  // namespace planet
