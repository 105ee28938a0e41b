// Measures the true error on a thread of its own, and keeps the last measurement for the window. It measures
// a copy of the chunks of one frame, so the planet can go on.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "app/base/job.h"
#include "app/scene/error_measurement.h"
#include "planet/measure/true_error.h"
#include "planet/planet.h"

namespace worldy {

// All calls come from one thread. The destructor cancels and waits for the end, which takes some
// milliseconds.
class ErrorJob {
public:
    ErrorJob(planet::DrawnSnapshot snapshot, std::shared_ptr<planet::FinestHeights> heights);

    double progress() const { return progress_; }  // [0, 1]
    std::optional<planet::Result<planet::TrueErrorReport>> takeResult() { return job_.takeResult(); }
    double tookS() const { return tookS_; }  // valid after takeResult() has returned the result

private:
    std::atomic<double> progress_{0};
    std::atomic<double> tookS_{0};
    Job<planet::Result<planet::TrueErrorReport>> job_;  // last: it uses the other members
};

// The state of the instrument in the window. At most one measurement runs at a time.
struct ErrorMeter {
    bool wanted = false;         // one measurement is requested
    bool keepMeasuring = false;  // while set, each view that differs from the last is measured
    std::shared_ptr<planet::FinestHeights> heights{};  // heights of the current planet
    std::unique_ptr<ErrorJob> job{};
    ErrorMeasurement running{};  // frame and settings of the running measurement
    std::optional<ErrorMeasurement> last{};
    bool current = false;  // true if the chunks of the last frame are those of `last`
    std::string problem{};
};

// Discards all measurements. Call it when another planet is shown.
void forgetErrors(ErrorMeter& meter);

// Takes a finished measurement, and starts a requested one with the planet's first view. Call it once per
// frame after the selection.
void advanceErrorMeter(const planet::Planet& planet, std::uint64_t frame, ErrorMeter& meter);

}  // namespace worldy
