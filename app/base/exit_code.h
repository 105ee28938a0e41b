// What the program ends with, and how it says why.
#pragma once

#include "planet/base/result.h"

namespace worldy {

inline constexpr int exitOk = 0;
inline constexpr int exitCheckFailed = 1;  // what was to be checked is there and wrong
inline constexpr int exitBadInput = 2;     // bad input, or reading or writing failed
inline constexpr int exitCancelled = 130;

// Writes "worldy: message" to stderr; the code that the program must end with.
int reportError(const planet::Error& error);

// Opens /dev/null in the place of each standard stream that is closed. Else the next file that is opened
// would take its number, and with it the text that is meant for the terminal.
void occupyStandardStreams();

// Flushes standard output, and keeps the reason if that fails for afterStandardOutput. Use it in place of
// std::fflush, which leaves the reason to whatever fails next.
void flushStandardOutput();
// Keeps an errno for the same, of a write to standard output that has just failed.
void keepOutputError(int error);

// Flushes standard output. Returns exitCode, or where text was lost writes why to stderr and returns
// exitBadInput instead of exitOk and exitCheckFailed. Call last.
int afterStandardOutput(int exitCode);

}  // namespace worldy
