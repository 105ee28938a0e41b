// Measures the GPU time between begin() and end() without waiting for the GPU, so results are some frames
// old. While spans are recorded, each measurement is also one in the lane of the GPU (gpu_clock.h). Uses timestamps rather
// than an elapsed-time query, so that a caller's own timer may enclose it.
#pragma once

#include <array>
#include <cstddef>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

class GpuTimer {
public:
    // name: of its spans, a string literal.
    explicit GpuTimer(const char* name);
    void begin();
    void end();
    double lastMs();  // of the last finished measurement; 0 before the first, or without timestamps

private:
    struct Measurement {
        Query start, stop;
        bool pending = false;
    };
    const char* name_;
    std::array<Measurement, 4> ring_;
    std::size_t current_ = 0;
    std::size_t oldest_ = 0;
    bool available_ = false;
    bool running_ = false;
    double lastMs_ = 0;
};

}  // namespace planet::gl
