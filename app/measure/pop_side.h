// Chooses whether the viewport draws the live selection or the frame before or after a pop.
#pragma once

#include <cstdint>

namespace worldy {

enum class PopSide : std::uint8_t { Live, Before, After };

}  // namespace worldy
