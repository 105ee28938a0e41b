// Reads and writes whole ranges of an open file: retries interrupted calls and continues partial ones.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"

namespace planet {

// Retries a call while a signal interrupts it. Do not use it for close.
template <class Call>
auto uninterrupted(const Call& call) {
    auto outcome = call();
    while (outcome < 0 && errno == EINTR) outcome = call();
    return outcome;
}

// Returns the message of errno.
std::string lastSystemError();

// Owns the descriptor. Several threads may read, and write other parts of the file, at the same time.
class OpenFile {
public:
    // Opens a file. flags: as for open(); O_CLOEXEC is added. name: for messages; empty: the path.
    static Result<OpenFile> open(const std::filesystem::path& path, int flags, const FileCalls& calls,
                                 const std::string& name = {});
    // Takes over an open descriptor. name: for messages.
    OpenFile(int descriptor, std::string name, FileCalls calls);
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&&) = delete;
    ~OpenFile() { close(); }

    const std::string& name() const { return name_; }
    int descriptor() const { return descriptor_; }  // -1 after close
    const FileCalls& calls() const { return calls_; }
    void close();

    // Returns the size of the file now, bytes.
    Result<std::uint64_t> size() const;
    // Fills all of `out`; a shorter file is an Error. The Errors name the file.
    Result<void> read(std::uint64_t offset, std::span<std::byte> out) const;
    Result<void> write(std::uint64_t offset, std::span<const std::byte> bytes) const;

private:
    int descriptor_;
    std::string name_;
    FileCalls calls_;
};

}  // namespace planet
