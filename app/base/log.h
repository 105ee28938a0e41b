// The log: to the terminal, and into the lines that the log panel shows.
#pragma once

#include <spdlog/logger.h>

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "app/base/log_lines.h"

namespace worldy {

// Writing is safe from any thread; moveNewLines is for the one that shows them.
class Log {
public:
    Log();

    spdlog::logger& operator*() const { return *logger_; }
    spdlog::logger* operator->() const { return logger_.get(); }

    // Appends what was logged since the last call, and forgets the oldest lines beyond keptLines.
    void moveNewLines(std::deque<LogLine>& lines);

    static constexpr std::size_t keptLines = 2000;

private:
    class Sink;
    std::shared_ptr<Sink> sink_;
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace worldy
