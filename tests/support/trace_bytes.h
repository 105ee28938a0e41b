// Makes the bytes of traces by hand, also such as lod_trace.h never writes; planet/trace/README.md has the tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/trace/trace_format.h"

namespace planet::test {

using TraceBytes = std::vector<std::byte>;

inline TraceBytes bytes(std::initializer_list<int> values) {
    TraceBytes made;
    for (const int value : values) made.push_back(static_cast<std::byte>(value));
    return made;
}

inline TraceBytes joined(std::initializer_list<TraceBytes> parts) {
    TraceBytes made;
    for (const TraceBytes& part : parts) made.insert(made.end(), part.begin(), part.end());
    return made;
}

inline TraceBytes traceHeader(int version = traceVersion, int size = traceHeaderBytes) {
    TraceBytes made;
    for (const char letter : std::string_view("LODTRACE")) made.push_back(static_cast<std::byte>(letter));
    ByteWriter out(made);
    out.put(static_cast<std::uint16_t>(version));
    out.put(static_cast<std::uint16_t>(size));
    out.put(std::uint32_t{0});
    return made;
}

// Makes the header of a block with a checksum that matches.
inline TraceBytes traceBlockHeader(std::uint32_t bytes, std::uint32_t definitionBytes, std::uint32_t checksum,
                                   std::uint32_t flags = 1, std::uint64_t frame = 1) {
    TraceBytes made;
    for (const char letter : std::string_view("LTB1")) made.push_back(static_cast<std::byte>(letter));
    ByteWriter out(made);
    for (const std::uint32_t number : {bytes, definitionBytes, flags}) out.put(number);
    out.put(frame);
    out.put(std::uint64_t{1000});  // ns
    out.put(std::uint32_t{1});     // frames
    out.put(std::uint32_t{1});     // events
    out.put(checksum);
    out.put(traceChecksum(made));
    return made;
}

inline TraceBytes traceBlock(const TraceBytes& definitions, const TraceBytes& events) {
    const TraceBytes content = joined({definitions, events});
    return joined({traceBlockHeader(static_cast<std::uint32_t>(content.size()),
                                    static_cast<std::uint32_t>(definitions.size()), traceChecksum(content)),
                   content});
}

}  // namespace planet::test
