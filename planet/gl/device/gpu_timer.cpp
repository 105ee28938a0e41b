#include "planet/gl/device/gpu_timer.h"

#include "planet/gl/device/gpu_clock.h"

namespace planet::gl {

GpuTimer::GpuTimer(const char* name) : name_(name) {
    GLint bits = 0;
    glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    available_ = bits > 0;
    if (!available_) return;
    for (Measurement& measurement : ring_) {
        measurement.start = makeQuery();
        measurement.stop = makeQuery();
    }
}

void GpuTimer::begin() {
    // With all queries in flight, this frame is not measured, so that nothing waits.
    running_ = available_ && !ring_[current_].pending;
    if (running_) glQueryCounter(ring_[current_].start.name(), GL_TIMESTAMP);
}

void GpuTimer::end() {
    if (!running_) return;
    glQueryCounter(ring_[current_].stop.name(), GL_TIMESTAMP);
    ring_[current_].pending = true;
    current_ = (current_ + 1) % ring_.size();
    running_ = false;
}

double GpuTimer::lastMs() {
    while (ring_[oldest_].pending) {
        Measurement& measurement = ring_[oldest_];
        GLint ready = 0;
        glGetQueryObjectiv(measurement.stop.name(), GL_QUERY_RESULT_AVAILABLE, &ready);
        if (ready == 0) break;
        GLuint64 startNs = 0;
        GLuint64 stopNs = 0;
        glGetQueryObjectui64v(measurement.start.name(), GL_QUERY_RESULT, &startNs);
        glGetQueryObjectui64v(measurement.stop.name(), GL_QUERY_RESULT, &stopNs);
        lastMs_ = static_cast<double>(stopNs - startNs) * 1e-6;
        recordGpuSpan(name_, startNs, stopNs);
        measurement.pending = false;
        oldest_ = (oldest_ + 1) % ring_.size();
    }
    return lastMs_;
}

}  // namespace planet::gl
