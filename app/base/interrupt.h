// Ctrl-C as a question that a long piece of work asks now and then.
#pragma once

namespace worldy {

// While one lives, SIGINT and SIGTERM set a flag instead of ending the program. One at a time.
class InterruptWatch {
public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    bool interrupted() const;  // any thread
};

}  // namespace worldy
