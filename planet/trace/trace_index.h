// Opens a trace file of any size and reads it from any frame on. Opening reads only the headers of the blocks, 48 bytes in
// about 50 KiB; seeking reads the definitions before the frame, which the file holds once, and at most about 256 frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"
#include "planet/trace/trace_format.h"

namespace planet {

struct TraceBlock {
    std::uint64_t offset = 0;  // of its header in the file
    TraceBlockHeader header;
};

// The frames that a file has, by number. Lost frames can make `last` too small.
struct TraceFrameRange {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
};

// Owns the open file. The file may still grow while an engine writes it. One thread at a time.
class TraceFile {
public:
    // Opens the file and lists its blocks. A file that ends inside a block, or that is damaged, opens with the blocks before;
    // problem() then says what is wrong. The Error names the file.
    static Result<TraceFile> open(const std::filesystem::path& path,
                                  const FileCalls& calls = systemFileCalls());

    // Lists the blocks that were written since. Returns how many there are.
    Result<std::size_t> refresh();

    const std::vector<TraceBlock>& blocks() const { return blocks_; }
    const std::optional<std::string>& problem() const { return problem_; }
    std::optional<TraceFrameRange> frames() const;  // nothing if the file has none

    // Moves to the last key block at or before a frame, or to the first block. Definitions that the sink lacks go to it: those
    // up to there after a TraceRestarted, or, forwards, only those in between. The frames from the key block on follow by next().
    Result<void> seek(std::uint64_t frame, const TraceDecoder::Sink& sink);

    // Decodes the next whole block. Returns false at the end. After an Error, seek before the next call.
    Result<bool> next(const TraceDecoder::Sink& sink);

    // After the last whole block, decodes what there is of a block in which the file ends, without its checksum. Returns false
    // if there is no such block or if it was decoded already. Call it if the file does not grow any more: next() returns false
    // from then on, until a seek.
    Result<bool> nextCut(const TraceDecoder::Sink& sink);

private:
    TraceFile(OpenFile file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}
    std::size_t keyBlockOf(std::uint64_t frame) const;
    Result<void> skipTo(std::size_t block, const TraceDecoder::Sink& sink);
    tl::unexpected<Error> damaged(std::uint64_t offset, const std::string& what) const;

    OpenFile file_;
    std::string name_;
    std::vector<TraceBlock> blocks_;
    std::vector<std::uint32_t> keys_;       // blocks that are keys, ascending
    std::uint64_t end_ = traceHeaderBytes;  // of the whole blocks
    std::optional<TraceBlock> cut_;  // the block after them, if its header is whole and its rest is not
    std::size_t cutBytes_ = 0;       // of it, after its header
    std::optional<std::string> problem_;
    TraceDecoder decoder_;
    std::size_t position_ = 0;  // the next block
    bool isLost_ = false;       // an Error or a cut block left the decoder between two states
    bool isCutRead_ = false;    // since the last seek
};

}  // namespace planet
