#include "app/cli/attach_command.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/report.h"
#include "app/base/text.h"
#include "planet/trace/trace_link.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using planet::Result;
using planet::TraceLinkState;
using planet::TraceLinkStatus;

constexpr const char* traceExtension = ".lodtrace";

Result<planet::TraceLinkSettings> linkSettings(const AttachOptions& options) {
    planet::TraceLinkSettings settings;
    settings.port = options.port;
    settings.isOnce = options.isOnce;
    settings.name = fmt::format("engine-{}", options.port);
    settings.folder = options.out;
    std::error_code ignored;
    if (options.out.empty() || fs::is_directory(options.out, ignored)) return settings;
    if (options.out.extension() != traceExtension)
        return planet::badInput(
            fmt::format("{}: is no folder; expected a folder, or a new file that ends in {}",
                        options.out.string(), traceExtension));
    if (fs::exists(fs::symlink_status(options.out, ignored)))
        return planet::badInput(fmt::format(
            "{}: exists already, and no trace is replaced; expected a new name", options.out.string()));
    settings.name = options.out.stem().string();
    settings.folder = options.out.parent_path();
    return settings;
}

// Prints a line for each change. A message that only counts on is no change.
class StatusLines {
public:
    void take(const TraceLinkStatus& status) {
        const bool counts =
            status.state == TraceLinkState::Silent || status.state == TraceLinkState::Connected;
        const bool isNew = status.state != state_ || (!counts && status.message != message_);
        if (status.problem && status.problem != problem_) printMessage("worldy: {}\n", *status.problem);
        if (isNew && status.state != TraceLinkState::Ended && status.state != TraceLinkState::Failed)
            printMessage("worldy: {}\n", status.message);
        state_ = status.state;
        message_ = status.message;
        problem_ = status.problem;
    }

private:
    std::optional<TraceLinkState> state_;
    std::string message_;
    std::optional<std::string> problem_;
};

void receive(const AttachOptions& options, planet::TraceLink& link) {
    using Clock = std::chrono::steady_clock;
    const InterruptWatch watch;
    const auto start = Clock::now();
    StatusLines lines;
    for (;;) {
        const TraceLinkStatus status = link.status();
        lines.take(status);
        const bool isOver = status.state == TraceLinkState::Ended || status.state == TraceLinkState::Failed;
        const bool isLate = options.seconds &&
                            std::chrono::duration<double>(Clock::now() - start).count() >= *options.seconds;
        if (isOver || isLate || watch.interrupted()) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    link.stop();
    lines.take(link.status());
}

void printSummary(const std::vector<planet::TraceLinkFile>& files) {
    for (const planet::TraceLinkFile& file : files) {
        fmt::print("{}: {}, {}, {}, {} dropped by the engine\n", file.path.string(),
                   countedText(file.frames, "frame"), countedText(file.nodes, "node"),
                   bytesText(static_cast<double>(file.bytes)), countedText(file.dropped, "event"));
    }
}

Json summaryJson(const AttachOptions& options, const TraceLinkStatus& status,
                 const std::vector<planet::TraceLinkFile>& files) {
    Json json = {{"port", options.port}, {"frames", status.frames}, {"bytes", status.bytes}};
    json["trace"] = Json::array();
    for (const planet::TraceLinkFile& file : files)
        json["trace"].push_back({{"file", file.path.string()},
                                 {"frames", file.frames},
                                 {"nodes", file.nodes},
                                 {"bytes", file.bytes},
                                 {"dropped_events", file.dropped}});
    json["problem"] = status.problem ? Json(*status.problem) : Json(nullptr);
    return json;
}

}  // namespace

Result<bool> runAttach(const AttachOptions& options) {
    const Result<std::unique_ptr<planet::TraceLink>> link =
        linkSettings(options).and_then(planet::TraceLink::start);
    if (!link) return tl::unexpected(link.error());
    receive(options, **link);
    const TraceLinkStatus status = (*link)->status();
    const std::vector<planet::TraceLinkFile> files = (*link)->files();
    if (!options.json) printSummary(files);
    if (Result<void> written = writeReport({.json = options.json}, summaryJson(options, status, files));
        !written)
        return tl::unexpected(std::move(written).error());
    if (status.state == TraceLinkState::Failed) return planet::ioError(status.message);
    if (files.empty()) printMessage("worldy: {}\n", status.message);
    return !files.empty();
}

}  // namespace worldy
