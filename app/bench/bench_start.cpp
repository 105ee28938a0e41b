#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/bench/bench_parts.h"

namespace worldy {

namespace {

using planet::Result;

// Runs the program itself, without its output. Returns the milliseconds until it has ended.
Result<double> runProgram(const std::vector<std::string>& arguments) {
    std::vector<char*> pointers;
    std::string name = "worldy";
    pointers.push_back(name.data());
    std::vector<std::string> texts = arguments;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const Stopwatch watch;
    pid_t child = 0;
    const int problem = ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (problem != 0 || ::waitpid(child, &status, 0) != child) {
        return planet::ioError(fmt::format("worldy {}: cannot be started: {}", fmt::join(arguments, " "),
                                           std::strerror(problem)));
    }
    const double ms = watch.elapsedMs();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return planet::badInput(fmt::format("worldy {}: failed", fmt::join(arguments, " ")));
    return ms;
}

}  // namespace

BenchRows benchStart(const BenchPlanet& planet, const BenchOptions& options,
                     const std::filesystem::path& folder) {
    struct Command {
        const char* subject;
        std::vector<std::string> arguments;
        double mostMs;
    };
    const std::string file = planet.chunkFile.string();
    const std::vector<Command> commands = {
        {"worldy --version", {"--version"}, 30},
        {"worldy info FILE", {"info", file}, 30},
        {"worldy shot FILE", {"shot", file, "-o", (folder / "start.png").string()}, 1000}};
    std::vector<BenchRow> rows;
    for (const Command& command : commands) {
        std::vector<double> ms;
        // The first run reads the libraries from the disk.
        for (int round = -1; round < options.rounds; ++round) {
            const Result<double> ended = runProgram(command.arguments);
            if (!ended) return tl::unexpected(ended.error());
            if (round >= 0) ms.push_back(*ended);
        }
        BenchRow time{command.subject, "from start to end", "ms", spreadOf(ms)};
        time.aim = {.bound = command.mostMs};
        rows.push_back(std::move(time));
    }
    return rows;
}

}  // namespace worldy
