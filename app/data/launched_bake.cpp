#include "app/data/launched_bake.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "planet/format/chunk_file.h"

namespace worldy {

namespace {

using planet::Result;

std::string quoted(std::string_view text) {
    std::string result = "'";
    for (const char letter : text) result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return result + "'";
}

class Arguments {
public:
    void add(std::string_view text) { text_ += ' ' + quoted(text); }
    template <class T>
    void add(const char* option, const std::optional<T>& value) {
        if (!value) return;
        add(option);
        add(fmt::format("{}", *value));
    }
    void addIf(bool isSet, const char* option) {
        if (isSet) add(option);
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

// A command whose output is read while it runs, in a process group of its own.
class RunningCommand {
public:
    static Result<RunningCommand> start(const std::string& command) {
        RunningCommand running;
        for (auto* pipe : {&running.output_, &running.errors_}) {
            if (::pipe2(pipe->data(), O_CLOEXEC) != 0) return failed(command);
        }
        posix_spawn_file_actions_t actions;
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, running.output_[1], STDOUT_FILENO);
        ::posix_spawn_file_actions_adddup2(&actions, running.errors_[1], STDERR_FILENO);
        posix_spawnattr_t attributes;
        ::posix_spawnattr_init(&attributes);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        std::array<std::string, 3> words = {"sh", "-c", command};
        const std::array<char*, 4> arguments = {words[0].data(), words[1].data(), words[2].data(), nullptr};
        const int problem =
            ::posix_spawn(&running.process_, "/bin/sh", &actions, &attributes, arguments.data(), environ);
        ::posix_spawnattr_destroy(&attributes);
        ::posix_spawn_file_actions_destroy(&actions);
        for (auto* pipe : {&running.output_, &running.errors_}) ::close(std::exchange((*pipe)[1], -1));
        if (problem != 0) {
            errno = problem;
            running.process_ = -1;
            return failed(command);
        }
        return running;
    }
    RunningCommand(RunningCommand&& other) noexcept
        : process_(std::exchange(other.process_, -1)),
          output_(std::exchange(other.output_, {-1, -1})),
          errors_(std::exchange(other.errors_, {-1, -1})) {}
    RunningCommand& operator=(RunningCommand&&) = delete;
    ~RunningCommand() {
        if (process_ > 0) {
            signal(SIGKILL);
            wait();
        }
        for (const auto& pipe : {output_, errors_}) {
            for (const int end : pipe) {
                if (end >= 0) ::close(end);
            }
        }
    }

    void signal(int number) const { ::kill(-process_, number); }

    // Reads what has come, for at most `wait`. Returns false once both streams have ended.
    bool read(std::chrono::milliseconds wait, std::string& output, std::string& errors) {
        std::array<pollfd, 2> ends = {{{output_[0], POLLIN, 0}, {errors_[0], POLLIN, 0}}};
        if (::poll(ends.data(), ends.size(), static_cast<int>(wait.count())) <= 0) return true;
        take(ends[0], output_[0], output);
        take(ends[1], errors_[0], errors);
        return output_[0] >= 0 || errors_[0] >= 0;
    }

    // Returns the exit code; 128 and the signal that has ended it.
    int wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

private:
    RunningCommand() = default;

    static tl::unexpected<planet::Error> failed(const std::string& command) {
        return planet::ioError(
            fmt::format("{}: cannot be started: {}", command, std::generic_category().message(errno)));
    }

    // A closed end is skipped by poll.
    static void take(const pollfd& end, int& descriptor, std::string& text) {
        if (descriptor < 0 || end.revents == 0) return;
        std::array<char, 4096> bytes{};
        const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
        if (count > 0)
            text.append(bytes.data(), static_cast<std::size_t>(count));
        else if (count == 0 || errno != EINTR)
            ::close(std::exchange(descriptor, -1));
    }

    pid_t process_ = -1;
    std::array<int, 2> output_ = {-1, -1};  // pipes: what is read, and what is written
    std::array<int, 2> errors_ = {-1, -1};
};

template <class T>
T numberIn(const nlohmann::json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_number() ? found->get<T>() : T();
}

// Returns the progress that a line tells, if it does.
std::optional<planet::JobProgress> progressIn(const std::string& line) {
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object() || !json.contains("samples_total")) return std::nullopt;
    planet::JobProgress progress;
    progress.bake.samplesDone = numberIn<std::uint64_t>(json, "samples_done");
    progress.bake.samplesTotal = numberIn<std::uint64_t>(json, "samples_total");
    progress.bake.elapsedS = numberIn<double>(json, "elapsed_s");
    progress.bake.samplesPerS = numberIn<double>(json, "samples_per_s");
    progress.bake.remainingS = numberIn<double>(json, "remaining_s");
    progress.unitsDone = numberIn<std::uint64_t>(json, "units_done");
    progress.unitsTotal = numberIn<std::uint64_t>(json, "units_total");
    progress.ranks = numberIn<int>(json, "ranks");
    progress.slowestRank = numberIn<int>(json, "slowest_rank");
    progress.slowestSamplesPerS = numberIn<double>(json, "slowest_samples_per_s");
    return progress;
}

// Returns what the command says that is wrong: its last message, or else its last lines.
std::string problemOf(const std::deque<std::string>& lines, const std::string& launcher, int exitCode) {
    constexpr std::string_view ours = "worldy: ";
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
        if (line->starts_with(ours)) return line->substr(ours.size());
    }
    std::string text = fmt::format("{}: ended with exit code {}", launcher, exitCode);
    for (const std::string& line : lines) text += "\n" + line;
    return text;
}

Result<planet::BakeReport> reportOf(const std::string& output, const BakeTask& task) {
    const auto file = planet::ChunkFile::open(task.output);
    if (!file) return tl::unexpected(file.error());
    const nlohmann::json json = nlohmann::json::parse(output, nullptr, false);
    if (!json.is_object())
        return planet::badInput(
            "the launched bake printed no report; expected a launcher that passes on what is "
            "printed");
    planet::BakeReport report;
    report.shape = file->info().shape;
    report.samples = sampleCountOf(file->info());
    report.chunks = file->info().chunks;
    report.coarsestLeafLevel = file->info().coarsestLeafLevel;
    report.missingSamples = file->info().missingSamples;
    report.fileBytes = file->sizeBytes();
    report.largestDeltaCM = numberIn<float>(json, "root_delta_c_m");
    report.largestDeltaTightM = numberIn<float>(json, "root_tight_m");
    report.colourTiles = numberIn<std::uint64_t>(json, "colour_tiles");
    report.colourBytes = numberIn<std::uint64_t>(json, "colour_bytes");
    report.sampledCells = numberIn<std::uint64_t>(json, "sampled_cells");
    report.seconds = numberIn<double>(json, "seconds");
    return report;
}

}  // namespace

std::string launchedCommand(const std::string& launcher, const BakeTask& task) {
    std::error_code status;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", status);
    const planet::BakeSettings& bake = task.settings;
    const planet::HeightSourceSettings& source = task.sourceSettings;
    Arguments arguments;
    arguments.add(program.string());
    arguments.add("bake");
    arguments.add(task.source.string());
    arguments.add("--output", std::optional(task.output.string()));
    arguments.add("--face-size", bake.faceSize);
    arguments.add("--chunk-size", std::optional(bake.chunkSize));
    arguments.add("--radius", std::optional(bake.radiusM));
    arguments.add("--quantum", bake.quantumM);
    arguments.add("--finest-quantum", bake.finestQuantumM);
    arguments.add("--threads", std::optional(bake.threads));
    arguments.add("--compression-level", std::optional(bake.compressionLevel));
    if (!task.colour.image.empty()) {
        arguments.add("--colour", std::optional(task.colour.image.string()));
        arguments.add("--colour-face-size", bake.colour.faceSize);
        const bool isLossless = bake.colour.format == planet::ColourFormat::Lossless;
        arguments.add("--colour-format", std::optional(isLossless ? "lossless" : "bc1"));
    }
    arguments.add("--metres-per-unit", source.metresPerUnit);
    arguments.add("--offset", source.offsetM);
    arguments.add("--no-data", source.noDataValue);
    arguments.add("--fill", std::optional(source.fillM));
    arguments.add("--raw-size", source.rawSize);
    arguments.add("--raw-bits", source.rawBits);
    arguments.addIf(source.rawSigned, "--raw-signed");
    arguments.addIf(source.rawBigEndian, "--raw-big-endian");
    arguments.addIf(source.skipBroken, "--skip-broken");
    for (const char* option : {"--resume", "--json", "--progress-json"}) arguments.add(option);
    return "exec " + launcher + arguments.text();
}

Result<planet::BakeReport> runLaunchedBake(
    const std::string& launcher, const BakeTask& task, const std::stop_token& stop,
    const std::function<void(const planet::JobProgress&)>& onProgress) {
    constexpr std::chrono::milliseconds readAtOnce{50};
    constexpr std::chrono::seconds patience{5};  // after an interrupt
    constexpr std::size_t keptLines = 20;
    Result<RunningCommand> running = RunningCommand::start(launchedCommand(launcher, task));
    if (!running) return tl::unexpected(running.error());
    std::string output;
    std::string errors;
    std::deque<std::string> lines;
    std::optional<std::chrono::steady_clock::time_point> interrupted;
    bool killed = false;
    while (running->read(readAtOnce, output, errors)) {
        for (std::size_t end = errors.find('\n'); end != std::string::npos; end = errors.find('\n')) {
            const std::string line = errors.substr(0, end);
            errors.erase(0, end + 1);
            if (const auto progress = progressIn(line)) {
                onProgress(*progress);
                continue;
            }
            lines.push_back(line);
            if (lines.size() > keptLines) lines.pop_front();
        }
        if (!stop.stop_requested()) continue;
        const auto now = std::chrono::steady_clock::now();
        if (!interrupted) {
            interrupted = now;
            running->signal(SIGINT);
        } else if (!killed && now - *interrupted > patience) {
            killed = true;
            running->signal(SIGKILL);
        }
    }
    const int exitCode = running->wait();
    if (stop.stop_requested()) return planet::cancelled();
    if (exitCode != 0) return planet::ioError(problemOf(lines, launcher, exitCode));
    return reportOf(output, task);
}

}  // namespace worldy
