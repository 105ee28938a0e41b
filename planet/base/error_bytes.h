// An Error as bytes, for messages between processes of the same program. Internal to the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/base/result.h"

namespace planet {

inline void putError(std::vector<std::byte>& out, const Error& error) {
    ByteWriter to(out);
    to.put(static_cast<std::uint8_t>(error.kind));
    to.put(static_cast<std::uint64_t>(error.message.size()));
    const auto message = std::as_bytes(std::span(error.message));
    out.insert(out.end(), message.begin(), message.end());
}

inline Error takeError(ByteReader& in) {
    const auto kind = static_cast<ErrorKind>(in.get<std::uint8_t>());
    const auto message = in.take(static_cast<std::size_t>(in.get<std::uint64_t>()));
    return {kind, std::string(reinterpret_cast<const char*>(message.data()), message.size())};
}

}  // namespace planet
