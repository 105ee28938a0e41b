// Says which settings a suggestion may vary.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

struct SuggestVary {
    bool tau = true;
    bool metric = true;
    bool morph = true;    // range
    bool memory = true;   // budget of the paging
    bool regions = true;  // places and bands of ground heights

    bool operator==(const SuggestVary&) const = default;
};
inline constexpr std::array<std::string_view, 5> suggestVaryNames = {"tau", "metric", "morph", "memory",
                                                                     "regions"};
// Reads such names; the Error names one that is unknown or given twice.
planet::Result<SuggestVary> suggestVaryFromTexts(const std::vector<std::string>& names);

}  // namespace worldy
