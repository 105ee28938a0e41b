#include "planet/base/file_calls.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdio>

namespace planet {

FileCalls systemFileCalls() {
    return {
        .open = [](const char* path, int flags, mode_t mode) { return ::open(path, flags, mode); },
        .close = ::close,
        .stat = [](const char* path, struct stat* status) { return ::stat(path, status); },
        .fstat = [](int descriptor, struct stat* status) { return ::fstat(descriptor, status); },
        .pread = ::pread,
        .pwrite = ::pwrite,
        .ftruncate = ::ftruncate,
        .fsync = ::fsync,
        .flock = [](int descriptor, int operation) { return ::flock(descriptor, operation); },
        .rename = ::rename,
        .unlink = ::unlink,
    };
}

}  // namespace planet
