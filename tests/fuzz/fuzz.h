// The common parts of the fuzzers: facts that must hold for any input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

#include "planet/base/result.h"

// libFuzzer defines it: changes bytes in place, and returns their new number.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace fuzz {

inline void require(bool holds, const char* fact) {
    if (holds) return;
    std::fprintf(stderr, "This does not hold: %s\n", fact);
    std::abort();
}

// Returns whether a value was read; a refusal must have a message.
template <class T>
bool isRead(const planet::Result<T>& result) {
    require(result || !result.error().message.empty(), "an Error has a message");
    return result.has_value();
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

inline std::span<const std::byte> bytesOf(const std::uint8_t* data, std::size_t size) {
    return std::as_bytes(std::span(data, size));
}

// Takes settings from the front of an input; gives zeros after its end.
class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    std::uint8_t byte() {
        if (left_.empty()) return 0;
        const std::uint8_t first = left_.front();
        left_ = left_.subspan(1);
        return first;
    }
    std::uint32_t number() {
        std::uint32_t value = 0;
        for (int i = 0; i < 4; ++i) value = value << 8 | byte();
        return value;
    }
    std::span<const std::byte> rest() const { return std::as_bytes(left_); }

private:
    std::span<const std::uint8_t> left_;
};

}  // namespace fuzz
