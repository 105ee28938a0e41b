// Reads a place on the planet from typed text. Pure functions, any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace worldy::ui {

struct TypedPlace {
    double latitudeDeg = 0;   // [-90, 90], north
    double longitudeDeg = 0;  // [-180, 180], east
};

// Reads "27.99, 86.93", "27.99 86.93", "27.99N 86.93E", "70.45° W, 32.95° S": latitude first, unless the
// letters say otherwise. South and west are negative or have a letter, not both. None: it is no place.
std::optional<TypedPlace> typedPlace(std::string_view text);

// Returns why a text that looks like a place is none: "latitude 98 is out of range [-90, 90]°"; empty if it is
// a place, or does not look like one.
std::string typedPlaceProblem(std::string_view text);

}  // namespace worldy::ui
