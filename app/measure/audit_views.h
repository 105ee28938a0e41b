// The default views of an audit.
#pragma once

#include <vector>

#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/sphere/view.h"

namespace worldy {

// Returns views of the whole planet from two sides, and views above its most rugged ground from high up to
// just above the highest point: straight down, slanted, and level in several directions.
planet::Result<std::vector<planet::CameraPose>> auditPoses(const planet::ChunkFile& file);

}  // namespace worldy
