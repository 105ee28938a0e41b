#include "planet/measure/true_error.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>

#include "planet/base/parallel.h"
#include "planet/base/percentile.h"
#include "planet/base/try.h"
#include "planet/select/drawn_surface.h"
#include "planet/select/screen_error.h"

namespace planet {

namespace {

constexpr int mostChunkSize = 129;

// The part of a drawn chunk that one task measures.
struct Piece {
    std::size_t item = 0;
    ChunkId top;
};

// The result of a piece.
struct PieceError {
    double chordSquared = -1;   // largest squared chord |a/|a| - b/|b||^2
    double errorM = 0;          // there, metres
    glm::dvec3 worst{0, 0, 0};  // a there, relative to the eye, in the face's axes
    bool inSeam = false;
    double screenSquared = 0;  // largest, tangents squared
    double chordSum = 0;
    std::uint64_t samples = 0;
};

// The picture in a face's axes.
struct Camera {
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
    double halfWidth = 1;  // tangents
    double halfHeight = 1;
    double cornerRad = 0;  // from the middle of the picture to its corners
};

// Convert to and from a face's axes: normal, u, v.
glm::dvec3 inFaceAxes(const FaceAxes& axes, const glm::dvec3& p) {
    return {glm::dot(axes.normal, p), glm::dot(axes.u, p), glm::dot(axes.v, p)};
}
glm::dvec3 fromFaceAxes(const FaceAxes& axes, const glm::dvec3& p) {
    return axes.normal * p.x + axes.u * p.y + axes.v * p.z;
}

Camera cameraOf(const View& view, const FaceAxes& axes) {
    Camera camera{inFaceAxes(axes, view.right), inFaceAxes(axes, view.up), inFaceAxes(axes, -view.back)};
    camera.halfWidth = 0.5 * view.widthPx / screenScalePx(view);
    camera.halfHeight = 0.5 * view.heightPx / screenScalePx(view);
    camera.cornerRad = std::atan(std::hypot(camera.halfWidth, camera.halfHeight));
    return camera;
}

// A row of samples of a leaf, relative to the eye, in the face's axes.
struct Row {
    int count = 0;
    std::array<double, mostChunkSize> drawnX, drawnY, drawnZ;
    std::array<double, mostChunkSize> trueX, trueY, trueZ;
    std::array<double, mostChunkSize> chordSquared, chord, errorSquared;
};

// A drawn chunk and the finest grid under it.
class Surface {
public:
    Surface(const DrawnSnapshot& snapshot, std::size_t item)
        : item_(snapshot.items[item]),
          axes_(faceAxes(item_.id.face)),
          grid_(drawnGrid(snapshot.shape, item_, *snapshot.chunks[item].heights, snapshot.stitched)),
          eye_(inFaceAxes(axes_, snapshot.view.eyeM)) {
        local_.reserve(grid_.positionM.size());
        for (const glm::dvec3& position : grid_.positionM)
            local_.push_back(inFaceAxes(axes_, position) - eye_);
    }

    const FaceAxes& axes() const { return axes_; }
    const glm::dvec3& eye() const { return eye_; }
    const DrawnGrid& grid() const { return grid_; }

    // Returns whether a sample of a grid lies in a cell that stitching changes: in one of the two outermost
    // rows along an edge. perCell: cells of that grid along a cell of the chunk.
    bool inSeam(int x, int y, int perCell) const {
        if (!grid_.stitched) return false;
        const int last = grid_.cells - 1;
        const int column = std::min(x / perCell, last);
        const int row = std::min(y / perCell, last);
        const auto moved = [&](Edge edge) { return gathersVertices(item_, edge); };
        return (column <= 1 && moved(Edge::West)) || (column >= last - 1 && moved(Edge::East)) ||
               (row <= 1 && moved(Edge::South)) || (row >= last - 1 && moved(Edge::North));
    }

    // Computes the drawn points at the samples x, x + 1, ... of row y of such a grid, counted from the
    // chunk's south-west corner.
    void fill(int x, int y, int perCell, Row& out) const {
        const int row = std::min(y / perCell, grid_.cells - 1);
        const double t = static_cast<double>(y - row * perCell) / perCell;
        for (int i = 0; i < out.count;) {
            const int column = std::min((x + i) / perCell, grid_.cells - 1);
            const int cellEnd = column == grid_.cells - 1 ? out.count : (column + 1) * perCell - x;
            const int end = std::min(cellEnd, out.count);
            if (inSeam(x + i, y, perCell))
                fillSeam(x, y, perCell, i, end, out);
            else
                fillCell({column, row}, t, x, perCell, i, end, out);
            i = end;
        }
    }

private:
    void fillSeam(int x, int y, int perCell, int first, int end, Row& out) const {
        for (int i = first; i < end; ++i) {
            const glm::dvec3 point = inFaceAxes(axes_, pointOn(grid_, static_cast<double>(x + i) / perCell,
                                                               static_cast<double>(y) / perCell)) -
                                     eye_;
            const auto at = static_cast<std::size_t>(i);
            out.drawnX[at] = point.x;
            out.drawnY[at] = point.y;
            out.drawnZ[at] = point.z;
        }
    }

    // Fills one cell's samples of the row; along it, the drawn point is linear on each of the cell's
    // triangles.
    void fillCell(glm::ivec2 cell, double t, int x, int perCell, int first, int end, Row& out) const {
        const auto side = static_cast<std::size_t>(grid_.cells) + 1;
        const std::size_t at = static_cast<std::size_t>(cell.y) * side + static_cast<std::size_t>(cell.x);
        const glm::dvec3& southWest = local_[at];
        const glm::dvec3& southEast = local_[at + 1];
        const glm::dvec3& northWest = local_[at + side];
        const glm::dvec3& northEast = local_[at + side + 1];
        const int west = cell.x * perCell - x;  // the cell's west edge, in samples of the row
        const int diagonal = std::clamp(west + static_cast<int>(std::ceil(t * perCell)), first, end);
        const double perSample = 1.0 / perCell;
        fillLine(southWest + t * (northWest - southWest), (northEast - northWest) * perSample, west, first,
                 diagonal, out);
        fillLine(southWest + t * (northEast - southEast), (southEast - southWest) * perSample, west, diagonal,
                 end, out);
    }

    static void fillLine(const glm::dvec3& start, const glm::dvec3& step, int west, int first, int end,
                         Row& out) {
        for (int i = first; i < end; ++i) {
            const double along = i - west;
            const auto at = static_cast<std::size_t>(i);
            out.drawnX[at] = start.x + along * step.x;
            out.drawnY[at] = start.y + along * step.y;
            out.drawnZ[at] = start.z + along * step.z;
        }
    }

    const DrawItem& item_;
    const FaceAxes& axes_;
    DrawnGrid grid_;
    glm::dvec3 eye_;
    std::vector<glm::dvec3> local_;  // the grid's vertices, relative to the eye, in the face's axes
};

// Computes Nowell's mapping in a face's axes. Within a row, only the root of the normal's component depends
// on both u and v.
struct LeafColumns {
    std::array<double, mostChunkSize> u, uSquared, uRoot;
};

LeafColumns columnsOf(const ChunkId& leaf, int cells) {
    const FaceSquare square = faceSquareOf(leaf);
    LeafColumns columns;
    for (int i = 0; i <= cells; ++i) {
        const auto at = static_cast<std::size_t>(i);
        columns.u[at] = square.u + square.side * i / cells;
        columns.uSquared[at] = columns.u[at] * columns.u[at];
        columns.uRoot[at] = std::sqrt(0.5 - columns.uSquared[at] / 6);
    }
    return columns;
}

void fillTruth(const PlanetShape& shape, const LeafColumns& columns, double v, const StepsView& steps,
               const glm::dvec3& eye, Row& row) {
    const double vSquared = v * v;
    const double vRoot = std::sqrt(0.5 - vSquared / 6);
    const double base = shape.radiusM + shape.baseHeightM;
    const double quantum = shape.quantumM;
    const auto count = static_cast<std::size_t>(row.count);
    for (std::size_t i = 0; i < count; ++i) {
        const double radius = base + quantum * steps[i];
        const double uSquared = columns.uSquared[i];
        row.trueX[i] = radius * std::sqrt(1 - (uSquared + vSquared) / 2 + uSquared * vSquared / 3) - eye.x;
        row.trueY[i] = radius * columns.u[i] * vRoot - eye.y;
        row.trueZ[i] = radius * v * columns.uRoot[i] - eye.z;
    }
}

// Computes the chord between the directions of a and b = a + e. Its sine comes from the cross product of a
// and e, which avoids cancellation if they are almost equal.
void compare(Row& row) {
    constexpr double nearestSquared = nearestM * nearestM;
    const auto count = static_cast<std::size_t>(row.count);
    for (std::size_t i = 0; i < count; ++i) {
        const double ax = row.trueX[i];
        const double ay = row.trueY[i];
        const double az = row.trueZ[i];
        const double bx = row.drawnX[i];
        const double by = row.drawnY[i];
        const double bz = row.drawnZ[i];
        const double ex = bx - ax;
        const double ey = by - ay;
        const double ez = bz - az;
        const double cx = ay * ez - az * ey;
        const double cy = az * ex - ax * ez;
        const double cz = ax * ey - ay * ex;
        const double aSquared = std::max(ax * ax + ay * ay + az * az, nearestSquared);
        const double bSquared = std::max(bx * bx + by * by + bz * bz, nearestSquared);
        const double both = aSquared * bSquared;
        const double root = std::sqrt(both);
        const double onePlusCosine = std::max(1 + (ax * bx + ay * by + az * bz) / root, 1e-9);
        const double squared = 2 * (cx * cx + cy * cy + cz * cz) / (both * onePlusCosine);
        row.chordSquared[i] = squared;
        row.chord[i] = std::sqrt(squared);
        row.errorSquared[i] = ex * ex + ey * ey + ez * ez;
    }
}

// Returns the sum of the chords: four parallel sums, added in a fixed order.
double sumOf(const Row& row) {
    std::array<double, 4> sums{};
    int i = 0;
    for (; i + 4 <= row.count; i += 4) {
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += row.chord[static_cast<std::size_t>(i) + k];
    }
    for (; i < row.count; ++i) sums[0] += row.chord[static_cast<std::size_t>(i)];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// Returns the largest distance in the picture, in tangents, of two directions a chord apart. Outwards from a
// corner, the picture stretches by 1 / cos^2.
double largestInPicture(const Camera& camera, double chord) {
    const double apartRad = 2 * std::asin(std::min(chord / 2, 1.0));
    const double outerRad = camera.cornerRad + apartRad;
    if (outerRad >= std::numbers::pi / 2) return std::numeric_limits<double>::infinity();
    return (std::tan(outerRad) - std::tan(camera.cornerRad)) * (1 + 1e-9);
}

void projectRow(const Camera& camera, const Row& row, PieceError& found) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.count); ++i) {
        const glm::dvec3 a(row.trueX[i], row.trueY[i], row.trueZ[i]);
        const glm::dvec3 b(row.drawnX[i], row.drawnY[i], row.drawnZ[i]);
        const double aAhead = glm::dot(camera.forward, a);
        const double bAhead = glm::dot(camera.forward, b);
        if (aAhead <= 0 || bAhead <= 0) continue;
        const double x = glm::dot(camera.right, a) / aAhead;
        const double y = glm::dot(camera.up, a) / aAhead;
        if (std::abs(x) > camera.halfWidth || std::abs(y) > camera.halfHeight) continue;
        const double moveX = glm::dot(camera.right, b) / bAhead - x;
        const double moveY = glm::dot(camera.up, b) / bAhead - y;
        found.screenSquared = std::max(found.screenSquared, moveX * moveX + moveY * moveY);
    }
}

// The place of a row: its first sample, counted from the chunk's south-west corner on a leaf's grid.
struct RowPlace {
    int x = 0;
    int y = 0;
    int perCell = 1;  // cells of that grid along a cell of the chunk
};

void takeRow(const Surface& surface, const Camera& camera, const Row& row, const RowPlace& place,
             PieceError& found) {
    double rowWorst = -1;
    std::size_t worstAt = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.count); ++i) {
        if (row.chordSquared[i] > rowWorst) {
            rowWorst = row.chordSquared[i];
            worstAt = i;
        }
    }
    if (rowWorst > found.chordSquared) {
        found.chordSquared = rowWorst;
        found.errorM = std::sqrt(row.errorSquared[worstAt]);
        found.worst = {row.trueX[worstAt], row.trueY[worstAt], row.trueZ[worstAt]};
        found.inSeam = surface.inSeam(place.x + static_cast<int>(worstAt), place.y, place.perCell);
    }
    found.chordSum += sumOf(row);
    found.samples += static_cast<std::uint64_t>(row.count);
    const double most = largestInPicture(camera, std::sqrt(std::max(rowWorst, 0.0)));
    if (most * most > found.screenSquared) projectRow(camera, row, found);
}

// Compares a leaf's samples. Samples on an edge between two leaves are compared once, except those on the
// chunk's own edges. In a sparse planet the leaf beyond an edge may lack samples of the edge, so both leaves
// compare theirs.
void measureLeaf(const DrawnSnapshot& snapshot, const Surface& surface, const Camera& camera,
                 const HeldChunk& leaf, Row& row, PieceError& found) {
    const PlanetShape& shape = snapshot.shape;
    const int cells = chunkCells(shape);
    const ChunkId& top = surface.grid().id;
    const int shift = leaf.id.level - top.level;
    const int x = static_cast<int>(leaf.id.x - (top.x << shift)) * cells;
    const int y = static_cast<int>(leaf.id.y - (top.y << shift)) * cells;
    const int perCell = 1 << shift;
    const int across = cells * perCell;
    row.count = snapshot.isSparse || x + cells == across ? cells + 1 : cells;
    const int rows = snapshot.isSparse || y + cells == across ? cells + 1 : cells;
    const FaceSquare square = faceSquareOf(leaf.id);
    const LeafColumns columns = columnsOf(leaf.id, cells);
    for (int j = 0; j < rows; ++j) {
        const auto side = static_cast<std::size_t>(cells) + 1;
        const StepsView steps = leaf.heights->view().subspan(static_cast<std::size_t>(j) * side, side);
        surface.fill(x, y + j, perCell, row);
        fillTruth(shape, columns, square.v + square.side * j / cells, steps, surface.eye(), row);
        compare(row);
        takeRow(surface, camera, row, {x, y + j, perCell}, found);
    }
}

// Returns whether every vertex is a finest sample at its own place, so that there is nothing to compare.
bool isExact(const DrawnSnapshot& snapshot, std::size_t index) {
    const DrawItem& item = snapshot.items[index];
    if (snapshot.chunks[index].children.exists() || item.morph > 0) return false;
    for (std::size_t edge = 0; edge < edgeCount; ++edge) {
        if (snapshot.stitched && item.coarserBy[edge] > 0) return false;
        if (item.edgeMorph[edge] > 0) return false;
    }
    return true;
}

// Returns the number of samples under a chunk, if all leaves under it are at the deepest level.
std::uint64_t samplesUnder(const PlanetShape& shape, const ChunkId& id) {
    const auto side =
        (static_cast<std::uint64_t>(chunkCells(shape)) << (deepestLevelOf(shape) - id.level)) + 1;
    return side * side;
}

// Splits a chunk into pieces of at most 64 leaves each, as long as there are at most 4096 pieces.
void addPieces(const ChunkId& id, int levels, std::size_t item, std::vector<Piece>& pieces) {
    if (levels == 0) {
        pieces.push_back({item, id});
        return;
    }
    for (int quadrant = 0; quadrant < quadrantCount; ++quadrant)
        addPieces(childOf(id, quadrant), levels - 1, item, pieces);
}

// Returns whether a chunk is the first of its level in quadtree order under another one.
bool isFirstIn(const ChunkId& id, const ChunkId& above) {
    const int levels = id.level - above.level;
    return id.x == above.x << levels && id.y == above.y << levels;
}

std::vector<Piece> piecesOf(const DrawnSnapshot& snapshot) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < snapshot.items.size(); ++i) {
        const ChunkId& id = snapshot.items[i].id;
        if (isExact(snapshot, i)) continue;
        const int levels =
            snapshot.chunks[i].children.exists() ? deepestLevelOf(snapshot.shape) - id.level : 0;
        addPieces(id, std::clamp(levels - 3, 0, 6), i, pieces);
    }
    return pieces;
}

// Measures all pieces, on several threads.
class Measuring {
public:
    Measuring(const DrawnSnapshot& snapshot, FinestHeights& heights, const TrueErrorProgress& progress)
        : snapshot_(snapshot), heights_(heights), progress_(progress), pieces_(piecesOf(snapshot)) {
        found_.resize(pieces_.size());
        for (const Face face : allFaces)
            cameras_[static_cast<std::size_t>(face)] = cameraOf(snapshot.view, faceAxes(face));
        for (const Piece& piece : pieces_) total_ += samplesUnder(snapshot.shape, piece.top);
    }

    Result<void> run() {
        parallelFor(pieces_.size(), [this](std::size_t i) {
            if (!stopped_) measure(i);
        });
        if (problem_) return tl::unexpected(problem_->error);
        if (stopped_) return cancelled();
        return {};
    }

    // Adds results in the order of the pieces, so that sums do not depend on the threads.
    void addTo(std::vector<ChunkError>& chunks) const {
        const double scale = screenScalePx(snapshot_.view);
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            const PieceError& piece = found_[i];
            ChunkError& chunk = chunks[pieces_[i].item];
            chunk.samples += piece.samples;
            chunk.meanPx += scale * piece.chordSum;  // a sum until finish() divides it
            chunk.screenPx = std::max(chunk.screenPx, scale * std::sqrt(piece.screenSquared));
            const double facingPx = scale * std::sqrt(std::max(piece.chordSquared, 0.0));
            if (facingPx <= chunk.facingPx) continue;
            const FaceAxes& axes = faceAxes(chunk.id.face);
            chunk.facingPx = facingPx;
            chunk.errorM = piece.errorM;
            chunk.worstM = fromFaceAxes(axes, piece.worst) + snapshot_.view.eyeM;
            chunk.worstInSeam = piece.inSeam;
        }
    }

private:
    struct Problem {
        std::size_t piece = 0;
        Error error;
    };

    void measure(std::size_t index) {
        const Piece& piece = pieces_[index];
        const Surface surface(snapshot_, piece.item);
        const Camera& camera = cameras_[static_cast<std::size_t>(piece.top.face)];
        Row row;
        PieceError found;
        const auto measureTop = [&](const HeldChunk& top) -> Result<void> {
            // A leaf above the piece covers other pieces too; it belongs to the first.
            if (!isFirstIn(piece.top, top.id)) return {};
            return heights_.forEachLeaf(top, snapshot_.resident, [&](const HeldChunk& leaf) {
                measureLeaf(snapshot_, surface, camera, leaf, row, found);
                return !stopped_;
            });
        };
        const Result<void> measured =
            heights_.chunkUnder(snapshot_.chunks[piece.item], piece.top, snapshot_.resident)
                .and_then(measureTop);
        found_[index] = found;
        if (!measured) return fail(index, measured.error());
        report(samplesUnder(snapshot_.shape, piece.top));
    }

    // Records the problem of the first piece, if several fail.
    void fail(std::size_t piece, const Error& error) {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        if (!problem_ || piece < problem_->piece) problem_ = Problem{piece, error};
    }

    void report(std::uint64_t samples) {
        const std::lock_guard lock(mutex_);
        done_ += samples;
        if (progress_ && !stopped_ && !progress_(std::min(done_, total_), total_)) stopped_ = true;
    }

    const DrawnSnapshot& snapshot_;
    FinestHeights& heights_;
    const TrueErrorProgress& progress_;
    const std::vector<Piece> pieces_;
    std::vector<PieceError> found_;  // by piece; each is written by one thread
    std::array<Camera, faceCount> cameras_;
    std::uint64_t total_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;  // guards the members below
    std::uint64_t done_ = 0;
    std::optional<Problem> problem_;
};

TrueErrorReport summaryOf(std::vector<ChunkError>&& chunks) {
    TrueErrorReport report;
    report.chunks = std::move(chunks);
    std::vector<double> facing;
    std::vector<double> screen;
    double slack = 0;
    std::size_t predicted = 0;
    for (const ChunkError& chunk : report.chunks) {
        report.worstEpsPx = std::max(report.worstEpsPx, chunk.epsPx);
        report.worstDrawnBoundPx = std::max(report.worstDrawnBoundPx, chunk.drawnBoundPx);
        report.worstFacingPx = std::max(report.worstFacingPx, chunk.facingPx);
        report.worstScreenPx = std::max(report.worstScreenPx, chunk.screenPx);
        report.samples += chunk.samples;
        facing.push_back(chunk.facingPx);
        screen.push_back(chunk.screenPx);
        slack += slackOf(chunk);
        predicted += chunk.drawnBoundPx > 0;
        report.violations += isViolation(chunk);
        report.violationsInSeams += isViolation(chunk) && chunk.worstInSeam;
    }
    report.p99FacingPx = percentileOf(facing, 0.99);
    report.p99ScreenPx = percentileOf(screen, 0.99);
    report.meanSlack = predicted > 0 ? slack / static_cast<double>(predicted) : 0;
    return report;
}

}  // namespace

DrawnSnapshot snapshotOf(const ChunkTree& tree, std::span<const DrawItem> items, const View& view,
                         bool stitched) {
    DrawnSnapshot snapshot;
    snapshot.shape = tree.shape;
    snapshot.view = view;
    snapshot.items.assign(items.begin(), items.end());
    snapshot.stitched = stitched;
    snapshot.isSparse = isSparse(tree);
    snapshot.chunks.reserve(items.size());
    for (const DrawItem& item : items) {
        const ChunkNode& node = tree.nodes[item.node];
        snapshot.chunks.push_back({node.id, node.heights, node.children});
        addResidentBlocks(tree, item.node, snapshot.resident);
    }
    return snapshot;
}

bool isViolation(const ChunkError& error) {
    return error.facingPx > error.drawnBoundPx * (1 + 1e-4) + 1e-3;
}

double slackOf(const ChunkError& error) {
    return error.drawnBoundPx > 0 ? 1 - error.facingPx / error.drawnBoundPx : 0;
}

Result<TrueErrorReport> measureTrueError(const DrawnSnapshot& snapshot, FinestHeights& heights,
                                         const TrueErrorProgress& progress) {
    assert(snapshot.items.size() == snapshot.chunks.size());
    std::vector<ChunkError> chunks(snapshot.items.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        chunks[i].id = snapshot.items[i].id;
        chunks[i].epsPx = static_cast<double>(snapshot.items[i].epsPx);
        chunks[i].drawnBoundPx = static_cast<double>(snapshot.items[i].drawnBoundPx);
        if (isExact(snapshot, i))
            chunks[i].samples = static_cast<std::uint64_t>(chunkVertexCount(snapshot.shape));
    }
    Measuring measuring(snapshot, heights, progress);
    TRY(measuring.run());
    measuring.addTo(chunks);
    for (ChunkError& chunk : chunks) {
        if (chunk.samples > 0) chunk.meanPx /= static_cast<double>(chunk.samples);
    }
    return summaryOf(std::move(chunks));
}

}  // namespace planet
