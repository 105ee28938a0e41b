// A measurement of the true error on a thread of its own, and what the window keeps of it: the planet flies
// on while a copy of what one frame drew is measured.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/scene/error_measurement.h"
#include "planet/measure/true_error.h"
#include "planet/planet.h"

namespace worldy {

// All calls from one thread.
class ErrorJob {
public:
    ErrorJob(planet::DrawnSnapshot snapshot, std::shared_ptr<planet::FinestHeights> heights);
    ~ErrorJob();  // cancels, and waits for its end: some milliseconds
    ErrorJob(const ErrorJob&) = delete;
    ErrorJob& operator=(const ErrorJob&) = delete;

    double progress() const { return progress_; }  // [0, 1]
    // Once it has ended; nothing until then and nothing again after.
    std::optional<planet::Result<planet::TrueErrorReport>> takeResult();
    double tookS() const;  // once it has ended

private:
    mutable std::mutex mutex_;
    std::optional<planet::Result<planet::TrueErrorReport>> result_;  // guarded
    double tookS_ = 0;                                               // guarded
    std::atomic<double> progress_{0};
    std::atomic<bool> cancelled_{false};
    std::thread thread_;
};

// The window's: at most one measurement runs at a time.
struct ErrorMeter {
    bool wanted = false;                               // one is asked for
    bool keepMeasuring = false;                        // one after the other, for as long as this is set
    std::shared_ptr<planet::FinestHeights> heights{};  // of the planet that is shown
    std::unique_ptr<ErrorJob> job{};
    ErrorMeasurement running{};  // what is known of the one that runs: its frame and settings
    std::optional<ErrorMeasurement> last{};
    bool current = false;  // last is of what was drawn in the last frame
    std::string problem{};
};

// Another planet is shown: what was measured of the last one is dropped.
void forgetErrors(ErrorMeter& meter);

// Once a frame, after its chunks are chosen: takes what is done, and starts what is wanted from the planet's
// first view as it is in this frame.
void advanceErrorMeter(const planet::Planet& planet, std::uint64_t frame, double timeS, ErrorMeter& meter);

}  // namespace worldy
