// Returns shares of a whole as readable text. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <string>

namespace worldy {

// Returns "0 %", "< 0.01 %", "0.25 %", "7.5 %", "42 %", "99.97 %" or "100 %". Only nothing reads 0 %, and only the whole 100 %.
// of: the whole, > 0.
std::string percentText(std::uint64_t part, std::uint64_t of);

}  // namespace worldy
