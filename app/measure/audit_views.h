// Where an audit looks from when it is told nothing else.
#pragma once

#include <vector>

#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/sphere/view.h"

namespace worldy {

// The leaf that one comes to from the roots by always taking the chunk whose finest heights differ most.
planet::Result<planet::ChunkData> mostRuggedLeaf(const planet::ChunkFile& file);

// The whole planet from two sides, and over the most rugged leaf from high up down to just over its highest
// ground: straight down, aslant, and level in several directions.
planet::Result<std::vector<planet::CameraPose>> auditPoses(const planet::ChunkFile& file);

}  // namespace worldy
