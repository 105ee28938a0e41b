// How long the GPU took for what lies between begin() and end(), without waiting for it: the answer is some
// frames old. Timestamps rather than an elapsed-time query, so that a caller's own timer may run around it.
#pragma once

#include <array>
#include <cstddef>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

class GpuTimer {
public:
    GpuTimer();
    void begin();
    void end();
    double lastMs();  // of the last measurement that has come back; 0 before the first, or without timestamps

private:
    struct Measurement {
        Query start, stop;
        bool pending = false;
    };
    std::array<Measurement, 4> ring_;
    std::size_t current_ = 0;
    std::size_t oldest_ = 0;
    bool available_ = false;
    bool running_ = false;
    double lastMs_ = 0;
};

}  // namespace planet::gl
