#include "app/base/log.h"

#include <gtest/gtest.h>

#include <thread>

namespace worldy {
namespace {

TEST(Log, LinesKeepTheirLevelAndOrder) {
    Log log;
    log.debug("one");
    log.warn("two {}", 2);
    log.error("three");
    std::deque<LogLine> lines;
    log.moveNewLines(lines);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].level, LogLevel::Debug);
    EXPECT_EQ(lines[1].level, LogLevel::Warning);
    EXPECT_EQ(lines[1].text, "two 2");
    EXPECT_EQ(lines[2].level, LogLevel::Error);
    EXPECT_EQ(lines[0].time.size(), 8u);
    log.moveNewLines(lines);
    EXPECT_EQ(lines.size(), 3u);
}

TEST(Log, ForgetsTheOldestLines) {
    Log log;
    std::deque<LogLine> lines;
    for (std::size_t i = 0; i < 3 * Log::keptLines; ++i) {
        log.debug("{}", i);
        if (i == Log::keptLines / 2) log.moveNewLines(lines);
    }
    log.moveNewLines(lines);
    ASSERT_EQ(lines.size(), Log::keptLines);
    EXPECT_EQ(lines.back().text, std::to_string(3 * Log::keptLines - 1));
    EXPECT_EQ(lines.front().text, std::to_string(2 * Log::keptLines));
}

TEST(Log, TakesLinesFromSeveralThreads) {
    Log log;
    std::thread other([&] {
        for (int i = 0; i < 500; ++i) log.debug("other");
    });
    std::deque<LogLine> lines;
    for (int i = 0; i < 500; ++i) {
        log.debug("own");
        log.moveNewLines(lines);
    }
    other.join();
    log.moveNewLines(lines);
    EXPECT_EQ(lines.size(), 1000u);
}

}  // namespace
}  // namespace worldy
