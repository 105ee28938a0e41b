#include "app/measure/error_job.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "app/base/stopwatch.h"

namespace worldy {

namespace {

void takeResult(ErrorMeter& meter) {
    if (!meter.job) return;
    auto result = meter.job->takeResult();
    if (!result) return;
    const double tookS = meter.job->tookS();
    meter.job.reset();
    meter.problem.clear();
    if (!*result) {
        meter.problem = result->error().message;
        meter.keepMeasuring = false;  // it would only fail again
        return;
    }
    meter.last = measurementOf(std::move(**result), std::exchange(meter.running, {}));
    meter.last->tookS = tookS;
}

// Returns the drawn chunks of this frame and the settings that they were selected with.
ErrorMeasurement frameOf(const planet::Planet& planet) {
    const planet::LodSettings& lod = planet.views()[0].input.lod;
    ErrorMeasurement frame;
    frame.lodView = planet.views()[0].input.lodView;
    frame.tauPx = lod.tauPx;
    frame.metric = lod.metric;
    frame.stitched = lod.seams == planet::SeamMode::Stitched;
    frame.exaggeration = planet.tree().exaggeration;
    frame.drawn = planet.selection().draw;
    return frame;
}

bool isOf(const ErrorMeasurement& last, const planet::Planet& planet) {
    const planet::LodSettings& lod = planet.views()[0].input.lod;
    const auto& draw = planet.selection().draw;
    return last.lodView == planet.views()[0].input.lodView && last.tauPx == lod.tauPx &&
           last.metric == lod.metric && last.stitched == (lod.seams == planet::SeamMode::Stitched) &&
           last.exaggeration == planet.tree().exaggeration && drawnAlike(last.drawn, draw);
}

}  // namespace

ErrorJob::ErrorJob(planet::DrawnSnapshot snapshot, std::shared_ptr<planet::FinestHeights> heights)
    : job_([this, snapshot = std::move(snapshot), heights = std::move(heights)](const std::stop_token& stop) {
          const auto onProgress = [&](std::uint64_t done, std::uint64_t total) {
              progress_ = static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(total, 1));
              return !stop.stop_requested();
          };
          const Stopwatch watch;
          planet::Result<planet::TrueErrorReport> result = planet::cancelled();
          tbb::task_arena(backgroundThreads()).execute([&] {
              result = planet::measureTrueError(snapshot, *heights, onProgress);
          });
          tookS_ = watch.elapsedMs() / 1000;
          return result;
      }) {}

void forgetErrors(ErrorMeter& meter) {
    const bool keep = meter.keepMeasuring;
    meter = {};
    meter.keepMeasuring = keep;
}

void advanceErrorMeter(const planet::Planet& planet, std::uint64_t frame, ErrorMeter& meter) {
    takeResult(meter);
    meter.current = meter.last && isOf(*meter.last, planet);
    const bool again = meter.keepMeasuring && !meter.current;  // the same chunks have the same error
    if (meter.job || !(meter.wanted || again)) return;
    meter.wanted = false;
    if (!meter.heights)
        meter.heights =
            std::make_shared<planet::FinestHeights>(std::make_shared<const planet::ChunkFile>(planet.file()));
    meter.running = frameOf(planet);
    meter.running.frame = frame;
    meter.job = std::make_unique<ErrorJob>(drawnSnapshotOf(planet), meter.heights);
}

}  // namespace worldy
