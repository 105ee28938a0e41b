// The parts of the picture that cost most, and which of them a slow renderer does without.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "app/settings/view_settings.h"

namespace worldy {

enum class CostlyPart : std::uint8_t { Air, Normals, Layers, Shadows, Sea };
inline constexpr std::size_t costlyPartCount = 5;

inline constexpr double affordedMs = 50;  // of the GPU, for a picture: 20 a second
inline constexpr double patienceS = 2;    // that a picture may take longer before anything is turned down

// By what was measured in the window. Those that the user has set to on or off are left alone.
struct TurnedDown {
    std::array<bool, costlyPartCount> parts{};
    std::array<double, costlyPartCount> tookMs{};  // the picture, with the part
    double fastAtS = 0;  // when the picture was last fast enough, or something changed

    bool has(CostlyPart part) const { return parts[static_cast<std::size_t>(part)]; }
};

// Holds the time of the picture without and with one part, drawn in turn: medians of the rounds, in ms. The
// picture without the part shows only the lit ground.
struct PartCost {
    std::string part;
    double withoutMs = 0;
    double withMs = 0;
};

planet::gl::FeatureUse& useOf(CostlyPart part, SurfaceSettings& surface);

// The settings with the parts that are turned down off.
void turnDown(const TurnedDown& turnedDown, SurfaceSettings& surface);

// After a picture that took so many milliseconds of the GPU, at a time in seconds: turns one part more down
// where pictures have been too slow for long, in the order of the enumeration. True if it has.
bool watchPicture(TurnedDown& turnedDown, const SurfaceSettings& surface, double gpuMs, double timeS);

}  // namespace worldy
