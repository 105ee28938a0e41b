#include "app/base/log.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <ctime>
#include <utility>

namespace worldy {

namespace {

LogLevel levelOf(spdlog::level::level_enum level) {
    if (level >= spdlog::level::err) return LogLevel::Error;
    if (level == spdlog::level::warn) return LogLevel::Warning;
    return level == spdlog::level::info ? LogLevel::Info : LogLevel::Debug;
}

std::string clockText(spdlog::log_clock::time_point time) {
    const std::time_t seconds = spdlog::log_clock::to_time_t(time);
    std::tm local{};
    localtime_r(&seconds, &local);
    return fmt::format("{:02}:{:02}:{:02}", local.tm_hour, local.tm_min, local.tm_sec);
}

}  // namespace

class Log::Sink : public spdlog::sinks::base_sink<std::mutex> {
public:
    std::vector<LogLine> takeLines() {
        const std::lock_guard lock(mutex_);
        return std::exchange(lines_, {});
    }

private:
    void sink_it_(const spdlog::details::log_msg& message) override {
        if (lines_.size() >= keptLines) lines_.erase(lines_.begin());
        lines_.push_back({levelOf(message.level), clockText(message.time),
                          std::string(message.payload.data(), message.payload.size())});
    }
    void flush_() override {}

    std::vector<LogLine> lines_;
};

Log::Log() : sink_(std::make_shared<Sink>()) {
    const auto terminal = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    terminal->set_pattern("worldy: %^%l%$: %v");
    logger_ = std::make_shared<spdlog::logger>("worldy", spdlog::sinks_init_list{terminal, sink_});
    logger_->set_level(spdlog::level::debug);
    terminal->set_level(spdlog::level::info);
}

std::size_t Log::moveNewLines(std::deque<LogLine>& lines) const {
    std::vector<LogLine> taken = sink_->takeLines();
    for (LogLine& line : taken) lines.push_back(std::move(line));
    while (lines.size() > keptLines) lines.pop_front();
    return taken.size();
}

}  // namespace worldy
