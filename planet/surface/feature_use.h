// Whether a part of the picture that costs time is drawn.
#pragma once

#include <cstdint>

namespace planet::gl {

// Automatic: on, but off where the CPU draws, which is then too slow for 20 frames a second.
enum class FeatureUse : std::uint8_t { Automatic, On, Off };

inline bool isUsed(FeatureUse use, bool software) {
    return use == FeatureUse::On || (use == FeatureUse::Automatic && !software);
}

}  // namespace planet::gl
