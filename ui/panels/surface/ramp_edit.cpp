#include "ui/panels/surface/ramp_edit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/common.hpp>

namespace worldy::ui {

using planet::gl::RampStop;

namespace {

// Returns the index of the first stop above a height.
std::size_t stopAbove(std::span<const RampStop> ramp, double heightM) {
    const auto above = std::upper_bound(ramp.begin(), ramp.end(), heightM,
                                        [](double h, const RampStop& stop) { return h < stop.heightM; });
    return static_cast<std::size_t>(above - ramp.begin());
}

}  // namespace

glm::vec3 rampColourAt(std::span<const RampStop> ramp, double heightM) {
    if (ramp.empty()) return {0, 0, 0};
    const std::size_t above = stopAbove(ramp, heightM);
    if (above == 0) return ramp.front().colour;
    if (above == ramp.size()) return ramp.back().colour;
    const RampStop& low = ramp[above - 1];
    const RampStop& high = ramp[above];
    const double share = (heightM - low.heightM) / (high.heightM - low.heightM);
    return glm::mix(low.colour, high.colour, static_cast<float>(share));
}

std::size_t addStop(Ramp& ramp, double heightM) {
    assert(ramp.size() < planet::gl::maxRampStops);
    const std::size_t at = stopAbove(ramp, heightM);
    const glm::vec3 colour = rampColourAt(ramp, heightM);
    ramp.insert(ramp.begin() + static_cast<std::ptrdiff_t>(at), RampStop{heightM, colour});
    return at;
}

double heightAfter(std::span<const RampStop> ramp, std::size_t index) {
    assert(index < ramp.size());
    const double own = ramp[index].heightM;
    if (index + 1 < ramp.size()) return (own + ramp[index + 1].heightM) / 2;
    const double before = index > 0 ? own - ramp[index - 1].heightM : 0;
    return own + (before > 0 ? before : 1000);
}

void moveStop(Ramp& ramp, std::size_t index, double heightM) {
    assert(index < ramp.size());
    if (index > 0) heightM = std::max(heightM, ramp[index - 1].heightM);
    if (index + 1 < ramp.size()) heightM = std::min(heightM, ramp[index + 1].heightM);
    ramp[index].heightM = heightM;
}

Ramp greyRamp(double lowestM, double highestM) {
    assert(lowestM <= highestM);
    return {{lowestM, glm::vec3(0)}, {highestM, glm::vec3(1)}};
}

Ramp hypsometricRamp(double lowestM, double highestM) {
    assert(lowestM <= highestM);
    struct Share {
        double of;  // of the way from 0 m to the lowest or highest height
        glm::vec3 colour;
    };
    static const std::array<Share, 4> sea = {{{1, {0.05f, 0.11f, 0.30f}},
                                              {0.5f, {0.12f, 0.28f, 0.55f}},
                                              {0.1f, {0.36f, 0.60f, 0.80f}},
                                              {0, {0.66f, 0.84f, 0.92f}}}};
    static const std::array<Share, 6> land = {{{0, {0.24f, 0.50f, 0.26f}},
                                               {0.06f, {0.55f, 0.69f, 0.36f}},
                                               {0.18f, {0.89f, 0.82f, 0.52f}},
                                               {0.4f, {0.72f, 0.52f, 0.30f}},
                                               {0.7f, {0.50f, 0.36f, 0.28f}},
                                               {1, {0.97f, 0.97f, 0.97f}}}};
    Ramp ramp;
    if (lowestM < 0) {
        // Adding 0 turns the shoreline's -0 into 0.
        for (const Share& share : sea) ramp.push_back({share.of * lowestM + 0.0, share.colour});
    }
    // A planet wholly below 0 m needs no land colours; one wholly above it starts at its lowest height.
    const double base = std::max(lowestM, 0.0);
    if (highestM > 0) {
        for (const Share& share : land) ramp.push_back({base + share.of * (highestM - base), share.colour});
    }
    if (ramp.empty()) ramp.push_back({lowestM, land.front().colour});
    return ramp;
}

}  // namespace worldy::ui
