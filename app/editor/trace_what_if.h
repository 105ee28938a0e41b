// Runs the selections that the What if panel asks for, and keeps the last result.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/base/log.h"
#include "app/trace/trace_what_if_job.h"
#include "ui/model/trace_what_if_view.h"

namespace worldy {

struct TraceWhatIfRun {
    std::unique_ptr<TraceWhatIfJob> job{};  // null if none is running
    std::optional<TraceWhatIfResult> result{};
    std::string problem{};  // why the last one failed or ended early
};

// Reads what is in the file now. Does nothing without a file or while one is running.
void startTraceWhatIf(TraceWhatIfRun& run, const std::filesystem::path& file,
                      const TraceWhatIfRequest& request, const Log& log);
void cancelTraceWhatIf(TraceWhatIfRun& run);
// Takes the result when there is one. Call it in each frame.
void advanceTraceWhatIf(TraceWhatIfRun& run, const Log& log);

// The view refers to the run.
ui::TraceWhatIfView traceWhatIfViewOf(const TraceWhatIfRun& run);

}  // namespace worldy
