#include "app/base/interrupt.h"

#include <atomic>
#include <csignal>

namespace worldy {

namespace {

// A signal handler can only write to globals.
std::atomic<bool> interruptSeen{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void noteInterrupt(int) {
    interruptSeen = true;
}

}  // namespace

InterruptWatch::InterruptWatch() {
    interruptSeen = false;
    std::signal(SIGINT, noteInterrupt);
    std::signal(SIGTERM, noteInterrupt);
}

InterruptWatch::~InterruptWatch() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptWatch::interrupted() const {
    return interruptSeen;
}

}  // namespace worldy
