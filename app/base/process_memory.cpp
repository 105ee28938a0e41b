#include "app/base/process_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace worldy {

namespace {

std::size_t entriesOf(const char* folder) {
    std::error_code status;
    const std::filesystem::directory_iterator entries(folder, status);
    return status ? 0 : static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

}  // namespace

std::size_t residentProcessBytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t allPages = 0, residentPages = 0;
    if (!(file >> allPages >> residentPages)) return 0;
    return residentPages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t peakProcessBytes() {
    rusage usage{};
    if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts it in KiB
}

std::size_t heapBytesInUse() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
#else
    return 0;
#endif
}

std::size_t openFileHandles() {
    const std::size_t entries = entriesOf("/proc/self/fd");
    return entries > 0 ? entries - 1 : 0;  // one of them is the folder itself
}

std::size_t runningThreads() {
    return entriesOf("/proc/self/task");
}

}  // namespace worldy
