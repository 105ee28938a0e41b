// Reads a whole trace file from its first block on, and keeps where it is damaged or cut off.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planet/base/result.h"
#include "planet/trace/trace_format.h"
#include "planet/trace/trace_index.h"

namespace planet {

// How a trace ends.
struct TraceEnd {
    std::optional<std::string> problem{};  // where it is damaged or cut off; what came before was read
    bool isDamaged = false;                // of the problem: a block has wrong bytes
};

// Reads one block after another. It refers to the file, whose position it moves. One thread at a time.
class TraceBlocks {
public:
    explicit TraceBlocks(TraceFile& file) : file_(file), end_{file.problem(), false} {}

    // Moves to the first block.
    Result<void> begin(const TraceDecoder::Sink& sink) { return file_.seek(0, sink); }
    // Decodes the next block, or what there is of one that the file ends in. Returns false at the end, and where a block is
    // damaged.
    bool next(const TraceDecoder::Sink& sink);
    const TraceEnd& end() const { return end_; }

private:
    TraceFile& file_;
    TraceEnd end_;
};

// Reads all blocks of a file. goOn is called before each; returning false ends with an Error of the kind Cancelled.
// blockEnded is called after each block. Either can be empty.
Result<TraceEnd> readTrace(TraceFile& file, const std::function<bool()>& goOn, const TraceDecoder::Sink& sink,
                           const std::function<void()>& blockEnded = {});

}  // namespace planet
