// Hashes what the heights of rasters on one grid depend on (source_parts.h). Internal to the library; any thread.
#pragma once

#include <cstdint>

#include "planet/base/result.h"
#include "planet/format/source_record.h"
#include "planet/raster/raster_area.h"

namespace planet {

// Returns the part of rasters on one grid. settings: a hash of everything but the files that their heights
// depend on.
Result<SourcePart> partOf(const RasterArea& area, std::uint64_t settings);

// Returns the quantum that heights of an area need, metres, on a planet of a radius (height_quanta.h).
double quantumOf(const RasterArea& area, double radiusM);

}  // namespace planet
