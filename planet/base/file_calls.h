// The system calls that read chunk files and raw heights and write files. Tests replace them to simulate a
// failing disk. Each behaves as the call of its name: on failure it returns less than 0 and sets errno.
// Called from several threads at once.
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <cstddef>
#include <functional>

namespace planet {

struct FileCalls {
    std::function<int(const char* path, int flags, mode_t mode)> open;
    std::function<int(int descriptor)> close;  // closes even if it fails; never retry it
    std::function<int(const char* path, struct stat* status)> stat;
    std::function<int(int descriptor, struct stat* status)> fstat;
    std::function<ssize_t(int descriptor, void* out, std::size_t bytes, off_t offset)> pread;
    std::function<ssize_t(int descriptor, const void* from, std::size_t bytes, off_t offset)> pwrite;
    std::function<int(int descriptor, off_t bytes)> ftruncate;
    std::function<int(int descriptor)> fsync;
    std::function<int(int descriptor, int operation)> flock;
    std::function<int(const char* from, const char* to)> rename;
    std::function<int(const char* path)> unlink;
};

// Returns the system's calls.
FileCalls systemFileCalls();

}  // namespace planet
