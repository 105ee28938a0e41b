// Converts numbers to and from bytes, little-endian on every machine and at any alignment. Any thread.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <type_traits>
#include <vector>

namespace planet {

namespace detail {
template <std::size_t size>
struct UnsignedOfSize;
template <>
struct UnsignedOfSize<1> {
    using Type = std::uint8_t;
};
template <>
struct UnsignedOfSize<2> {
    using Type = std::uint16_t;
};
template <>
struct UnsignedOfSize<4> {
    using Type = std::uint32_t;
};
template <>
struct UnsignedOfSize<8> {
    using Type = std::uint64_t;
};
}  // namespace detail

template <class T>
concept Number = std::integral<T> || std::floating_point<T>;

// Reads a number from the first sizeof(T) bytes.
template <Number T>
T readLittleEndian(const std::byte* from) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::to_integer<std::uint64_t>(from[i]) << (8 * i);
    return std::bit_cast<T>(static_cast<typename detail::UnsignedOfSize<sizeof(T)>::Type>(bits));
}

// Appends numbers to bytes.
class ByteWriter {
public:
    explicit ByteWriter(std::vector<std::byte>& out) : out_(out) {}

    template <Number T>
    void put(T value) {
        using Bits = typename detail::UnsignedOfSize<sizeof(T)>::Type;
        const auto bits = std::bit_cast<Bits>(value);
        std::array<std::byte, sizeof(T)> bytes;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            bytes[i] = static_cast<std::byte>(static_cast<std::uint64_t>(bits) >> (8 * i));
        }
        out_.insert(out_.end(), bytes.begin(), bytes.end());
    }

    // Appends a number in groups of 7 bits, the lowest first. Bit 7 of a byte says that another one follows (LEB128).
    void putVariable(std::uint64_t value) {
        for (; value >= 128; value >>= 7) put(static_cast<std::uint8_t>(value | 128));
        put(static_cast<std::uint8_t>(value));
    }

    // The same of a signed number, whose sign becomes the lowest bit.
    void putVariableSigned(std::int64_t value) {
        const auto bits = static_cast<std::uint64_t>(value);
        putVariable(value < 0 ? ~bits << 1 | 1 : bits << 1);
    }

private:
    std::vector<std::byte>& out_;
};

// Why a number of ByteWriter::putVariable cannot be read: the bytes end before it does; or it exceeds 64 bits, or takes
// more bytes than the writer would use.
enum class VariableProblem : std::uint8_t { Truncated, OutOfRange };

// Reads numbers one after the other. The caller has checked that there are enough bytes.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <Number T>
    T get() {
        assert(bytes_.size() >= sizeof(T));
        return readLittleEndian<T>(take(sizeof(T)).data());
    }

    // Return a number of ByteWriter::putVariable and putVariableSigned. Each number has one code, so that readers which see
    // a different part of the bytes that follow agree.
    tl::expected<std::uint64_t, VariableProblem> getVariable() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            if (bytes_.empty()) return tl::unexpected(VariableProblem::Truncated);
            const auto group = get<std::uint8_t>();
            const std::uint64_t bits = group & 127u;
            const bool isNeedless = group == 0 && shift > 0;
            if (isNeedless || bits << shift >> shift != bits) break;
            value |= bits << shift;
            if (group < 128) return value;
        }
        return tl::unexpected(VariableProblem::OutOfRange);
    }

    tl::expected<std::int64_t, VariableProblem> getVariableSigned() {
        const auto coded = getVariable();
        if (!coded) return tl::unexpected(coded.error());
        const std::uint64_t bits = *coded >> 1;
        return static_cast<std::int64_t>((*coded & 1) == 0 ? bits : ~bits);
    }

    std::span<const std::byte> take(std::size_t count) {
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }

    std::span<const std::byte> rest() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
};

}  // namespace planet
