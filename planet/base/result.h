// Errors as values, with a message that a user can act on. Bad data and failing disks return an Error; misuse
// by the calling code asserts.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace planet {

enum class ErrorKind {
    BadInput,   // a file or option is invalid
    Io,         // reading or writing failed
    Cancelled,  // the caller's progress callback asked to stop
};

struct Error {
    ErrorKind kind = ErrorKind::BadInput;
    std::string message;  // names the file or option, the problem and the expected value
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> badInput(std::string message) {
    return tl::unexpected(Error{ErrorKind::BadInput, std::move(message)});
}
inline tl::unexpected<Error> ioError(std::string message) {
    return tl::unexpected(Error{ErrorKind::Io, std::move(message)});
}
inline tl::unexpected<Error> cancelled() {
    return tl::unexpected(Error{ErrorKind::Cancelled, "cancelled"});
}

}  // namespace planet
