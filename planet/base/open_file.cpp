#include "planet/base/open_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <system_error>
#include <utility>

namespace planet {

namespace {

constexpr mode_t newFileMode = 0644;

}  // namespace

std::string lastSystemError() {
    return std::generic_category().message(errno);
}

Result<OpenFile> OpenFile::open(const std::filesystem::path& path, int flags, const FileCalls& calls,
                                const std::string& name) {
    const std::string& shown = name.empty() ? path.native() : name;
    const int descriptor =
        uninterrupted([&] { return calls.open(path.c_str(), flags | O_CLOEXEC, newFileMode); });
    if (descriptor < 0) return ioError(fmt::format("{}: cannot be opened: {}", shown, lastSystemError()));
    return OpenFile(descriptor, shown, calls);
}

OpenFile::OpenFile(int descriptor, std::string name, FileCalls calls)
    : descriptor_(descriptor), name_(std::move(name)), calls_(std::move(calls)) {}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      name_(std::move(other.name_)),
      calls_(std::move(other.calls_)) {}

void OpenFile::close() {
    if (descriptor_ >= 0) calls_.close(std::exchange(descriptor_, -1));
}

Result<std::uint64_t> OpenFile::size() const {
    struct stat status {};
    if (uninterrupted([&] { return calls_.fstat(descriptor_, &status); }) != 0)
        return ioError(fmt::format("{}: cannot be read: {}", name_, lastSystemError()));
    return static_cast<std::uint64_t>(status.st_size);
}

Result<void> OpenFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const ssize_t count = uninterrupted(
            [&] { return calls_.pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset)); });
        if (count < 0) return ioError(fmt::format("{}: reading failed: {}", name_, lastSystemError()));
        if (count == 0)
            return ioError(fmt::format("{}: ended at byte {} while open: it was truncated", name_, offset));
        out = out.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return {};
}

Result<void> OpenFile::write(std::uint64_t offset, std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count = uninterrupted([&] {
            return calls_.pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        });
        if (count < 0) return ioError(fmt::format("{}: writing failed: {}", name_, lastSystemError()));
        // Another call could return 0 again, without end.
        if (count == 0) return ioError(fmt::format("{}: writing failed: nothing was written", name_));
        bytes = bytes.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return {};
}

}  // namespace planet
