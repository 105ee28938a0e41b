// The resources of the whole process, as the system reports them. 0 means that the system does not report a
// number.
#pragma once

#include <cstddef>

namespace worldy {

std::size_t residentProcessBytes();

// Returns the largest number of bytes that were resident at any time.
std::size_t peakProcessBytes();

// Returns the bytes allocated from the C library's heap; 0 under a sanitizer with its own allocator.
std::size_t heapBytesInUse();

// Returns the number of open files, sockets and pipes.
std::size_t openFileHandles();

std::size_t runningThreads();

}  // namespace worldy
