// Edits the height ramp, which is ordered lowest stop first. Pure functions; heights are metres above sea
// level, colours sRGB in [0, 1].
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/gl/draw/render_settings.h"

namespace worldy::ui {

using Ramp = std::vector<planet::gl::RampStop>;

// Returns the colour of a height as planet::gl::RampStop defines it; black for an empty ramp.
glm::vec3 rampColourAt(std::span<const planet::gl::RampStop> ramp, double heightM);

// Adds a stop with the ramp's own colour at that height, so that the picture does not change. Returns its
// index. The ramp must have room for it.
std::size_t addStop(Ramp& ramp, double heightM);

// Returns a height for a stop to be added after one: half way to the next; after the last stop, as far as
// that is from the one before it, or 1000 m.
double heightAfter(std::span<const planet::gl::RampStop> ramp, std::size_t index);

// Moves a stop, but not past its neighbours, which keeps the order.
void moveStop(Ramp& ramp, std::size_t index, double heightM);

// Returns a ramp from black at the lowest height to white at the highest.
Ramp greyRamp(double lowestM, double highestM);
// Returns the colours of atlases: deep to light blue up to 0 m, then green, yellow, brown and white, scaled
// to a planet's heights. lowestM <= highestM.
Ramp hypsometricRamp(double lowestM, double highestM);

}  // namespace worldy::ui
