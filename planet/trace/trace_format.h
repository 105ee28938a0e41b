// Decodes the parts of a trace; README.md in this folder has the byte tables. The bytes are hostile: every size, index and
// text is checked before use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/trace/trace_events.h"

namespace planet {

inline constexpr std::uint16_t traceVersion = 1;
inline constexpr std::size_t traceHeaderBytes = 16;
inline constexpr std::size_t traceBlockHeaderBytes = 48;
// Limits: a stream that exceeds one is refused.
inline constexpr std::size_t maxTraceBlockBytes = std::size_t{128} << 20;  // without the header
inline constexpr std::size_t maxTraceNodes = std::size_t{1} << 22;
inline constexpr std::size_t maxTraceNames = 4096;
inline constexpr std::size_t maxTraceThreads = 64;
inline constexpr std::size_t maxTraceNameBytes = 255;
inline constexpr std::size_t maxTraceTextBytes = 4095;

struct TraceBlockHeader {
    std::uint32_t bytes = 0;            // after the header: definitions, then events
    std::uint32_t definitionBytes = 0;  // [0, bytes]
    bool isKey = false;
    bool isInside =
        false;  // the first event belongs to the frame, or follows its end; else it begins the frame
    std::uint64_t frame = 0;   // the frame that the first event begins or belongs to
    std::uint64_t ns = 0;      // the first time is told relative to it
    std::uint32_t frames = 0;  // that begin in the block
    std::uint32_t events = 0;
    std::uint32_t checksum = 0;  // of the bytes after the header
};

// Decode and check the headers. Pure, any thread. The Errors do not name the file.
Result<void> checkTraceHeader(std::span<const std::byte, traceHeaderBytes> bytes);
Result<TraceBlockHeader> traceBlockHeaderFrom(std::span<const std::byte, traceBlockHeaderBytes> bytes);

// Returns FNV-1a, 32 bits, of some bytes. Pure, any thread.
std::uint32_t traceChecksum(std::span<const std::byte> bytes);

// Decodes blocks one after the other. It remembers how many nodes and names are defined, so that events refer only to
// those. One thread at a time.
class TraceDecoder {
public:
    using Sink = std::function<void(const TraceEvent&)>;

    // Decodes the bytes after a block's header: all of them, or only the definitions. checksum: whether to check it. The
    // Error says at which byte of the block; events before it have gone to the sink.
    Result<void> decode(const TraceBlockHeader& header, std::span<const std::byte> bytes, const Sink& sink);
    Result<void> decodeDefinitions(std::span<const std::byte> definitions, const Sink& sink);
    // Decodes as much as there is of a block whose rest is missing: a prefix of its bytes.
    void decodePrefix(const TraceBlockHeader& header, std::span<const std::byte> bytes, const Sink& sink);

    std::size_t nodes() const { return nodes_; }
    std::size_t names() const { return names_; }

private:
    Result<void> decodeEvents(const TraceBlockHeader& header, std::span<const std::byte> events,
                              const Sink& sink);

    std::size_t nodes_ = 0;
    std::size_t names_ = 0;
};

}  // namespace planet
