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

#include "planet/sphere/chunk_id.h"
#include "ui/model/plan_view.h"

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

}  // namespace worldy::ui
