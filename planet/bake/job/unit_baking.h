// Bakes units of a job on the threads of one rank, and spools them.
#pragma once

#include <vector>

#include "planet/bake/job/job_plan.h"
#include "planet/bake/job/spool.h"
#include "planet/bake/job/unit_feed.h"
#include "planet/base/result.h"

namespace planet {

// Bakes the units of the feed until it ends. Appends to spool and finished, in the order of the feed; adds to counts. The
// Error names the source's file or the spool's.
Result<void> bakeFeed(const JobPlan& plan, UnitFeed& feed, SpoolWriter& spool,
                      std::vector<SpoolEntry>& finished, UnitCounts& counts);

// The first part of a finished unit of colours: the packed size of each of its tiles.
std::vector<std::byte> colourFront(const std::vector<std::uint32_t>& packedBytes);
Result<std::vector<std::uint32_t>> colourSizes(std::span<const std::byte> front, const ColourUnit& unit);

}  // namespace planet
