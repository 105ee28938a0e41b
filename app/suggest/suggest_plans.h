// Regions that may let τ fall elsewhere: where a planet costs most, τ may be larger there alone.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "app/suggest/suggest_meter.h"
#include "app/suggest/suggest_search.h"
#include "planet/tree/region.h"

namespace worldy {

inline constexpr std::string_view placesPlan = "places";
inline constexpr std::string_view heightsPlan = "heights";

// Returns a circle that covers four fifths of the ground that a view draws, with its soft border. Pure. ground: not empty.
planet::RegionCircle circleOver(std::span<const SuggestGround> ground, double radiusM);
// Returns the band of ground heights that holds the middle three fifths of the drawn ground. Pure. ground: not empty.
planet::HeightBand bandOver(std::span<const SuggestGround> ground);

// Returns a name that no region has yet: "suggested places", or "suggested places 2".
std::string newRegionName(std::string_view plan, std::span<const planet::Region> taken);
// Returns whether a name is one that newRegionName gives.
bool isSuggestedName(std::string_view name);

// Returns the plans for the ground of the frames with the largest costs, one span of ground each. Plans that cover no
// ground are left out. taken: the planet's regions. Pure.
std::vector<SuggestPlan> plansOver(std::span<const std::vector<SuggestGround>> frames, double radiusM,
                                   std::span<const planet::Region> taken);

}  // namespace worldy
