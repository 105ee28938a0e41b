// Messages to the user on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace worldy {

// Writes to standard error, from any thread. Text that cannot be written is dropped: fmt::print would throw,
// and a full disk behind a redirected log must not end a bake.
template <typename... Arguments>
void printMessage(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace worldy
