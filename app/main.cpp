#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>

#include "app/cli/command_line.h"

namespace {

constexpr rlim_t mostFiles = 65'536;

// By default a process may have 1,024 files open, fewer than a planet of many netCDF files needs. It may ask for more.
// Nothing here uses select(), which knows no more than 1,024.
void allowManyFiles() {
    rlimit files{};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
    files.rlim_cur = std::max(files.rlim_cur, std::min(files.rlim_max, mostFiles));
    ::setrlimit(RLIMIT_NOFILE, &files);
}

// By default glibc grows the heap of a thread by a page or two with a system call, which a loader makes for each block that
// it reads. Here each heap is reserved as a whole; its pages take no memory before they are used. glibc stops adapting the
// other two thresholds once one of the three is set, so they get the values that it would reach.
void reserveHeaps() {
    constexpr int heapBytes = 64 << 20;
    ::mallopt(M_TOP_PAD, heapBytes);
    ::mallopt(M_TRIM_THRESHOLD, heapBytes);
    ::mallopt(M_MMAP_THRESHOLD, heapBytes / 2);
}

}  // namespace

int main(int argumentCount, char** arguments) {
    allowManyFiles();
    reserveHeaps();
    return worldy::runCommandLine(argumentCount, arguments);
}
