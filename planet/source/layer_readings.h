// The parts that sources of rasters describe their layers with (source_layers.h). Internal to the library; any
// thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "planet/base/result.h"
#include "planet/raster/raster_area.h"
#include "planet/source/height_source_types.h"
#include "planet/source/raster_sampling.h"
#include "planet/source/source_layers.h"

namespace planet {

// Describes rasters of one layer, at least one. name: of the layer.
SourceLayer rasterLayer(const std::string& name, std::span<const RasterArea> areas);

// Returns "mesa.tif, 101 x 101 float, WGS 84", or "mesa.tif, 3 rasters on 2 grids, WGS 84".
std::string aboutRasters(const std::string& name, std::span<const RasterArea> areas);

// Reads the sample nearest to a place on the grid: the first one of onGrid. Its height is as the file says.
Result<SourceReading> readSample(const RasterArea& area, const PlacesOnGrid& onGrid);

}  // namespace planet
