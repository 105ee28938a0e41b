// Creates nameless temporary files. Internal to the library; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"

namespace planet {

// Creates a file in the system's temporary folder that disappears when it is closed, even if the program is killed. On
// file systems without nameless files it briefly has a name.
Result<std::shared_ptr<const OpenFile>> createTemporaryFile(const FileCalls& calls);

// Room in one temporary file, which several writers share, so that thousands of them do not use up the process's file
// descriptors. The file is made when room is taken first. Any thread.
class TemporarySpace {
public:
    explicit TemporarySpace(FileCalls calls) : calls_(std::move(calls)) {}

    struct Room {
        std::shared_ptr<const OpenFile> file;
        std::uint64_t offset = 0;  // of its first byte
    };
    // Takes room. It needs no space on the disk until it is written to.
    Result<Room> take(std::uint64_t bytes);

private:
    FileCalls calls_;
    std::mutex mutex_;
    std::shared_ptr<const OpenFile> file_;
    std::uint64_t taken_ = 0;  // bytes
};

}  // namespace planet
