// Compares six cube faces along the 12 edges of the cube. The outermost samples of a face lie on the edges,
// so both faces of an edge hold the same samples there. Internal to the library.
#pragma once

#include <array>
#include <string>

#include "planet/base/result.h"
#include "planet/source/height_raster.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// The outermost samples of the faces and their comparison.
struct FaceLines {
    int size = 0;             // samples a side, at least 2
    bool hasMissing = false;  // samples of value fill may be missing ones, which agree with anything
    float fill = 0;
};

// Both functions read the outermost samples of all faces, given in the order of allFaces, on any thread.
// stem: that of the files' names, for messages.

// The Error names the two faces and sides that differ most, by how many metres and where, and on how many
// edges there are differences. Differences up to toleranceM are rounding.
Result<void> checkHeightEdges(const std::array<HeightRaster, faceCount>& faces, const FaceLines& lines,
                              const std::string& stem, double toleranceM);

// The edges along which a seam is visible: more than a tenth of their samples differ by more than 0.1, in
// linear light clamped to [0, 1].
struct ColourSeams {
    int edges = 0;
    std::string notice{};  // names the two faces and sides that differ most; empty if there is no such edge
};
Result<ColourSeams> findColourSeams(const std::array<HeightRaster, faceCount>& faces, const FaceLines& lines,
                                    const std::string& stem);

}  // namespace planet
