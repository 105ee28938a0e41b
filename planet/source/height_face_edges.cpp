#include "planet/source/height_face_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "planet/base/try.h"
#include "planet/sphere/face_fold.h"

namespace planet {

namespace {

constexpr int cubeEdgeCount = 12;

// An edge of the cube, as the end points of its samples on two faces. Sample k lies at k / (size - 1) of the
// way from first to last on both.
struct SharedEdge {
    std::array<FaceGridPoint, 2> first;
    std::array<FaceGridPoint, 2> last;
};

// Returns the edges between each face and those later in enum order.
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

// Reads the samples from first to last, which share a column or a row. Rows of the grid run upwards, those of
// the image downwards.
Result<std::vector<float>> readLine(const HeightRaster& raster, const FaceGridPoint& first,
                                    const FaceGridPoint& last, int cells) {
    const RasterRect rect{std::min(first.column, last.column), cells - std::max(first.row, last.row),
                          std::abs(first.column - last.column) + 1, std::abs(first.row - last.row) + 1};
    std::vector<float> heights(static_cast<std::size_t>(cells) + 1);
    TRY(raster.read(rect, heights.data(), static_cast<std::size_t>(rect.width)));
    if (first.column > last.column || first.row < last.row) std::reverse(heights.begin(), heights.end());
    return heights;
}

std::string_view sideName(const FaceGridPoint& first, const FaceGridPoint& last, int cells) {
    if (first.column == last.column) return first.column == 0 ? "left column" : "right column";
    return first.row == cells ? "top row" : "bottom row";
}

struct EdgeDifference {
    SharedEdge edge;
    double largest = 0;
    std::array<float, 2> values{};  // where the difference is largest
    int at = 0;                     // index of that sample, from the edge's first
    int samples = 0;                // number of samples that differ by more than the tolerance
};

// Values are compared after a clamp to [least, most].
struct Comparison {
    double tolerance = 0;
    float least = -std::numeric_limits<float>::infinity();
    float most = std::numeric_limits<float>::infinity();
};

Result<EdgeDifference> differenceAlong(const std::array<HeightRaster, faceCount>& faces,
                                       const SharedEdge& edge, const FaceLines& lines,
                                       const Comparison& comparison) {
    std::array<std::vector<float>, 2> both;
    for (std::size_t i = 0; i < 2; ++i) {
        const HeightRaster& raster = faces[static_cast<std::size_t>(edge.first[i].face)];
        TRY_ASSIGN(both[i], readLine(raster, edge.first[i], edge.last[i], lines.size - 1));
    }
    EdgeDifference difference{edge};
    const auto clamped = [&](float value) { return std::clamp(value, comparison.least, comparison.most); };
    for (std::size_t i = 0; i < both[0].size(); ++i) {
        if (lines.hasMissing && (both[0][i] == lines.fill || both[1][i] == lines.fill)) continue;
        const std::array values{clamped(both[0][i]), clamped(both[1][i])};
        const double apart = std::abs(static_cast<double>(values[0]) - static_cast<double>(values[1]));
        if (apart > comparison.tolerance) ++difference.samples;
        if (apart <= difference.largest) continue;
        difference.largest = apart;
        difference.values = values;
        difference.at = static_cast<int>(i);
    }
    return difference;
}

// Returns the differences along all edges of the cube.
Result<std::vector<EdgeDifference>> differencesOf(const std::array<HeightRaster, faceCount>& faces,
                                                  const FaceLines& lines, const Comparison& comparison) {
    std::vector<EdgeDifference> differences;
    for (const SharedEdge& edge : sharedEdges(lines.size - 1)) {
        TRY_ASSIGN(auto difference, differenceAlong(faces, edge, lines, comparison));
        differences.push_back(difference);
    }
    return differences;
}

// Returns for example "the right column of x_pos and the left column of y_pos".
std::string sidesText(const SharedEdge& edge, int cells) {
    return fmt::format("the {} of {} and the {} of {}", sideName(edge.first[0], edge.last[0], cells),
                       faceName(edge.first[0].face), sideName(edge.first[1], edge.last[1], cells),
                       faceName(edge.first[1].face));
}

Error heightError(const EdgeDifference& worst, std::size_t edges, const FaceLines& lines,
                  const std::string& stem, double toleranceM) {
    const int cells = lines.size - 1;
    const FaceGridPoint& first = worst.edge.first[0];
    const bool alongColumn = first.column == worst.edge.last[0].column;
    const int place = alongColumn ? cells - (first.row + worst.at) : first.column + worst.at;
    return {
        ErrorKind::BadInput,
        fmt::format(
            "{}: faces {} and {} differ by up to {:.6g} m along their shared edge, {}: {:.6g} m and "
            "{:.6g} m at {} {} of {}; {} of {} samples there and {} of {} edges differ; expected the "
            "same heights on both faces, to {:.6g} m. The outermost samples of a face lie on the cube's "
            "edges, so neighbours repeat them: check the faces' names, orientation, sample type and byte "
            "order, and resample faces whose samples lie at pixel centres",
            stem, faceName(first.face), faceName(worst.edge.first[1].face), worst.largest,
            sidesText(worst.edge, cells), worst.values[0], worst.values[1], alongColumn ? "row" : "column",
            place, faceName(first.face), worst.samples, lines.size, edges, cubeEdgeCount, toleranceM)};
}

constexpr double visibleDifference = 0.1;  // linear light

std::string seamNotice(const EdgeDifference& worst, std::size_t edges, const FaceLines& lines,
                       const std::string& stem) {
    return fmt::format(
        "{}: the colours of faces {} and {} differ along their shared edge, {}: {} of {} samples there "
        "differ by more than {} in linear light, by up to {:.2f}; {} of {} edges differ so and will show a "
        "seam; expected the same colours on both faces. Check the faces' names and orientation",
        stem, faceName(worst.edge.first[0].face), faceName(worst.edge.first[1].face),
        sidesText(worst.edge, lines.size - 1), worst.samples, lines.size, visibleDifference, worst.largest,
        edges, cubeEdgeCount);
}

}  // namespace

Result<void> checkHeightEdges(const std::array<HeightRaster, faceCount>& faces, const FaceLines& lines,
                              const std::string& stem, double toleranceM) {
    TRY_ASSIGN(auto found, differencesOf(faces, lines, {.tolerance = toleranceM}));
    std::erase_if(found, [](const EdgeDifference& difference) { return difference.samples == 0; });
    if (found.empty()) return {};
    const EdgeDifference& worst = *std::ranges::max_element(found, {}, &EdgeDifference::largest);
    return tl::unexpected(heightError(worst, found.size(), lines, stem, toleranceM));
}

Result<ColourSeams> findColourSeams(const std::array<HeightRaster, faceCount>& faces, const FaceLines& lines,
                                    const std::string& stem) {
    TRY_ASSIGN(auto found,
               differencesOf(faces, lines, {.tolerance = visibleDifference, .least = 0, .most = 1}));
    // In lossy pictures, single samples may differ.
    std::erase_if(found, [&](const EdgeDifference& difference) {
        return std::int64_t{10} * difference.samples <= lines.size;
    });
    if (found.empty()) return ColourSeams();
    const EdgeDifference& worst = *std::ranges::max_element(found, {}, &EdgeDifference::samples);
    return ColourSeams{static_cast<int>(found.size()), seamNotice(worst, found.size(), lines, stem)};
}

}  // namespace planet
