// What the whole program takes, as the system sees it.
#pragma once

#include <cstddef>

namespace worldy {

// Resident memory, bytes; 0 where the system does not tell.
std::size_t residentProcessBytes();

// Bytes that the heap has handed out and not got back, those of the standard library's allocator alone; 0
// where it does not tell, as under a sanitizer that brings its own.
std::size_t heapBytesInUse();

// Files, sockets and pipes that are open, and threads; 0 where the system does not tell.
std::size_t openFileHandles();
std::size_t runningThreads();

}  // namespace worldy
