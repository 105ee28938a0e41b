// Reads a trace as a stream, such as a socket gives it: feed bytes in pieces of any size, get events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/trace/trace_format.h"

namespace planet {

// Events go to the sink block by block, when a block is whole and its checksum matches. The limits of trace_format.h apply;
// the memory in use is at most a block. One thread at a time.
class TraceReader {
public:
    // Takes the bytes of the header, and of each whole block after its events went to the sink. They are checked; the span is
    // valid during the call.
    using PartSink = std::function<void(std::span<const std::byte>)>;

    // name: of the file or address, for messages.
    TraceReader(std::string name, TraceDecoder::Sink sink, PartSink parts = {});

    // Takes the next bytes. The Error names the byte of the stream and what is wrong there. What came before it has gone to
    // the sink; nothing that comes after is read, and later calls return the same Error.
    Result<void> feed(std::span<const std::byte> bytes);

    // Ends the stream. If it ends inside a block, the events that are whole go to the sink, and the Error says where it
    // ends: what came before is valid.
    Result<void> finish();

    // Returns what came of the part that is not whole yet; empty after an Error. Valid until the next call.
    std::span<const std::byte> unfinished() const { return buffer_; }

    std::uint64_t bytes() const { return fed_; }            // fed so far
    std::uint64_t checkedBytes() const { return offset_; }  // of them, the header and all whole blocks

private:
    Result<void> takeParts();
    Result<bool> takePart();
    tl::unexpected<Error> stop(const std::string& what);

    std::string name_;
    TraceDecoder::Sink sink_;
    PartSink parts_;
    TraceDecoder decoder_;
    std::vector<std::byte> buffer_;  // from `used_` on: what is not decoded yet
    std::size_t used_ = 0;
    std::uint64_t fed_ = 0;
    std::uint64_t offset_ = 0;  // of buffer_[used_] in the stream
    bool hasHeader_ = false;
    std::optional<Error> error_;
};

}  // namespace planet
