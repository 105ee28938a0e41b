// Spans with known times, for tests of timelines.
#pragma once

#include "planet/spans/span_recorder.h"

namespace planet {

inline Span spanOf(const char* name, std::int64_t beginNs, std::int64_t endNs, int depth = 0) {
    Span span;
    span.name = name;
    span.beginNs = beginNs;
    span.endNs = endNs;
    span.depth = static_cast<std::uint8_t>(depth);
    return span;
}

}  // namespace planet
