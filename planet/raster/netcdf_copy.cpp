#include "planet/raster/netcdf_copy.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gdal.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <list>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>

#include "planet/base/installed_file.h"
#include "planet/base/try.h"
#include "planet/raster/netcdf_format.h"
#include "planet/raster/temporary_file.h"

namespace planet {

namespace {

constexpr std::size_t longestMessage = 2000;  // bytes
constexpr std::chrono::milliseconds stopIsSeenAfter{100};

// Says which file it was when it was copied.
struct FileState {
    std::filesystem::path path;
    dev_t device = 0;
    ino_t number = 0;
    off_t bytes = 0;
    std::int64_t changedS = 0;
    long changedNs = 0;

    friend bool operator==(const FileState&, const FileState&) = default;
};

Result<FileState> stateOf(const std::filesystem::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return ioError(fmt::format("{}: {}", path.string(), lastSystemError()));
    return FileState{path,           status.st_dev,         status.st_ino,
                     status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int number() const { return number_; }
    void close() {
        if (number_ >= 0) ::close(std::exchange(number_, -1));
    }

private:
    int number_;
};

// How a process ended, and the beginning of what it wrote to its standard error.
struct Ending {
    int status = 0;  // as waitpid says it
    std::string message;
};

// Reads a message until its writer has ended. Kills it if a stop is requested.
std::string readMessage(int descriptor, pid_t writer, const std::stop_token& stop) {
    std::string message;
    std::array<char, 512> part{};
    while (true) {
        pollfd input{descriptor, POLLIN, 0};
        if (::poll(&input, 1, static_cast<int>(stopIsSeenAfter.count())) <= 0) {
            if (stop.stop_requested()) ::kill(writer, SIGKILL);
            continue;
        }
        const ssize_t bytes = uninterrupted([&] { return ::read(descriptor, part.data(), part.size()); });
        if (bytes <= 0) break;
        message.append(part.data(), static_cast<std::size_t>(bytes));
        if (message.size() > longestMessage) message.resize(longestMessage);
    }
    return message;
}

Result<Ending> runProgram(std::string program, std::string file, int copy, const std::stop_token& stop) {
    const auto failed = [&](int problem) {
        return ioError(fmt::format("{}: {} cannot be started to read this netCDF file: {}", file, program,
                                   std::strerror(problem)));
    };
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return failed(errno);
    const Descriptor from(ends[0]);
    Descriptor to(ends[1]);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, to.number(), STDERR_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, copy, netcdfCopyDescriptor);
    const std::array<char*, 3> arguments = {program.data(), file.data(), nullptr};
    pid_t process = -1;
    const int problem =
        ::posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    to.close();
    if (problem != 0) return failed(problem);
    Ending ending;
    ending.message = readMessage(from.number(), process, stop);
    if (uninterrupted([&] { return ::waitpid(process, &ending.status, 0); }) < 0) return failed(errno);
    if (stop.stop_requested()) return cancelled();
    return ending;
}

Result<void> checkEnding(const std::string& file, const Ending& ending) {
    const auto unreadable = [&](std::string_view why) {
        return badInput(fmt::format("{}: is not a readable raster ({}); expected a netCDF file that is whole",
                                    file, why));
    };
    if (WIFSIGNALED(ending.status)) {
        const int number = WTERMSIG(ending.status);
        return unreadable(number == SIGXCPU ? "it keeps its reader busy for too long"
                                            : "truncated or damaged, so that its reader crashed");
    }
    switch (WEXITSTATUS(ending.status)) {
        case 0:
            return {};
        case netcdfRefused:
            return badInput(fmt::format("{}: {}", file, ending.message));
        default:
            return unreadable(ending.message.empty() ? "truncated or damaged" : ending.message);
    }
}

Result<std::shared_ptr<const NetcdfCopy>> makeCopy(const std::filesystem::path& path,
                                                   const std::stop_token& stop,
                                                   const std::filesystem::path& program) {
    TRY_ASSIGN(auto file, createTemporaryFile(systemFileCalls()));
    TRY_ASSIGN(const Ending ending, runProgram(program.string(), path.string(), file->descriptor(), stop));
    TRY(checkEnding(path.string(), ending));
    std::string name = fmt::format("/proc/self/fd/{}", file->descriptor());
    return std::make_shared<const NetcdfCopy>(NetcdfCopy{std::move(file), std::move(name)});
}

// The copies that are in use, and the last one.
class Copies {
public:
    Result<std::shared_ptr<const NetcdfCopy>> of(const std::filesystem::path& path,
                                                 const std::stop_token& stop,
                                                 const std::filesystem::path& program) {
        // Files are copied one after another, because each copy takes all processors.
        const std::lock_guard lock(mutex_);
        TRY_ASSIGN(FileState state, stateOf(path));
        known_.remove_if([](const Known& known) { return known.copy.expired(); });
        for (const Known& known : known_) {
            if (known.state != state) continue;
            if (auto copy = known.copy.lock()) return last_ = std::move(copy);
        }
        last_.reset();
        TRY_ASSIGN(last_, makeCopy(path, stop, program));
        known_.push_back({std::move(state), last_});
        return last_;
    }

private:
    struct Known {
        FileState state;
        std::weak_ptr<const NetcdfCopy> copy;
    };
    std::mutex mutex_;
    std::list<Known> known_;
    std::shared_ptr<const NetcdfCopy> last_;
};

}  // namespace

bool isNetcdf(const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return false;
    std::array<char, 8> start{};
    std::ifstream stream(path, std::ios::binary);
    stream.read(start.data(), start.size());
    const std::string_view text(start.data(), static_cast<std::size_t>(stream.gcount()));
    return text.starts_with("CDF") || text == "\x89HDF\r\n\x1a\n";
}

Result<std::shared_ptr<const NetcdfCopy>> copyOfNetcdf(const std::filesystem::path& path,
                                                       const std::stop_token& stop,
                                                       const std::filesystem::path& program) {
    static Copies copies;
    return copies.of(path, stop, program);
}

Result<std::shared_ptr<const NetcdfCopy>> copyOfNetcdf(const std::filesystem::path& path,
                                                       const std::stop_token& stop) {
    return copyOfNetcdf(path, stop, installedFile(netcdfProgram));
}

std::string netcdfReferenceSystem(void* dataSet) {
    const char* const text = GDALGetMetadataItem(dataSet, netcdfCrsItem, netcdfDomain);
    return text ? text : "";
}

}  // namespace planet
