#include "planet/source/height_face_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "planet/sphere/face_fold.h"

namespace planet {

namespace {

constexpr int cubeEdgeCount = 12;

// One edge of the cube, as the end points of its samples on two faces. Sample k lies k / (size - 1) of the
// way from first to last on both.
struct SharedEdge {
    std::array<FaceGridPoint, 2> first;
    std::array<FaceGridPoint, 2> last;
};

// The edges between each face and those later in enum order.
std::vector<SharedEdge> sharedEdges(int cells) {
    std::vector<SharedEdge> edges;
    for (const Face face : allFaces) {
        const FaceAxes& axes = faceAxes(face);
        const auto add = [&](const glm::dvec3& outward, const FaceGridPoint& first,
                             const FaceGridPoint& last) {
            const Face next = faceAlong(outward);
            if (next < face) return;
            edges.push_back(
                {{first, placeOnFace(next, first, cells)}, {last, placeOnFace(next, last, cells)}});
        };
        add(-axes.u, {face, 0, 0}, {face, 0, cells});
        add(axes.u, {face, cells, 0}, {face, cells, cells});
        add(-axes.v, {face, 0, 0}, {face, cells, 0});
        add(axes.v, {face, 0, cells}, {face, cells, cells});
    }
    return edges;
}

// The samples from first to last, which share a column or a row. Rows of the grid rise, those of the image
// fall.
Result<std::vector<float>> readLine(const HeightRaster& raster, const FaceGridPoint& first,
                                    const FaceGridPoint& last, int cells) {
    const RasterRect rect{std::min(first.column, last.column), cells - std::max(first.row, last.row),
                          std::abs(first.column - last.column) + 1, std::abs(first.row - last.row) + 1};
    std::vector<float> heights(static_cast<std::size_t>(cells) + 1);
    const auto read = raster.read(rect, heights.data(), static_cast<std::size_t>(rect.width));
    if (!read) return tl::unexpected(read.error());
    if (first.column > last.column || first.row < last.row) std::reverse(heights.begin(), heights.end());
    return heights;
}

std::string_view sideName(const FaceGridPoint& first, const FaceGridPoint& last, int cells) {
    if (first.column == last.column) return first.column == 0 ? "left column" : "right column";
    return first.row == cells ? "top row" : "bottom row";
}

struct EdgeDifference {
    SharedEdge edge;
    double largestM = 0;
    std::array<float, 2> heightsM{};  // where it is largest
    int at = 0;                       // that sample, from the edge's first
    int samples = 0;                  // that differ by more than the tolerance
};

Result<EdgeDifference> differenceAlong(const std::array<HeightRaster, faceCount>& faces,
                                       const SharedEdge& edge, const FaceEdgeCheck& check) {
    std::array<std::vector<float>, 2> lines;
    for (std::size_t i = 0; i < 2; ++i) {
        const HeightRaster& raster = faces[static_cast<std::size_t>(edge.first[i].face)];
        Result<std::vector<float>> line = readLine(raster, edge.first[i], edge.last[i], check.size - 1);
        if (!line) return tl::unexpected(std::move(line.error()));
        lines[i] = *std::move(line);
    }
    EdgeDifference difference{edge};
    for (std::size_t i = 0; i < lines[0].size(); ++i) {
        const std::array heights{lines[0][i], lines[1][i]};
        if (check.hasMissing && (heights[0] == check.fillM || heights[1] == check.fillM)) continue;
        const double apart = std::abs(static_cast<double>(heights[0]) - static_cast<double>(heights[1]));
        if (apart > check.toleranceM) ++difference.samples;
        if (apart <= difference.largestM) continue;
        difference.largestM = apart;
        difference.heightsM = heights;
        difference.at = static_cast<int>(i);
    }
    return difference;
}

Error edgeError(const EdgeDifference& worst, int edges, const FaceEdgeCheck& check) {
    const SharedEdge& edge = worst.edge;
    const int cells = check.size - 1;
    const FaceGridPoint& first = edge.first[0];
    const FaceGridPoint& last = edge.last[0];
    const bool alongColumn = first.column == last.column;
    const int place = alongColumn ? cells - (first.row + worst.at) : first.column + worst.at;
    return {
        ErrorKind::BadInput,
        fmt::format(
            "{}: faces {} and {} differ by up to {:.6g} m along their shared edge, the {} of {} and the {} "
            "of {}: {:.6g} m and {:.6g} m at {} {} of {}; {} of {} samples there and {} of {} edges "
            "differ; expected the same heights on both faces, to {:.6g} m. The outermost samples of a face "
            "lie on the cube's edges, so neighbours repeat them: check the faces' names, orientation, "
            "sample type and byte order, and resample faces whose samples lie at pixel centres",
            check.stem, faceName(first.face), faceName(edge.first[1].face), worst.largestM,
            sideName(first, last, cells), faceName(first.face), sideName(edge.first[1], edge.last[1], cells),
            faceName(edge.first[1].face), worst.heightsM[0], worst.heightsM[1],
            alongColumn ? "row" : "column", place, faceName(first.face), worst.samples, check.size, edges,
            cubeEdgeCount, check.toleranceM)};
}

}  // namespace

Result<void> checkFaceEdges(const std::array<HeightRaster, faceCount>& faces, const FaceEdgeCheck& check) {
    EdgeDifference worst;
    int edges = 0;
    for (const SharedEdge& edge : sharedEdges(check.size - 1)) {
        const Result<EdgeDifference> difference = differenceAlong(faces, edge, check);
        if (!difference) return tl::unexpected(difference.error());
        if (difference->samples == 0) continue;
        ++edges;
        if (difference->largestM > worst.largestM) worst = *difference;
    }
    if (edges == 0) return {};
    return tl::unexpected(edgeError(worst, edges, check));
}

}  // namespace planet
