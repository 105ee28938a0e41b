// Lets long work poll for Ctrl-C.
#pragma once

namespace worldy {

// While it exists, SIGINT and SIGTERM set a flag instead of ending the program. Only one may exist at a time.
class InterruptWatch {
public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    bool interrupted() const;  // any thread
};

}  // namespace worldy
