#include "app/base/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <ctime>
#include <mutex>
#include <utility>
#include <vector>

namespace worldy {

namespace {

LogLevel levelOf(spdlog::level::level_enum level) {
    if (level >= spdlog::level::err) return LogLevel::Error;
    if (level == spdlog::level::warn) return LogLevel::Warning;
    return level == spdlog::level::info ? LogLevel::Info : LogLevel::Debug;
}

spdlog::level::level_enum spdlogLevel(LogLevel level) {
    switch (level) {
        case LogLevel::Debug:
            return spdlog::level::debug;
        case LogLevel::Info:
            return spdlog::level::info;
        case LogLevel::Warning:
            return spdlog::level::warn;
        case LogLevel::Error:
            return spdlog::level::err;
    }
    return spdlog::level::err;
}

std::string clockText(spdlog::log_clock::time_point time) {
    const std::time_t seconds = spdlog::log_clock::to_time_t(time);
    std::tm local{};
    localtime_r(&seconds, &local);
    return fmt::format("{:02}:{:02}:{:02}", local.tm_hour, local.tm_min, local.tm_sec);
}

class LineSink : public spdlog::sinks::base_sink<std::mutex> {
public:
    std::vector<LogLine> takeLines() {
        const std::lock_guard lock(mutex_);
        return std::exchange(lines_, {});
    }

private:
    void sink_it_(const spdlog::details::log_msg& message) override {
        if (lines_.size() >= Log::keptLines) lines_.erase(lines_.begin());
        lines_.push_back({levelOf(message.level), clockText(message.time),
                          std::string(message.payload.data(), message.payload.size())});
    }
    void flush_() override {}

    std::vector<LogLine> lines_;
};

}  // namespace

struct Log::Output {
    std::shared_ptr<LineSink> lines = std::make_shared<LineSink>();
    std::shared_ptr<spdlog::sinks::stderr_color_sink_mt> terminal =
        std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    spdlog::logger logger{"worldy", {terminal, lines}};
};

Log::Log() : output_(std::make_shared<Output>()) {
    output_->terminal->set_pattern("worldy: %^%l%$: %v");
    output_->logger.set_level(spdlog::level::debug);
    output_->terminal->set_level(spdlog::level::info);
}

void Log::write(LogLevel level, std::string_view text) const {
    output_->logger.log(spdlogLevel(level), text);
}

std::size_t Log::moveNewLines(std::deque<LogLine>& lines) const {
    std::vector<LogLine> taken = output_->lines->takeLines();
    for (LogLine& line : taken) lines.push_back(std::move(line));
    while (lines.size() > keptLines) lines.pop_front();
    return taken.size();
}

}  // namespace worldy
