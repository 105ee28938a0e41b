// Changing the height ramp, which is kept lowest stop first. Pure functions; heights are metres above the sea
// level, colours sRGB in [0, 1].
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/gl/draw/render_settings.h"

namespace worldy::ui {

using Ramp = std::vector<planet::gl::RampStop>;

// The colour that a height is drawn in, as planet::gl::RampStop says; black for an empty ramp.
glm::vec3 rampColourAt(std::span<const planet::gl::RampStop> ramp, double heightM);

// Adds a stop that changes nothing in the picture: it has the colour that the ramp has there. Returns where
// it is. The ramp must have room for it.
std::size_t addStop(Ramp& ramp, double heightM);

// A height for a stop to be added after one: half way to the next, or beyond the last as far as that is from
// the one before it.
double heightAfter(std::span<const planet::gl::RampStop> ramp, std::size_t index);

// Moves a stop, but not past its neighbours, so that the order stays.
void moveStop(Ramp& ramp, std::size_t index, double heightM);

// Black at the lowest height, white at the highest.
Ramp greyRamp(double lowestM, double highestM);
// As in atlases: deep blue to light blue up to 0, then green, yellow, brown and white, stretched over a
// planet's heights. lowestM <= highestM.
Ramp hypsometricRamp(double lowestM, double highestM);

}  // namespace worldy::ui
