// Copies rasters that files store by whole rows to a temporary file in small blocks. A piece of the planet needs a few
// columns of many rows, and a cache of bounded size would drop the rows before the next piece needs their other columns.
// Internal to the library.
#pragma once

#include <cstddef>
#include <memory>

#include "planet/base/result.h"
#include "planet/raster/raster.h"
#include "planet/raster/temporary_file.h"

namespace planet {

// Returns a raster with the same heights, bit by bit, in blocks of at most 256 columns if `raster` has blocks of whole rows
// that are wider than 512 samples, and the heights of all its samples take more than twice cacheBytes. Otherwise it returns
// `raster` itself. Each block of `raster` is then read once, when one of its samples is asked for first, and copied to
// `space`, where it takes 2 bytes for a sample of most integer rasters and 4 bytes for any other. A block that could not be
// copied is read again. Errors name the file that cannot be read, or the folder of the temporary file.
Result<std::shared_ptr<const Raster>> inSmallBlocks(std::shared_ptr<const Raster> raster,
                                                    std::size_t cacheBytes, TemporarySpace& space);

}  // namespace planet
