#include "app/base/exit_code.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "app/base/message.h"
#include "planet/base/open_file.h"

namespace worldy {

int reportError(const planet::Error& error) {
    printMessage("worldy: {}\n", error.message);
    return error.kind == planet::ErrorKind::Cancelled ? exitCancelled : exitBadInput;
}

void occupyStandardStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
        // The mode is the wrong one, so that text written to a closed stream is an error and not lost.
        ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

int afterStandardOutput(int exitCode) {
    // A write that failed earlier left no errno behind.
    const bool failedBefore = std::ferror(stdout) != 0;
    const bool flushed = std::fflush(stdout) == 0;
    if (!failedBefore && flushed) return exitCode;
    const std::string why = flushed ? std::string("a write failed") : planet::lastSystemError();
    const int failed = reportError(
        {planet::ErrorKind::Io, fmt::format("standard output: cannot be written: {}; what was printed is "
                                            "not complete",
                                            why)});
    return exitCode == exitOk || exitCode == exitCheckFailed ? failed : exitCode;
}

}  // namespace worldy
