// Selects whether an expensive feature is drawn.
#pragma once

#include <cstdint>

namespace planet::gl {

// Automatic: on, except with software rendering, which would fall below 20 frames per second.
enum class FeatureUse : std::uint8_t { Automatic, On, Off };

inline bool isUsed(FeatureUse use, bool software) {
    return use == FeatureUse::On || (use == FeatureUse::Automatic && !software);
}

}  // namespace planet::gl
