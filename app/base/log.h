// The log, which writes to the terminal and keeps lines for the log panel.
#pragma once

#include <spdlog/logger.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "app/base/log_lines.h"

namespace worldy {

// Any thread may write; one thread calls moveNewLines.
class Log {
public:
    Log();

    spdlog::logger& operator*() const { return *logger_; }
    spdlog::logger* operator->() const { return logger_.get(); }

    // Appends the lines logged since the last call, removes the oldest beyond keptLines, and returns how many of the
    // lines are new.
    std::size_t moveNewLines(std::deque<LogLine>& lines) const;

    static constexpr std::size_t keptLines = 2000;

private:
    class Sink;
    std::shared_ptr<Sink> sink_;
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace worldy
