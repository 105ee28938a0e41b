#include "planet/trace/trace_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <mutex>
#include <span>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

#include "planet/base/open_file.h"
#include "planet/base/try.h"
#include "planet/trace/trace_reader.h"

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::string_view traceMagic = "LODTRACE";
constexpr std::size_t receivedAtOnce = std::size_t{256} << 10;  // bytes
constexpr std::size_t quotedBytes = 32;  // of what another program sends, for the message
constexpr milliseconds forever{-1};

// Owns a socket or an end of a pipe.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    int number() const { return number_; }
    explicit operator bool() const { return number_ >= 0; }

private:
    int number_;
};

// Makes calls on the descriptor return at once, and keeps it from programs that this one starts.
bool setUp(const Descriptor& descriptor) {
    return ::fcntl(descriptor.number(), F_SETFL, O_NONBLOCK) == 0 &&
           ::fcntl(descriptor.number(), F_SETFD, FD_CLOEXEC) == 0;
}

// A byte in this pipe wakes the thread while it waits for a socket.
struct StopPipe {
    Descriptor out;
    Descriptor in;
};

Result<StopPipe> makeStopPipe() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0)
        return ioError(fmt::format("the link to an engine cannot start: {}", lastSystemError()));
    StopPipe made{Descriptor(ends[0]), Descriptor(ends[1])};
    if (!setUp(made.out) || !setUp(made.in))
        return ioError(fmt::format("the link to an engine cannot start: {}", lastSystemError()));
    return made;
}

enum class Woken { Ready, Late, Stopped };

// Waits until a socket is ready, until the time is over, or until the pipe has a byte. socket: -1 for none; wait: negative for
// ever.
Woken waitFor(int socket, short events, const StopPipe& stop, milliseconds wait) {
    std::array<pollfd, 2> watched = {{{.fd = stop.out.number(), .events = POLLIN, .revents = 0},
                                      {.fd = socket, .events = events, .revents = 0}}};
    const auto end = Clock::now() + wait;
    for (;;) {
        milliseconds left{-1};
        if (wait.count() >= 0)
            left = std::max(milliseconds(0), std::chrono::ceil<milliseconds>(end - Clock::now()));
        const int count = ::poll(watched.data(), watched.size(), static_cast<int>(left.count()));
        if (count < 0 && errno == EINTR) continue;
        if (watched[0].revents != 0 || count < 0) return Woken::Stopped;
        return count > 0 ? Woken::Ready : Woken::Late;
    }
}

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

// Gives a socket a port of its own on this machine. Returns the port, or nothing with errno set.
std::optional<int> bindToAnyPort(const Descriptor& socket) {
    sockaddr_in own = loopback(0);
    socklen_t bytes = sizeof own;
    if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&own), bytes) != 0 ||
        ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&own), &bytes) != 0)
        return std::nullopt;
    return ntohs(own.sin_port);
}

std::string textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Returns the first line of a text in quotes, with dots for what cannot be printed.
std::string quotedLine(std::string_view begin) {
    std::string line(begin.substr(0, begin.find_first_of("\r\n")));
    for (char& c : line)
        if (c < ' ' || c > '~') c = '.';
    return fmt::format("\"{}\"", line);
}

// Writes the parts of one connection into a new file, which is made with the first block.
class TraceSpool {
public:
    explicit TraceSpool(const TraceLinkSettings& settings) : settings_(settings) {}

    // Takes the header, then blocks. number: of the first file to try; becomes that of the next one.
    Result<void> add(std::span<const std::byte> part, std::uint64_t& number) {
        if (!hasHeader_) {
            std::copy_n(part.begin(), header_.size(), header_.begin());
            hasHeader_ = true;
            return {};
        }
        if (!file_) {
            TRY(create(number));
            TRY(append(header_));
        }
        return append(part);
    }

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t bytes() const { return bytes_; }

private:
    Result<void> create(std::uint64_t& number) {
        for (;; ++number) {
            path_ = traceLinkFile(settings_, number);
            const int descriptor = uninterrupted([&] {
                return settings_.calls.open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
            });
            if (descriptor >= 0) {
                file_.emplace(descriptor, path_.string(), settings_.calls);
                ++number;
                return {};
            }
            if (errno != EEXIST)
                return ioError(fmt::format("{}: cannot be created: {}; expected a folder that can be written",
                                           path_.string(), lastSystemError()));
        }
    }
    Result<void> append(std::span<const std::byte> part) {
        Result<void> written = file_->write(bytes_, part);
        if (written)
            bytes_ += part.size();
        else
            takeBack();
        return written;
    }
    // Removes what a failed write left: a part of a block, or a file without any block.
    void takeBack() {
        if (bytes_ <= header_.size())
            settings_.calls.unlink(path_.c_str());
        else
            settings_.calls.ftruncate(file_->descriptor(), static_cast<off_t>(bytes_));
    }

    const TraceLinkSettings& settings_;
    std::array<std::byte, traceHeaderBytes> header_{};
    bool hasHeader_ = false;
    std::optional<OpenFile> file_;
    std::filesystem::path path_;
    std::uint64_t bytes_ = 0;  // in the file
};

struct Counts {
    std::uint64_t events = 0;
    std::uint64_t frames = 0;
    std::uint64_t nodes = 0;
    std::uint64_t dropped = 0;

    void add(const TraceEvent& event) {
        ++events;
        if (std::holds_alternative<TraceFrameBegan>(event)) ++frames;
        if (const auto* told = std::get_if<TraceNodeTold>(&event))
            nodes = std::max<std::uint64_t>(nodes, std::uint64_t{told->index} + 1);
        if (const auto* lost = std::get_if<TraceDropped>(&event)) dropped += lost->count;
    }
};

// One connection: checks what comes, counts it, and spools it.
class Reception {
public:
    // number: of the next file; it counts up with the file that is made.
    Reception(const TraceLinkSettings& settings, const std::string& address, std::uint64_t& number)
        : spool_(settings),
          reader_(
              address, [this](const TraceEvent& event) { counts_.add(event); },
              [this](std::span<const std::byte> part) { write(part); }),
          number_(number) {}

    // Takes bytes. Returns false if nothing more may come; the functions below then say why.
    bool feed(std::span<const std::byte> bytes) {
        if (begin_.size() < quotedBytes)
            begin_ += textOf(bytes.first(std::min(bytes.size(), quotedBytes - begin_.size())));
        if (isAlien()) return false;
        if (const auto fed = reader_.feed(bytes); !fed) problem_ = fed.error().message;
        return !problem_ && !writeProblem_;
    }

    // Ends the stream. What came of an unfinished block goes to the file if it has an event, so that none is lost that came.
    void finish() {
        const std::vector<std::byte> tail(reader_.unfinished().begin(), reader_.unfinished().end());
        const std::uint64_t before = counts_.events;
        (void)reader_.finish();
        if (counts_.events > before) write(tail);
    }

    // Returns whether the first bytes are not those of a trace. The first wrong byte is enough to know.
    bool isAlien() const {
        return !traceMagic.starts_with(std::string_view(begin_).substr(0, traceMagic.size()));
    }
    const std::string& begin() const { return begin_; }
    const std::optional<std::string>& problem() const { return problem_; }  // of the stream
    const std::optional<std::string>& writeProblem() const { return writeProblem_; }
    bool hasFile() const { return file_.bytes > 0; }
    const TraceLinkFile& file() const { return file_; }
    std::uint64_t bytes() const { return reader_.bytes(); }
    std::uint64_t uncheckedBytes() const { return reader_.bytes() - reader_.checkedBytes(); }

private:
    void write(std::span<const std::byte> part) {
        if (writeProblem_) return;
        if (const auto added = spool_.add(part, number_); !added) {
            writeProblem_ = added.error().message;
        } else if (spool_.bytes() > 0) {
            file_ = {spool_.path(), spool_.bytes(), counts_.frames, counts_.nodes, counts_.dropped};
        }
    }

    TraceSpool spool_;
    TraceReader reader_;
    std::uint64_t& number_;
    Counts counts_;
    TraceLinkFile file_;  // its counts are those of the blocks in the file
    std::string begin_;   // the first bytes of the stream
    std::optional<std::string> problem_;
    std::optional<std::string> writeProblem_;
};

std::string secondsText(milliseconds time) {
    return fmt::format("{} s", std::chrono::floor<std::chrono::seconds>(time).count());
}

std::string framesText(std::uint64_t frames) {
    return fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
}

// The next step of the thread after a connection, or after a try that made none.
enum class Next { Retry, RetrySlowly, End };

constexpr const char* expectedEngine = "expected an engine that traces itself with lod_trace.h";

}  // namespace

struct TraceLink::State {
    State(TraceLinkSettings given, StopPipe pipe)
        : settings(std::move(given)),
          address(fmt::format("127.0.0.1:{}", settings.port)),
          stopPipe(std::move(pipe)) {}

    // The thread calls these.
    void run();
    Next attach();
    std::optional<Descriptor> connectToEngine();
    std::optional<Descriptor> notConnected(int error);
    Next receive(const Descriptor& socket);
    Next refuse(const Reception& reception);
    Next closed(const Reception& reception, int error);
    Next after(const Reception& reception, Next next) const;
    // The thread calls these too. They lock the mutex.
    void enter(TraceLinkState state, std::string message);
    void noteConnection();
    void noteVerdictIsLate();
    void noteBytes();
    void publish(const Reception& reception);
    void noteProblem(std::string problem);
    void end();
    // Any thread calls this. It locks the mutex.
    TraceLinkStatus status() const;

    const TraceLinkSettings settings;
    const std::string address;
    const StopPipe stopPipe;
    std::uint64_t number = 1;  // of the next file; only the thread uses it

    mutable std::mutex mutex;  // guards what follows
    TraceLinkStatus now;
    Clock::time_point quietSince;      // the connection began or the last byte came
    std::uint64_t uncheckedBytes = 0;  // that this connection sent and that are in no whole block yet
    std::vector<TraceLinkFile> files;

    std::mutex joining;  // guards the thread
    std::thread thread;
};

// ---- the status ----

void TraceLink::State::enter(TraceLinkState state, std::string message) {
    const std::lock_guard lock(mutex);
    now.state = state;
    now.message = std::move(message);
}

// Keeps a state that says more than Waiting until it is known what this connection brings. It would flicker otherwise.
void TraceLink::State::noteConnection() {
    const std::lock_guard lock(mutex);
    quietSince = Clock::now();
    uncheckedBytes = 0;
    if (now.state == TraceLinkState::Waiting) now.state = TraceLinkState::Connected;
}

void TraceLink::State::noteVerdictIsLate() {
    const std::lock_guard lock(mutex);
    now.state = TraceLinkState::Connected;
}

void TraceLink::State::noteBytes() {
    const std::lock_guard lock(mutex);
    quietSince = Clock::now();
    now.lastByte = quietSince;
}

void TraceLink::State::publish(const Reception& reception) {
    const std::lock_guard lock(mutex);
    uncheckedBytes = reception.uncheckedBytes();
    if (!reception.hasFile()) return;
    if (files.empty() || files.back().path != reception.file().path) {
        files.emplace_back();
        ++now.files;
    }
    now.bytes += reception.file().bytes - files.back().bytes;
    now.frames += reception.file().frames - files.back().frames;
    now.file = files.back() = reception.file();
    now.state = TraceLinkState::Receiving;
}

void TraceLink::State::noteProblem(std::string problem) {
    const std::lock_guard lock(mutex);
    now.problem = std::move(problem);
}

void TraceLink::State::end() {
    const std::lock_guard lock(mutex);
    if (now.state == TraceLinkState::Failed) return;
    now.state = TraceLinkState::Ended;
    now.message = now.files == 0 ? fmt::format("no trace came from {}", address)
                                 : fmt::format("received {} from {}; the last file is {}",
                                               framesText(now.frames), address, now.file.path.string());
}

TraceLinkStatus TraceLink::State::status() const {
    const std::lock_guard lock(mutex);
    TraceLinkStatus status = now;
    const auto silence = std::chrono::duration_cast<milliseconds>(Clock::now() - quietSince);
    const bool isSilent = silence >= settings.silentAfter;
    const std::string file = now.file.path.string();
    if (now.state == TraceLinkState::Receiving) {
        status.message =
            isSilent ? fmt::format(
                           "{} has sent nothing for {}: the engine is paused, or begins no frames; {} "
                           "came and are in {}",
                           address, secondsText(silence), framesText(now.file.frames), file)
                     : fmt::format("receives from {} into {}", address, file);
    } else if (now.state == TraceLinkState::Connected) {
        status.message =
            isSilent
                ? fmt::format("{} took the connection and has sent {} for {}; {} and that is not paused",
                              address,
                              uncheckedBytes == 0
                                  ? "nothing"
                                  : fmt::format("{} bytes, no whole block, and nothing more", uncheckedBytes),
                              secondsText(silence), expectedEngine)
                : fmt::format("{} took the connection; waits for its first block", address);
    } else {
        return status;
    }
    if (isSilent) status.state = TraceLinkState::Silent;
    return status;
}

// ---- the thread ----

void TraceLink::State::run() {
    for (;;) {
        const Next next = attach();
        if (next == Next::End) break;
        const milliseconds wait = next == Next::Retry ? settings.retry : settings.slowRetry;
        if (waitFor(-1, 0, stopPipe, wait) == Woken::Stopped) break;
    }
    end();
}

Next TraceLink::State::attach() {
    const std::optional<Descriptor> socket = connectToEngine();
    if (!socket) return Next::Retry;
    noteConnection();
    return receive(*socket);
}

// Sets a message that says why there is no connection. Returns nothing.
std::optional<Descriptor> TraceLink::State::notConnected(int error) {
    const TraceLinkStatus before = status();
    std::string message = fmt::format("waits for an engine that listens at tcp:{}", address);
    if (error == EINPROGRESS)
        message = fmt::format("{} does not take the connection; {} and that is not paused", address,
                              expectedEngine);
    else if (error != ECONNREFUSED)
        message = fmt::format("{} cannot be connected to: {}; tries again", address,
                              std::generic_category().message(error));
    else if (before.files > 0)
        message = fmt::format("the engine at {} left after {}, which are in {}; waits for the next one",
                              address, framesText(before.file.frames), before.file.path.string());
    enter(TraceLinkState::Waiting, message);
    return std::nullopt;
}

// Returns nothing if no connection came about, or if the thread is to stop.
std::optional<Descriptor> TraceLink::State::connectToEngine() {
    Descriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
    if (!socket || !setUp(socket)) return notConnected(errno);
    // If nothing listens at the engine's port, the system may give it to this socket, which would then connect to itself.
    const std::optional<int> ownPort = bindToAnyPort(socket);
    if (!ownPort) return notConnected(errno);
    if (*ownPort == settings.port) return notConnected(ECONNREFUSED);
    const sockaddr_in engine = loopback(settings.port);
    if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&engine), sizeof engine) != 0) {
        if (errno != EINPROGRESS) return notConnected(errno);
        const Woken woken = waitFor(socket.number(), POLLOUT, stopPipe, settings.silentAfter);
        if (woken == Woken::Stopped) return std::nullopt;
        if (woken == Woken::Late) return notConnected(EINPROGRESS);
        int error = 0;
        socklen_t bytes = sizeof error;
        if (::getsockopt(socket.number(), SOL_SOCKET, SO_ERROR, &error, &bytes) != 0) error = errno;
        if (error != 0) return notConnected(error);
    }
    return socket;
}

// Takes what the system has received already, up to a limit, as the engine may go on sending.
void takeTheRest(const Descriptor& socket, Reception& reception, std::span<std::byte> buffer) {
    constexpr int most = 64;
    for (int i = 0; i < most; ++i) {
        const ssize_t count = ::recv(socket.number(), buffer.data(), buffer.size(), 0);
        if (count <= 0) break;
        if (!reception.feed(buffer.first(static_cast<std::size_t>(count)))) return;
    }
    reception.finish();
}

Next TraceLink::State::receive(const Descriptor& socket) {
    Reception reception(settings, address, number);
    std::vector<std::byte> bytes(receivedAtOnce);
    for (;;) {
        const Woken woken =
            waitFor(socket.number(), POLLIN, stopPipe, reception.hasFile() ? forever : settings.silentAfter);
        if (woken == Woken::Stopped) {
            takeTheRest(socket, reception, bytes);
            publish(reception);
            return Next::End;
        }
        if (woken == Woken::Late) {
            noteVerdictIsLate();
            continue;
        }
        const ssize_t count = ::recv(socket.number(), bytes.data(), bytes.size(), 0);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (count <= 0) {
            const int error = count < 0 ? errno : 0;
            reception.finish();
            publish(reception);
            return reception.writeProblem() ? refuse(reception) : closed(reception, error);
        }
        noteBytes();
        const bool goesOn = reception.feed(std::span(bytes).first(static_cast<std::size_t>(count)));
        publish(reception);
        if (!goesOn) return refuse(reception);
    }
}

Next TraceLink::State::after(const Reception& reception, Next next) const {
    return settings.isOnce && reception.hasFile() ? Next::End : next;
}

// Ends a connection whose bytes cannot be taken.
Next TraceLink::State::refuse(const Reception& reception) {
    const std::string kept =
        reception.hasFile() ? fmt::format("; what came before is in {}", reception.file().path.string()) : "";
    if (reception.writeProblem()) {
        enter(TraceLinkState::Failed, *reception.writeProblem() + kept);
        return Next::End;
    }
    if (reception.isAlien()) {
        enter(TraceLinkState::Refused, fmt::format("{}: another program listens there, which sent {}; {}",
                                                   address, quotedLine(reception.begin()), expectedEngine));
        return Next::RetrySlowly;
    }
    const std::string problem = reception.problem().value_or("") + kept;
    if (reception.hasFile()) noteProblem(problem);
    enter(TraceLinkState::Refused, problem);
    return after(reception, Next::RetrySlowly);
}

// Ends a connection that the other side closed. error: of the socket, 0 for none.
Next TraceLink::State::closed(const Reception& reception, int error) {
    const std::string reason = error == 0 ? "" : fmt::format(": {}", std::generic_category().message(error));
    if (reception.bytes() == 0) {
        enter(TraceLinkState::TurnedAway,
              fmt::format("{} closed the connection before it sent a byte{}: another tool is attached to the "
                          "engine, which takes one at a time, or another program listens there; tries again",
                          address, reason));
        return Next::Retry;
    }
    if (!reception.hasFile()) {
        enter(TraceLinkState::Refused,
              fmt::format("{} closed the connection after {} bytes{}, before a block was whole; {}", address,
                          reception.bytes(), reason, expectedEngine));
        return Next::RetrySlowly;
    }
    if (reception.uncheckedBytes() > 0 || error != 0)
        noteProblem(fmt::format("{}: the stream ended {} bytes into a block{}; what came is in {}", address,
                                reception.uncheckedBytes(), reason, reception.file().path.string()));
    enter(TraceLinkState::Waiting,
          fmt::format("the engine at {} left after {}, which are in {}; waits for the next one", address,
                      framesText(reception.file().frames), reception.file().path.string()));
    return after(reception, Next::Retry);
}

// ---- the interface ----

TraceLink::TraceLink(std::unique_ptr<State> state) : state_(std::move(state)) {}

Result<std::unique_ptr<TraceLink>> TraceLink::start(TraceLinkSettings settings) {
    std::error_code ignored;
    if (settings.port < 1 || settings.port > 65535)
        return badInput(fmt::format("port: {} is out of range; expected one in [1, 65535]", settings.port));
    if (settings.name.empty() || settings.name.find('/') != std::string::npos)
        return badInput(fmt::format("name of the traces: \"{}\" is no file name; expected one without \"/\"",
                                    settings.name));
    const std::filesystem::path folder = settings.folder.empty() ? "." : settings.folder;
    if (!std::filesystem::is_directory(folder, ignored))
        return badInput(fmt::format("{}: is no folder; expected one to write traces into", folder.string()));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return badInput(fmt::format("{}: cannot be written: {}; expected a folder to write traces into",
                                    folder.string(), lastSystemError()));
    TRY_ASSIGN(auto pipe, makeStopPipe());
    auto state = std::make_unique<State>(std::move(settings), std::move(pipe));
    state->enter(TraceLinkState::Waiting,
                 fmt::format("waits for an engine that listens at tcp:{}", state->address));
    state->thread = std::thread([&link = *state] { link.run(); });
    return std::unique_ptr<TraceLink>(new TraceLink(std::move(state)));
}

TraceLink::~TraceLink() {
    stop();
}

void TraceLink::stop() {
    const char byte = 0;
    [[maybe_unused]] const ssize_t written = ::write(state_->stopPipe.in.number(), &byte, 1);
    const std::lock_guard lock(state_->joining);
    if (state_->thread.joinable()) state_->thread.join();
}

TraceLinkStatus TraceLink::status() const {
    return state_->status();
}

std::vector<TraceLinkFile> TraceLink::files() const {
    const std::lock_guard lock(state_->mutex);
    return state_->files;
}

std::filesystem::path traceLinkFile(const TraceLinkSettings& settings, std::uint64_t number) {
    return settings.folder /
           (number == 1 ? settings.name + ".lodtrace" : fmt::format("{}-{}.lodtrace", settings.name, number));
}

}  // namespace planet
