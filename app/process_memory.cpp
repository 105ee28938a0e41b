#include "app/process_memory.h"

#include <unistd.h>

#include <fstream>

namespace worldy {

std::size_t residentProcessBytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t allPages = 0, residentPages = 0;
    if (!(file >> allPages >> residentPages)) return 0;
    return residentPages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace worldy
