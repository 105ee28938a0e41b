// Measures wall time. Any thread.
#pragma once

#include <chrono>

namespace planet {

class Stopwatch {
public:
    double elapsedS() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    double elapsedMs() const { return 1000 * elapsedS(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace planet
