// A chunk's heights as a shaded picture and as profiles through its middle. Pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planet/tree/chunk_tree.h"

namespace worldy::ui {

// A square picture; row 0 is north. Colours are packed for ImGui, red in the lowest byte.
struct ChunkPicture {
    int side = 0;
    std::vector<std::uint32_t> cells;
};
// Returns a picture lit from the north-west, at most mostCells wide. Colours and slopes are scaled to the
// chunk's own height range, so that flat chunks show relief too.
ChunkPicture chunkPicture(const planet::ChunkTree& tree, const planet::ChunkNode& node, int mostCells);

enum class ProfileWay : std::uint8_t { WestEast, SouthNorth };
// Returns the heights through the chunk's middle, metres above the planet's radius, one per vertex.
std::vector<float> chunkProfile(const planet::ChunkTree& tree, const planet::ChunkNode& node, ProfileWay way);

// Returns the chunk's extent on the ground through its middle, metres.
double groundSizeM(const planet::PlanetShape& shape, const planet::ChunkId& id, ProfileWay way);

// Returns the position of the chunk's middle: "27.9880° N, 86.9250° E".
std::string middlePlaceText(const planet::ChunkId& id);

// Returns what is wrong with a typed id and what is expected; empty if it names a chunk that a planet can
// have.
std::string chunkIdProblem(const std::string& text, int leafLevel);

}  // namespace worldy::ui
