// Writes pictures of a baked file, level by level, for image viewers.
#pragma once

#include <filesystem>

#include "planet/base/result.h"

namespace planet {

// Writes FOLDER/FACE_levelN.png for every face and level: 16-bit grey, black the planet's lowest height,
// white its highest, north (v = 1) in the first row. Makes the folder; holds one row of chunks at a time.
Result<void> writeLevelImages(const std::filesystem::path& chunkFile, const std::filesystem::path& folder);

}  // namespace planet
