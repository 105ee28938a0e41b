#include "app/base/exit_code.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "app/base/message.h"

namespace worldy {

namespace {

// The errno of the first write to standard output that failed; 0 if none failed or its reason is unknown.
std::atomic<int> outputError = 0;

}  // namespace

int reportError(const planet::Error& error) {
    if (!error.message.empty()) printMessage("worldy: {}\n", error.message);
    return error.kind == planet::ErrorKind::Cancelled ? exitCancelled : exitBadInput;
}

void occupyStandardStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
        // The opposite mode makes writing to a closed stream an error instead of losing the text.
        ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

void keepOutputError(int error) {
    if (outputError == 0) outputError = error;
}

void flushStandardOutput() {
    if (std::fflush(stdout) != 0) keepOutputError(errno);
}

int afterStandardOutput(int exitCode) {
    flushStandardOutput();
    if (std::ferror(stdout) == 0 && outputError == 0) return exitCode;
    const std::string why =
        outputError == 0 ? "a write failed" : std::generic_category().message(outputError);
    const int failed =
        reportError({planet::ErrorKind::Io,
                     fmt::format("standard output: cannot be written: {}; output truncated", why)});
    return exitCode == exitOk || exitCode == exitCheckFailed ? failed : exitCode;
}

}  // namespace worldy
