// The log, which writes to the terminal and keeps lines for the log panel. spdlog is included in log.cpp alone, because a
// call of its templates compiles all of fmt's formatting again.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <string_view>

#include "app/base/log_lines.h"

namespace worldy {

// Any thread may write; one thread calls moveNewLines.
class Log {
public:
    Log();

    void write(LogLevel level, std::string_view text) const;

    // The arguments are those of fmt::format.
    template <typename... Args>
    void debug(fmt::format_string<const Args&...> format, const Args&... args) const {
        write(LogLevel::Debug, fmt::format(format, args...));
    }
    template <typename... Args>
    void info(fmt::format_string<const Args&...> format, const Args&... args) const {
        write(LogLevel::Info, fmt::format(format, args...));
    }
    template <typename... Args>
    void warn(fmt::format_string<const Args&...> format, const Args&... args) const {
        write(LogLevel::Warning, fmt::format(format, args...));
    }
    template <typename... Args>
    void error(fmt::format_string<const Args&...> format, const Args&... args) const {
        write(LogLevel::Error, fmt::format(format, args...));
    }

    // Appends the lines logged since the last call, removes the oldest beyond keptLines, and returns how many of the
    // lines are new.
    std::size_t moveNewLines(std::deque<LogLine>& lines) const;

    static constexpr std::size_t keptLines = 2000;

private:
    struct Output;
    std::shared_ptr<Output> output_;
};

}  // namespace worldy
