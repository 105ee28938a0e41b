#include "planet/base/atomic_file.h"
#include "planet/base/try.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace planet {

namespace {

tl::unexpected<Error> systemError(const std::filesystem::path& path, const char* what) {
    return ioError(fmt::format("{}: {}: {}", path.string(), what, lastSystemError()));
}

// Checks that the path may be replaced, because the rename would replace anything of this name, even a
// device.
Result<void> checkPlace(const std::filesystem::path& path, const FileCalls& calls) {
    struct stat there {};
    if (uninterrupted([&] { return calls.stat(path.c_str(), &there); }) != 0) {
        if (errno == ENOENT) return {};
        return systemError(path, "cannot be written");
    }
    if (S_ISREG(there.st_mode)) return {};
    return ioError(path.string() + ": is a folder or a device; expected a file");
}

// Returns false if the previous writer has renamed or removed the file that is now locked.
Result<bool> stillHasName(const OpenFile& file, const std::filesystem::path& temporary,
                          const std::filesystem::path& path) {
    struct stat opened {};
    struct stat named {};
    const FileCalls& calls = file.calls();
    if (uninterrupted([&] { return calls.fstat(file.descriptor(), &opened); }) != 0)
        return systemError(path, "cannot be written");
    if (uninterrupted([&] { return calls.stat(temporary.c_str(), &named); }) != 0) {
        if (errno == ENOENT) return false;
        return systemError(path, "cannot be written");
    }
    return opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::filesystem::path folderOf(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// Returns the mode of a file; nothing if there is no file.
std::optional<mode_t> modeOf(const std::filesystem::path& path, const FileCalls& calls) {
    struct stat there {};
    if (uninterrupted([&] { return calls.stat(path.c_str(), &there); }) != 0) return std::nullopt;
    return there.st_mode & 07777u;
}

void syncFolderOf(const std::filesystem::path& path, const FileCalls& calls) {
    const auto opened = OpenFile::open(folderOf(path), O_RDONLY | O_DIRECTORY, calls);
    if (opened) uninterrupted([&] { return calls.fsync(opened->descriptor()); });
}

Result<void> copyInto(AtomicFile& file, const std::filesystem::path& from) {
    constexpr std::size_t pieceBytes = std::size_t{1} << 20;
    std::error_code status;
    std::uintmax_t left = std::filesystem::file_size(from, status);
    if (status) return ioError(fmt::format("{}: cannot be read: {}", from.string(), status.message()));
    TRY_ASSIGN(const auto opened, OpenFile::open(from, O_RDONLY, systemFileCalls()));
    std::vector<std::byte> piece;
    while (left > 0) {
        piece.resize(static_cast<std::size_t>(std::min<std::uintmax_t>(left, pieceBytes)));
        TRY(opened.read(file.size(), piece));
        TRY(file.append(piece));
        left -= piece.size();
    }
    return {};
}

}  // namespace

Result<std::filesystem::path> linkTarget(const std::filesystem::path& path) {
    constexpr int mostLinks = 40;  // the kernel's limit
    std::filesystem::path target = path;
    for (int i = 0; i <= mostLinks; ++i) {
        std::error_code status;
        if (!std::filesystem::is_symlink(target, status)) return target;
        const std::filesystem::path next = std::filesystem::read_symlink(target, status);
        if (status) return ioError(fmt::format("{}: cannot be written: {}", path.string(), status.message()));
        target = target.parent_path() / next;
    }
    return ioError(fmt::format("{}: cannot be written: too many symbolic links", path.string()));
}

Result<void> checkWritable(const std::filesystem::path& path) {
    TRY(checkPlace(path, systemFileCalls()));
    TRY_ASSIGN(const auto target, linkTarget(path));
    const std::filesystem::path folder = folderOf(target);
    if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
    return ioError(fmt::format("{}: cannot be written: {}: {}; expected a writable folder that exists",
                               path.string(), folder.string(), lastSystemError()));
}

AtomicFile::AtomicFile(std::filesystem::path path, std::filesystem::path target,
                       std::filesystem::path temporary, OpenFile file)
    : path_(std::move(path)),
      target_(std::move(target)),
      temporary_(std::move(temporary)),
      file_(std::move(file)) {}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path, const FileCalls& calls) {
    TRY(checkPlace(path, calls));
    TRY_ASSIGN(const auto target, linkTarget(path));
    std::filesystem::path temporary = target;
    temporary.replace_filename("." + target.filename().string() + ".part");
    const std::optional<mode_t> mode = modeOf(target, calls);
    const mode_t openedAs = mode.value_or(0644) | S_IRUSR | S_IWUSR;
    for (;;) {
        const int descriptor = uninterrupted(
            [&] { return calls.open(temporary.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, openedAs); });
        if (descriptor < 0) return systemError(path, "cannot be written");
        OpenFile opened(descriptor, path.string(), calls);
        if (uninterrupted([&] { return calls.flock(descriptor, LOCK_EX | LOCK_NB); }) != 0) {
            if (errno == EWOULDBLOCK)
                return ioError(path.string() +
                               ": another program is writing this file; wait for it or name another");
            // The file system has no locks, so no other writer holds this file.
            const auto problem = systemError(path, "cannot be locked");
            calls.unlink(temporary.c_str());
            return problem;
        }
        // The temporary file is removed on any Error from here on.
        AtomicFile file(path, target, temporary, std::move(opened));
        TRY_ASSIGN(const auto own, stillHasName(file.file_, temporary, path));
        if (!own) {
            file.file_.close();
            continue;
        }
        if (uninterrupted([&] { return calls.ftruncate(descriptor, 0); }) != 0)
            return systemError(path, "cannot be written");
        // The umask restricts the mode of a new file, and a killed writer's file has its own mode.
        if (mode && uninterrupted([&] { return ::fchmod(descriptor, *mode); }) != 0)
            return systemError(path, "cannot be written");
        return file;
    }
}

AtomicFile::~AtomicFile() {
    if (file_.descriptor() >= 0) file_.calls().unlink(temporary_.c_str());
}

Result<void> AtomicFile::append(std::span<const std::byte> bytes) {
    const Result<void> written = file_.write(size_, bytes);
    if (written) size_ += bytes.size();
    return written;
}

Result<void> AtomicFile::overwrite(std::uint64_t offset, std::span<const std::byte> bytes) {
    assert(offset + bytes.size() <= size_);
    return file_.write(offset, bytes);
}

Result<void> AtomicFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    assert(offset + out.size() <= size_);
    return file_.read(offset, out);
}

Result<void> AtomicFile::commit() {
    const FileCalls& calls = file_.calls();
    if (uninterrupted([&] { return calls.fsync(file_.descriptor()); }) != 0)
        return systemError(path_, "writing failed");
    if (uninterrupted([&] { return calls.rename(temporary_.c_str(), target_.c_str()); }) != 0)
        return systemError(path_, "cannot take this name");
    // The sync has already reported any error that closing could report.
    file_.close();
    // The name is durable once its folder is synced. On file systems that cannot sync folders, the file is
    // still whole.
    syncFolderOf(target_, calls);
    return {};
}

Result<void> writeAtomically(const std::filesystem::path& target,
                             const std::function<Result<void>(const std::filesystem::path&)>& write) {
    // No other writer may write the target or its temporary files from here on.
    TRY_ASSIGN(auto file, AtomicFile::create(target));
    const std::filesystem::path temporary =
        file.target().parent_path() /
        fmt::format(".{}.new{}", file.target().stem().string(), target.extension().string());
    Result<void> written = write(temporary);
    if (written) written = copyInto(file, temporary);
    std::error_code status;
    std::filesystem::remove(temporary, status);
    return written ? file.commit() : written;
}

}  // namespace planet
