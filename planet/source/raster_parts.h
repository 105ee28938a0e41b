// Hashes what the heights of rasters on one grid depend on (source_parts.h). Internal to the library; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/source_record.h"
#include "planet/raster/raster_area.h"

namespace planet {

// Says how far the samples of rasters reach.
struct RasterReach {
    double filterSpacingRad = 0;  // of the grid that the filter is made for
    double featherRad = 0;        // the width of the blend at the rim
    bool fillsVoids = false;      // heights are interpolated across voids of any width
};

// Appends the parts of rasters on one grid. Several tiles are a part each, so that a later bake knows which of them have
// changed. The area is one part if samples reach too far to tell, or if there are too many tiles. settings: a hash of everything but the files that the heights depend on.
Result<void> appendParts(const RasterArea& area, std::uint64_t settings, const RasterReach& reach,
                         std::vector<SourcePart>& parts);

// Returns the quantum that heights of an area need, metres, on a planet of a radius (height_quanta.h).
double quantumOf(const RasterArea& area, double radiusM);

}  // namespace planet
