// A disk that fails when it is told to: file calls that are counted, and of which one fails, or all from one
// on.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "planet/base/file_calls.h"

namespace tests {

// What becomes of a call: it fails with errno, or it does less than it was asked for.
struct FileFault {
    enum class Kind { Fails, DoesHalf, DoesNothing };  // the last two of reads and writes alone
    Kind kind = Kind::Fails;
    int error = EIO;
    const char* name = "EIO";
};

inline constexpr FileFault eio{FileFault::Kind::Fails, EIO, "EIO"};
inline constexpr FileFault enospc{FileFault::Kind::Fails, ENOSPC, "ENOSPC"};
inline constexpr FileFault eacces{FileFault::Kind::Fails, EACCES, "EACCES"};
inline constexpr FileFault interrupted{FileFault::Kind::Fails, EINTR, "EINTR"};
inline constexpr FileFault half{FileFault::Kind::DoesHalf, 0, "half"};
inline constexpr FileFault nothing{FileFault::Kind::DoesNothing, 0, "nothing"};

// Any thread. The calls that it gives out may outlive it.
class FaultyFiles {
public:
    // The system's, but for faults, and that syncing takes no time.
    planet::FileCalls calls() const {
        const planet::FileCalls system = planet::systemFileCalls();
        planet::FileCalls faulty;
        faulty.open = watched("open", system.open);
        faulty.close = closing(system.close);
        faulty.stat = watched("stat", system.stat);
        faulty.fstat = watched("fstat", system.fstat);
        faulty.pread = watchedTransfer("pread", system.pread);
        faulty.pwrite = watchedTransfer("pwrite", system.pwrite);
        faulty.ftruncate = watched("ftruncate", system.ftruncate);
        faulty.fsync = watched("fsync", std::function<int(int)>([](int) { return 0; }));
        faulty.flock = watched("flock", system.flock);
        faulty.rename = watched("rename", system.rename);
        faulty.unlink = watched("unlink", system.unlink);
        return faulty;
    }

    // The n-th call from now on, from 0; or that and all after it; or the first or all of one name.
    void failAt(std::size_t n, const FileFault& fault) { tell("", n, n + 1, fault); }
    void failFrom(std::size_t n, const FileFault& fault) { tell("", n, std::size_t(-1), fault); }
    void failOnce(const std::string& name, const FileFault& fault) { tell(name, 0, 1, fault); }
    void failAlways(const std::string& name, const FileFault& fault) {
        tell(name, 0, std::size_t(-1), fault);
    }
    void beWhole() { tell("", 0, 0, eio); }

    std::size_t count() const {  // of calls since it was told last, of that name if any
        const std::lock_guard lock(shared_->mutex);
        return shared_->count;
    }
    std::vector<std::string> faulted() const {  // names of the calls that met a fault since then
        const std::lock_guard lock(shared_->mutex);
        return shared_->faulted;
    }
    int open() const {  // descriptors now open
        const std::lock_guard lock(shared_->mutex);
        return shared_->open;
    }

private:
    struct Shared {
        std::mutex mutex;
        std::size_t count = 0;
        std::size_t first = 0;  // of those that fail
        std::size_t end = 0;
        std::string only;  // calls of this name, or of any
        FileFault fault;
        std::vector<std::string> faulted;
        int open = 0;
    };

    void tell(const std::string& only, std::size_t first, std::size_t end, const FileFault& fault) {
        const std::lock_guard lock(shared_->mutex);
        shared_->count = 0;
        shared_->first = first;
        shared_->end = end;
        shared_->only = only;
        shared_->fault = fault;
        shared_->faulted.clear();
    }

    // Counts a call and says what becomes of it.
    static std::optional<FileFault> next(Shared& shared, const char* name, bool transfers) {
        const std::lock_guard lock(shared.mutex);
        if (!shared.only.empty() && shared.only != name) return std::nullopt;
        const std::size_t index = shared.count++;
        if (index < shared.first || index >= shared.end) return std::nullopt;
        if (!transfers && shared.fault.kind != FileFault::Kind::Fails) return std::nullopt;
        shared.faulted.emplace_back(name);
        return shared.fault;
    }

    template <class R, class... Arguments>
    std::function<R(Arguments...)> watched(const char* name, std::function<R(Arguments...)> call) const {
        return [shared = shared_, name, call = std::move(call)](Arguments... arguments) -> R {
            if (const auto fault = next(*shared, name, false)) {
                errno = fault->error;
                return -1;
            }
            const R outcome = call(arguments...);
            if (std::string(name) == "open" && outcome >= 0) {
                const std::lock_guard lock(shared->mutex);
                ++shared->open;
            }
            return outcome;
        };
    }

    // The system closes even where it says that it could not.
    std::function<int(int)> closing(std::function<int(int)> call) const {
        return [shared = shared_, call = std::move(call)](int descriptor) {
            const auto fault = next(*shared, "close", false);
            const int outcome = call(descriptor);
            const std::lock_guard lock(shared->mutex);
            --shared->open;
            if (!fault) return outcome;
            errno = fault->error;
            return -1;
        };
    }

    template <class Buffer>
    std::function<ssize_t(int, Buffer, std::size_t, off_t)> watchedTransfer(
        const char* name, std::function<ssize_t(int, Buffer, std::size_t, off_t)> call) const {
        return [shared = shared_, name, call = std::move(call)](int descriptor, Buffer bytes,
                                                                std::size_t count, off_t offset) -> ssize_t {
            const auto fault = next(*shared, name, true);
            if (!fault) return call(descriptor, bytes, count, offset);
            if (fault->kind == FileFault::Kind::DoesNothing) return 0;
            if (fault->kind == FileFault::Kind::DoesHalf)
                return call(descriptor, bytes, std::max<std::size_t>(count / 2, 1), offset);
            errno = fault->error;
            return -1;
        };
    }

    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

}  // namespace tests
