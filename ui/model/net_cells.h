// The six faces as an unfolded cube, the net, on which every quadtree node is a square. Pure functions, no ImGui.
//
//          z_pos
//   y_neg  x_pos  y_pos  x_neg
//          z_neg
//
// Every face stands upright, so neighbours across the edges that faces share in the net are neighbours on the
// planet: the middle row is the equator from 135 degrees west, with north up.
#pragma once

#include <array>
#include <optional>

#include "planet/sphere/chunk_id.h"
#include "ui/model/plan_view.h"
#include "ui/model/plot_cursor.h"

namespace worldy::ui {

inline constexpr int netColumns = 4;
inline constexpr int netRows = 3;
inline constexpr PlanSize netSize{netColumns, netRows};  // in faces

// The place of a face in the net.
struct NetCell {
    int column, row;
};
constexpr std::array<NetCell, planet::faceCount> netCells = {
    {{1, 1}, {3, 1}, {2, 1}, {0, 1}, {1, 0}, {1, 2}}};
inline const NetCell& cellOf(planet::Face face) {
    return netCells[static_cast<std::size_t>(face)];
}

struct NetSquare {
    double x = 0;  // of the top left, in faces
    double y = 0;
    double side = 1;
};
NetSquare netSquare(const planet::ChunkId& id);

// Returns the chunk to which keys lead: an arrow to the neighbour on that side, Page Up to the parent, Page Down to the child
// that contains the point, or to the south-west child if none does. Returns none if no key asks for a chunk. Without a chunk to
// start from, every key leads to the root that contains the point. deepestLevel: of the planet's chunks.
std::optional<planet::ChunkId> steppedChunk(const std::optional<planet::ChunkId>& from, const PlotKeys& keys,
                                            const planet::FacePoint& point, int deepestLevel);

}  // namespace worldy::ui
