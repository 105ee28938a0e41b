// A chunk's heights to look at: a shaded picture, and profiles through its middle. Pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planet/tree/chunk_tree.h"

namespace worldy::ui {

// Square, row 0 in the north; colours as ImGui packs them, red in the lowest byte.
struct ChunkPicture {
    int side = 0;
    std::vector<std::uint32_t> cells;
};
// Lit from the north-west. Colours and slopes are stretched to the chunk's own range, so that flat chunks
// show something too. At most mostCells a side.
ChunkPicture chunkPicture(const planet::ChunkTree& tree, const planet::ChunkNode& node, int mostCells);

enum class ProfileWay : std::uint8_t { WestEast, SouthNorth };
// Metres above the planet's radius, through the chunk's middle; one a vertex.
std::vector<float> chunkProfile(const planet::ChunkTree& tree, const planet::ChunkNode& node, ProfileWay way);

// How far the chunk reaches on the ground, through its middle, metres.
double groundSizeM(const planet::PlanetShape& shape, const planet::ChunkId& id, ProfileWay way);

// "27.988 N  86.925 E" of a chunk's middle.
std::string middlePlaceText(const planet::ChunkId& id);

// What is wrong with a typed id and what would be right; empty if it names a chunk that a planet can have.
std::string chunkIdProblem(const std::string& text, int leafLevel);

}  // namespace worldy::ui
