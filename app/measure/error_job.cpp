#include "app/measure/error_job.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "app/base/stopwatch.h"

namespace worldy {

namespace {

// One core is left to the window.
int measuringThreads() {
    return std::max(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1);
}

void takeResult(ErrorMeter& meter) {
    if (!meter.job) return;
    auto result = meter.job->takeResult();
    if (!result) return;
    const double tookS = meter.job->tookS();
    meter.job.reset();
    meter.problem.clear();
    if (!*result) {
        meter.problem = result->error().message;
        meter.keepMeasuring = false;  // it would only fail again, and again
        return;
    }
    ui::ErrorMeasurement measurement = ui::measurementOf(std::move(**result));
    measurement.frame = meter.running.frame;
    measurement.atS = meter.running.atS;
    measurement.lodView = meter.running.lodView;
    measurement.tauPx = meter.running.tauPx;
    measurement.metric = meter.running.metric;
    measurement.tookS = tookS;
    meter.last = std::move(measurement);
}

}  // namespace

ErrorJob::ErrorJob(planet::DrawnSnapshot snapshot, std::shared_ptr<planet::FinestHeights> heights)
    : thread_([this, snapshot = std::move(snapshot), heights = std::move(heights)] {
          const auto onProgress = [this](std::uint64_t done, std::uint64_t total) {
              progress_ = static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(total, 1));
              return !cancelled_.load();
          };
          const Stopwatch watch;
          planet::Result<planet::TrueErrorReport> result = planet::cancelled();
          tbb::task_arena(measuringThreads()).execute([&] {
              result = planet::measureTrueError(snapshot, *heights, onProgress);
          });
          const std::lock_guard lock(mutex_);
          tookS_ = watch.elapsedMs() / 1000;
          result_ = std::move(result);
      }) {}

ErrorJob::~ErrorJob() {
    cancelled_ = true;
    thread_.join();
}

std::optional<planet::Result<planet::TrueErrorReport>> ErrorJob::takeResult() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

double ErrorJob::tookS() const {
    const std::lock_guard lock(mutex_);
    return tookS_;
}

void forgetErrors(ErrorMeter& meter) {
    const bool keep = meter.keepMeasuring;
    meter = {};
    meter.keepMeasuring = keep;
}

void advanceErrorMeter(const planet::Planet& planet, std::uint64_t frame, double timeS, ErrorMeter& meter) {
    takeResult(meter);
    if (meter.job || !(meter.wanted || meter.keepMeasuring)) return;
    meter.wanted = false;
    if (!meter.heights)
        meter.heights =
            std::make_shared<planet::FinestHeights>(std::make_shared<const planet::ChunkFile>(planet.file()));
    const planet::LodSettings& lod = planet.lodSettings();
    meter.running.frame = frame;
    meter.running.atS = timeS;
    meter.running.lodView = planet.lodView();
    meter.running.tauPx = lod.tauPx;
    meter.running.metric = lod.metric;
    meter.job = std::make_unique<ErrorJob>(
        planet::snapshotOf(planet.tree(), planet.selection().draw, planet.lodView(),
                           lod.seams == planet::SeamMode::Stitched),
        meter.heights);
}

ui::ErrorsView errorsViewOf(const ErrorMeter& meter, std::uint64_t frame) {
    ui::ErrorsView view;
    view.last = meter.last ? &*meter.last : nullptr;
    view.frame = frame;
    view.running = meter.job != nullptr || meter.wanted;
    view.progress = meter.job ? meter.job->progress() : 0;
    view.keepMeasuring = meter.keepMeasuring;
    view.problem = meter.problem;
    return view;
}

}  // namespace worldy
