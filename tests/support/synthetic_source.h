// Height sources made of a formula, for tests.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "planet/source/height_source.h"

namespace planet::test {

// A source whose height, in metres, is a function of the direction alone.
HeightSource formulaSource(std::function<double(const glm::dvec3& direction)> height, double minM,
                           double maxM, double stepM = 1, int naturalFaceSize = 129);

// Hills of several sizes, rough enough that every level differs from the next.
double hillsM(const glm::dvec3& d);
HeightSource hillsSource(int naturalFaceSize = 129);

}  // namespace planet::test
