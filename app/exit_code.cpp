#include "app/exit_code.h"

#include <fmt/format.h>

#include <cstdio>

namespace worldy {

int reportError(const planet::Error& error) {
    fmt::print(stderr, "worldy: {}\n", error.message);
    return error.kind == planet::ErrorKind::Cancelled ? exitCancelled : exitBadInput;
}

}  // namespace worldy
