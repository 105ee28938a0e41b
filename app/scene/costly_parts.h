// The most expensive features of the picture. A slow renderer turns off those that are Automatic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "app/settings/view_settings.h"

namespace worldy {

enum class CostlyPart : std::uint8_t { Air, Normals, Layers, Shadows, Sea, Detail };
inline constexpr std::size_t costlyPartCount = 6;

inline constexpr double affordedMs = 50;  // GPU time budget of a frame
inline constexpr double patienceS = 2;  // time for which frames may exceed it before a feature is turned off

// The features that were measured to be too slow. Only Automatic features are turned off.
struct TurnedDown {
    std::array<bool, costlyPartCount> parts{};
    std::array<double, costlyPartCount> tookMs{};  // frame time with the feature
    double fastAtS = 0;  // when a frame was last fast enough, or a feature was turned off

    bool has(CostlyPart part) const { return parts[static_cast<std::size_t>(part)]; }
};

// The median frame times without and with one part, drawn in alternation. Without the part, only the lit
// ground is drawn.
struct PartCost {
    std::string part;
    double withoutMs = 0;
    double withMs = 0;
};

planet::gl::FeatureUse& useOf(CostlyPart part, SurfaceSettings& surface);

// Turns off the Automatic features that are too slow.
void turnDown(const TurnedDown& turnedDown, SurfaceSettings& surface);

// Takes the GPU time of a frame and the current time. Turns off one more feature, in the order of the
// enumeration, if frames have been too slow for patienceS. Returns true if it has.
bool watchPicture(TurnedDown& turnedDown, const SurfaceSettings& surface, double gpuMs, double timeS);

}  // namespace worldy
