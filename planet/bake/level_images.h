// Writes pictures of a baked file, level by level.
#pragma once

#include <filesystem>

#include "planet/base/result.h"

namespace planet {

// Writes FOLDER/FACE_levelN.png for every face and every level that has chunks everywhere: 16-bit grey, from
// black at the planet's lowest height to white at its highest, north (v = 1) in the first row. Creates the
// folder. Keeps one row of chunks in memory.
Result<void> writeLevelImages(const std::filesystem::path& chunkFile, const std::filesystem::path& folder);

}  // namespace planet
