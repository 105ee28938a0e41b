#include "planet/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace planet {

namespace {

std::string describe(const std::filesystem::path& path, const char* what) {
    return fmt::format("{}: {}: {}", path.string(), what, std::strerror(errno));
}

// The lock may have been won on a file that its last writer has renamed or removed meanwhile.
bool stillHasName(int descriptor, const std::filesystem::path& path) {
    struct stat opened {};
    struct stat named {};
    return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path, std::filesystem::path temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
    // The rename would put a file in the place of whatever is there, a device too.
    std::error_code problem;
    const std::filesystem::file_status there = std::filesystem::status(path, problem);
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
        return ioError(path.string() + ": is a folder or a device; name a file");
    }
    std::filesystem::path temporary = path;
    temporary.replace_filename("." + path.filename().string() + ".part");
    for (;;) {
        const int descriptor = open(temporary.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (descriptor < 0) return ioError(describe(path, "cannot be written"));
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            close(descriptor);
            return ioError(path.string() +
                           ": another program is writing this file; wait for it or name another");
        }
        if (!stillHasName(descriptor, temporary)) {
            close(descriptor);
            continue;
        }
        AtomicFile file(path, std::move(temporary), descriptor);
        if (ftruncate(descriptor, 0) != 0) return ioError(describe(path, "cannot be written"));
        return file;
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0) return;
    unlink(temporary_.c_str());
    close(descriptor_);
}

Result<void> AtomicFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return ioError(describe(path_, "writing failed"));
        bytes = bytes.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return {};
}

Result<void> AtomicFile::append(std::span<const std::byte> bytes) {
    const Result<void> written = write(size_, bytes);
    if (written) size_ += bytes.size();
    return written;
}

Result<void> AtomicFile::overwrite(std::uint64_t offset, std::span<const std::byte> bytes) {
    assert(offset + bytes.size() <= size_);
    return write(offset, bytes);
}

Result<void> AtomicFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    assert(offset + out.size() <= size_);
    while (!out.empty()) {
        const ssize_t count = pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return ioError(describe(path_, "reading back failed"));
        if (count == 0)
            return ioError(path_.string() +
                           ": was cut while it was written; leave it alone and write it again");
        out = out.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return {};
}

Result<void> AtomicFile::commit() {
    if (fsync(descriptor_) != 0) return ioError(describe(path_, "writing failed"));
    if (rename(temporary_.c_str(), path_.c_str()) != 0)
        return ioError(describe(path_, "cannot take this name"));
    close(std::exchange(descriptor_, -1));
    // The name is durable once its folder is; where folders cannot be synced the file is whole all the same.
    const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    const int folderDescriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folderDescriptor >= 0) {
        fsync(folderDescriptor);
        close(folderDescriptor);
    }
    return {};
}

}  // namespace planet
