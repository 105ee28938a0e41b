// Measures wall time from its construction.
#pragma once

#include "planet/base/stopwatch.h"

namespace worldy {

using planet::Stopwatch;

}  // namespace worldy
