// The error bound of a chunk that selection compares with the tolerance.
#pragma once

#include <cstdint>

namespace planet {

// Additive: δc, a sum over the levels below; conservative. Tight: the largest measured distance of the surfaces of the
// chunk and its descendants from the finest data; fewer triangles for the same τ.
enum class ErrorMetric : std::uint8_t { Additive, Tight };

}  // namespace planet
