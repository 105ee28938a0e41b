// Log lines for the log panel.
#pragma once

#include <cstdint>
#include <string>

namespace worldy {

enum class LogLevel : std::uint8_t { Debug, Info, Warning, Error };

struct LogLine {
    LogLevel level = LogLevel::Info;
    std::string time;  // "14:03:22"
    std::string text;
};

}  // namespace worldy
