// Colours as the text "#rrggbb". Pure functions, any thread.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace worldy {

// Reads red, green and blue, each in [0, 1]. Returns nothing if the text is no colour.
std::optional<glm::vec3> colourFromText(std::string_view text);
// Writes a colour, each channel clamped to [0, 1] and rounded to a step of 1 / 255.
std::string colourText(const glm::vec3& colour);

}  // namespace worldy
