// The index of a node in a quadtree's list of nodes.
#pragma once

#include <cstdint>

namespace planet {

using NodeIndex = std::uint32_t;
inline constexpr NodeIndex noNode = ~NodeIndex{0};

}  // namespace planet
