// Messages to the user beside a command's report.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace worldy {

// Writes to standard error, any thread. Text that cannot be written is dropped: fmt::print would throw, and a
// full disk behind a log must not end a bake.
template <typename... Arguments>
void printMessage(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace worldy
