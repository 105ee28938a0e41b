#include "app/suggest/suggest_vary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "planet/base/result.h"

namespace worldy {

planet::Result<SuggestVary> suggestVaryFromTexts(const std::vector<std::string>& names) {
    SuggestVary vary{false, false, false, false, false};
    const std::array<bool*, suggestVaryNames.size()> members = {&vary.tau, &vary.metric, &vary.morph,
                                                                &vary.memory, &vary.regions};
    for (const std::string& name : names) {
        const auto* const found = std::ranges::find(suggestVaryNames, name);
        if (found == suggestVaryNames.end()) {
            return planet::badInput(fmt::format("--vary: {} is unknown; expected some of {}", name,
                                                fmt::join(suggestVaryNames, ", ")));
        }
        bool& member = *members[static_cast<std::size_t>(std::distance(suggestVaryNames.begin(), found))];
        if (std::exchange(member, true))
            return planet::badInput(fmt::format("--vary: {} is given twice; expected each value once", name));
    }
    return vary;
}

}  // namespace worldy
