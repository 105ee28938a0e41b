#include "app/editor/trace_what_if.h"

#include <fmt/format.h>

#include <utility>

namespace worldy {

void startTraceWhatIf(TraceWhatIfRun& run, const std::filesystem::path& file,
                      const TraceWhatIfRequest& request, const Log& log) {
    if (file.empty() || run.job) return;
    run.problem.clear();
    log.info("Selecting again over {}", file.filename().string());
    run.job = std::make_unique<TraceWhatIfJob>(file, request);
}

void cancelTraceWhatIf(TraceWhatIfRun& run) {
    if (run.job) run.job->cancel();
}

void advanceTraceWhatIf(TraceWhatIfRun& run, const Log& log) {
    if (!run.job) return;
    std::optional<planet::Result<TraceWhatIfResult>> result = run.job->takeResult();
    if (!result) return;
    run.job.reset();
    if (*result) {
        run.result = **std::move(result);
        log.info("Selected again over {} frames", run.result->report.frames);
        return;
    }
    const planet::Error& error = result->error();
    const bool isCancelled = error.kind == planet::ErrorKind::Cancelled;
    run.problem = isCancelled ? "The selection was cancelled." : error.message;
    log.write(isCancelled ? LogLevel::Warning : LogLevel::Error, run.problem);
}

ui::TraceWhatIfView traceWhatIfViewOf(const TraceWhatIfRun& run) {
    ui::TraceWhatIfView view;
    view.problem = run.problem;
    view.result = run.result ? &*run.result : nullptr;
    if (!run.job) return view;
    view.running = true;
    view.progress = run.job->progress();
    view.cancelling = run.job->cancelling();
    return view;
}

}  // namespace worldy
