// What the whole program takes, as the system sees it.
#pragma once

#include <cstddef>

namespace worldy {

// Resident memory, bytes; 0 where the system does not tell.
std::size_t residentProcessBytes();

}  // namespace worldy
