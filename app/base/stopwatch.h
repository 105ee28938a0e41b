// Measures wall time.
#pragma once

#include "planet/base/stopwatch.h"

namespace worldy {

using planet::Stopwatch;

}  // namespace worldy
