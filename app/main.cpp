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

}  // namespace

int main(int argumentCount, char** arguments) {
    allowManyFiles();
    return worldy::runCommandLine(argumentCount, arguments);
}
