// An open file, read and written whole pieces at a time whatever the system does: a call that a signal
// interrupts is made again, one that does only a part is continued.
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

// Makes a call again for as long as a signal interrupts it. Not for close.
template <class Call>
auto uninterrupted(const Call& call) {
    auto outcome = call();
    while (outcome < 0 && errno == EINTR) outcome = call();
    return outcome;
}

// What errno says, in words.
std::string lastSystemError();

// Owns the descriptor. Reading is safe from any thread, and so is writing elsewhere in the file.
class OpenFile {
public:
    // flags: open's; O_CLOEXEC is added. The Error names the path.
    static Result<OpenFile> open(const std::filesystem::path& path, int flags, const FileCalls& calls);
    // name: as messages call it.
    OpenFile(int descriptor, std::string name, FileCalls calls);
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&&) = delete;
    ~OpenFile() { close(); }

    const std::string& name() const { return name_; }
    int descriptor() const { return descriptor_; }  // -1 once closed
    const FileCalls& calls() const { return calls_; }
    void close();

    // Fills all of `out` from bytes that the file must have. The Errors name the file.
    Result<void> read(std::uint64_t offset, std::span<std::byte> out) const;
    Result<void> write(std::uint64_t offset, std::span<const std::byte> bytes) const;

private:
    int descriptor_;
    std::string name_;
    FileCalls calls_;
};

}  // namespace planet
