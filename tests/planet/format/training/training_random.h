// Makes the random numbers of the training, which are the same in every run and with every compiler.
#pragma once

#include <cstdint>
#include <random>

namespace planet::training {

// The generator of "Numerical Recipes". Its low bits are poor: use the high ones.
using Random = std::linear_congruential_engine<std::uint32_t, 1664525, 1013904223, 0>;

}  // namespace planet::training
