// The exit codes of the program and its error output.
#pragma once

#include "planet/base/result.h"

namespace worldy {

inline constexpr int exitOk = 0;
inline constexpr int exitCheckFailed = 1;  // the checked data is readable and wrong
inline constexpr int exitBadInput = 2;     // bad input, or reading or writing failed
inline constexpr int exitCancelled = 130;

// Writes "worldy: message" to stderr; nothing if there is no message, because another process writes it. Returns the exit code.
int reportError(const planet::Error& error);

// Opens /dev/null in the place of each closed standard stream. Otherwise the next opened file would take its
// descriptor and receive the text for the terminal.
void occupyStandardStreams();

// Flushes standard output and keeps the errno of a failure for afterStandardOutput. Use it instead of
// std::fflush.
void flushStandardOutput();
// Keeps the errno of a failed write to standard output for afterStandardOutput.
void keepOutputError(int error);

// Flushes standard output and returns exitCode. If text was lost, writes the reason to stderr and returns
// exitBadInput instead of exitOk and exitCheckFailed. Call last.
int afterStandardOutput(int exitCode);

}  // namespace worldy
