#include "planet/trace/trace_index.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "planet/base/try.h"

namespace planet {

tl::unexpected<Error> TraceFile::damaged(std::uint64_t offset, const std::string& what) const {
    return badInput(fmt::format("{}: byte {}: {}", name_, offset, what));
}

Result<TraceFile> TraceFile::open(const std::filesystem::path& path, const FileCalls& calls) {
    TRY_ASSIGN(auto file, OpenFile::open(path, O_RDONLY, calls));
    TraceFile trace(std::move(file), path.string());
    TRY_ASSIGN(const auto size, trace.file_.size());
    if (size < traceHeaderBytes)
        return trace.damaged(
            0, fmt::format("{} bytes are no trace; expected a file that lod_trace.h wrote", size));
    std::array<std::byte, traceHeaderBytes> header{};
    TRY(trace.file_.read(0, header));
    if (const auto checked = checkTraceHeader(header); !checked)
        return trace.damaged(0, checked.error().message);
    TRY(trace.refresh());
    return trace;
}

Result<std::size_t> TraceFile::refresh() {
    TRY_ASSIGN(const auto size, file_.size());
    problem_.reset();
    cut_.reset();
    std::array<std::byte, traceBlockHeaderBytes> bytes{};
    while (end_ < size) {
        const std::uint64_t left = size - end_;
        const bool hasHeader = left >= traceBlockHeaderBytes;
        if (hasHeader) TRY(file_.read(end_, bytes));
        const auto header = hasHeader ? traceBlockHeaderFrom(bytes) : TraceBlockHeader{};
        if (!header) {
            problem_ = damaged(end_, header.error().message).value().message;
            break;
        }
        if (!hasHeader || left - traceBlockHeaderBytes < header->bytes) {
            if (hasHeader) {
                cut_ = TraceBlock{end_, *header};
                cutBytes_ = static_cast<std::size_t>(left - traceBlockHeaderBytes);
            }
            problem_ =
                damaged(end_,
                        fmt::format("the trace ends {} bytes into a block; what came before is valid", left))
                    .value()
                    .message;
            break;
        }
        if (header->isKey) keys_.push_back(static_cast<std::uint32_t>(blocks_.size()));
        blocks_.push_back({end_, *header});
        end_ += traceBlockHeaderBytes + header->bytes;
    }
    return blocks_.size();
}

std::optional<TraceFrameRange> TraceFile::frames() const {
    const auto hasFrames = [](const TraceBlock& block) { return block.header.frames > 0; };
    const auto first = std::find_if(blocks_.begin(), blocks_.end(), hasFrames);
    if (first == blocks_.end()) return std::nullopt;
    const auto last = std::find_if(blocks_.rbegin(), blocks_.rend(), hasFrames);
    const auto firstOf = [](const TraceBlockHeader& header) {
        return header.frame + (header.isInside ? 1 : 0);
    };
    return TraceFrameRange{firstOf(first->header), firstOf(last->header) + last->header.frames - 1};
}

std::size_t TraceFile::keyBlockOf(std::uint64_t frame) const {
    const auto after =
        std::upper_bound(keys_.begin(), keys_.end(), frame,
                         [&](std::uint64_t at, std::uint32_t key) { return at < blocks_[key].header.frame; });
    return after == keys_.begin() ? 0 : *(after - 1);
}

// Decodes the definitions of the blocks from position_ up to a block.
Result<void> TraceFile::skipTo(std::size_t block, const TraceDecoder::Sink& sink) {
    std::vector<std::byte> bytes;
    for (; position_ < block; ++position_) {
        const TraceBlock& skipped = blocks_[position_];
        if (skipped.header.definitionBytes == 0) continue;
        bytes.resize(skipped.header.definitionBytes);
        TRY(file_.read(skipped.offset + traceBlockHeaderBytes, bytes));
        if (const auto decoded = decoder_.decodeDefinitions(bytes, sink); !decoded)
            return damaged(skipped.offset, decoded.error().message);
    }
    return {};
}

Result<void> TraceFile::seek(std::uint64_t frame, const TraceDecoder::Sink& sink) {
    const std::size_t block = keyBlockOf(frame);
    if (isLost_ || block < position_ || position_ == 0) {
        decoder_ = {};
        position_ = 0;
        sink(TraceRestarted{});
    }
    isCutRead_ = false;
    isLost_ = true;
    TRY(skipTo(block, sink));
    isLost_ = false;
    return {};
}

Result<bool> TraceFile::next(const TraceDecoder::Sink& sink) {
    if (position_ >= blocks_.size() || isCutRead_) return false;
    const TraceBlock& block = blocks_[position_];
    isLost_ = true;
    std::vector<std::byte> bytes(block.header.bytes);
    TRY(file_.read(block.offset + traceBlockHeaderBytes, bytes));
    if (const auto decoded = decoder_.decode(block.header, bytes, sink); !decoded)
        return damaged(block.offset, decoded.error().message);
    isLost_ = false;
    ++position_;
    return true;
}

Result<bool> TraceFile::nextCut(const TraceDecoder::Sink& sink) {
    if (!cut_ || isCutRead_ || position_ < blocks_.size()) return false;
    isCutRead_ = isLost_ = true;
    std::vector<std::byte> bytes(cutBytes_);
    TRY(file_.read(cut_->offset + traceBlockHeaderBytes, bytes));
    decoder_.decodePrefix(cut_->header, bytes, sink);
    return true;
}

}  // namespace planet
