#include "planet/trace/trace_reader.h"

#include <fmt/format.h>

#include <utility>

#include "planet/base/try.h"

namespace planet {

TraceReader::TraceReader(std::string name, TraceDecoder::Sink sink, PartSink parts)
    : name_(std::move(name)), sink_(std::move(sink)), parts_(std::move(parts)) {}

tl::unexpected<Error> TraceReader::stop(const std::string& what) {
    error_ = Error{ErrorKind::BadInput, fmt::format("{}: byte {}: {}", name_, offset_, what)};
    buffer_ = {};
    used_ = 0;
    return tl::unexpected(*error_);
}

Result<void> TraceReader::feed(std::span<const std::byte> bytes) {
    if (error_) return tl::unexpected(*error_);
    fed_ += bytes.size();
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    const Result<void> taken = takeParts();
    if (!taken) return taken;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ = 0;
    return {};
}

Result<void> TraceReader::takeParts() {
    for (;;) {
        TRY_ASSIGN(const bool taken, takePart());
        if (!taken) return {};
    }
}

// Decodes the header or one block. Returns false if it is not whole yet.
Result<bool> TraceReader::takePart() {
    const auto left = std::span<const std::byte>(buffer_).subspan(used_);
    std::size_t bytes = traceHeaderBytes;
    if (!hasHeader_) {
        if (left.size() < bytes) return false;
        if (const auto checked = checkTraceHeader(left.first<traceHeaderBytes>()); !checked)
            return stop(checked.error().message);
        hasHeader_ = true;
    } else {
        if (left.size() < traceBlockHeaderBytes) return false;
        const auto header = traceBlockHeaderFrom(left.first<traceBlockHeaderBytes>());
        if (!header) return stop(header.error().message);
        bytes = traceBlockHeaderBytes + header->bytes;
        if (left.size() < bytes) return false;
        if (const auto decoded =
                decoder_.decode(*header, left.subspan(traceBlockHeaderBytes, header->bytes), sink_);
            !decoded)
            return stop(decoded.error().message);
    }
    if (parts_) parts_(left.first(bytes));
    used_ += bytes;
    offset_ += bytes;
    return true;
}

Result<void> TraceReader::finish() {
    if (error_) return tl::unexpected(*error_);
    const auto left = std::span<const std::byte>(buffer_);
    if (hasHeader_ && left.empty()) return {};
    if (hasHeader_ && left.size() >= traceBlockHeaderBytes) {
        // takePart has checked the header.
        const auto header = traceBlockHeaderFrom(left.first<traceBlockHeaderBytes>());
        if (header) decoder_.decodePrefix(*header, left.subspan(traceBlockHeaderBytes), sink_);
    }
    return stop(fmt::format("the trace ends {} bytes into a {}; what came before is valid", left.size(),
                            hasHeader_ ? "block" : "header"));
}

}  // namespace planet
