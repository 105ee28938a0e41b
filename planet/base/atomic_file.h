// Writes a file atomically: under a temporary name in the same folder, synced, then renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"

namespace planet {

// Keeps a symbolic link and writes the file that it leads to; the temporary file is in that file's folder. A
// replaced file keeps its mode. Owns the temporary file: unless it was committed, the destructor removes it
// and the old file stays. A path has one writer at a time; a second one gets an Error. The temporary file of
// a killed writer is overwritten. One thread.
class AtomicFile {
public:
    static Result<AtomicFile> create(const std::filesystem::path& path,
                                     const FileCalls& calls = systemFileCalls());
    AtomicFile(AtomicFile&& other) noexcept = default;
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    const std::filesystem::path& path() const { return path_; }            // as given to create
    const std::filesystem::path& target() const { return target_; }        // path() with its links resolved
    const std::filesystem::path& temporary() const { return temporary_; }  // where it is written
    std::uint64_t size() const { return size_; }
    // Counts bytes that other processes have written after size(), by the temporary name.
    void growTo(std::uint64_t bytes) { size_ = bytes; }
    Result<void> append(std::span<const std::byte> bytes);
    // Replaces bytes that were appended before.
    Result<void> overwrite(std::uint64_t offset, std::span<const std::byte> bytes);
    // Fills out with bytes that were appended before. Any thread, while no thread appends or overwrites.
    Result<void> read(std::uint64_t offset, std::span<std::byte> out) const;
    // Syncs the file and renames it to its final name.
    Result<void> commit();

private:
    AtomicFile(std::filesystem::path path, std::filesystem::path target, std::filesystem::path temporary,
               OpenFile file);

    std::filesystem::path path_;
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    OpenFile file_;  // closed by commit()
    std::uint64_t size_ = 0;
};

// Returns the file that a chain of symbolic links leads to, whether it exists or not; path itself if it is no
// link.
Result<std::filesystem::path> linkTarget(const std::filesystem::path& path);

// Returns an Error if AtomicFile could not create this file.
Result<void> checkWritable(const std::filesystem::path& path);

// Calls write with a temporary name in the target's folder that has the same extension, then replaces the
// target by the file written there. It is for libraries that write files by name. A target has one writer at
// a time.
Result<void> writeAtomically(
    const std::filesystem::path& target,
    const std::function<Result<void>(const std::filesystem::path& temporary)>& write);

}  // namespace planet
