#include "app/trace/trace_compare_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "app/trace/traced_frame.h"
#include "planet/trace/trace_index.h"

namespace worldy {

namespace {

using planet::Result;

// The comparison reads both traces; each report reads one.
constexpr double compareShare = 0.5, reportShare = 0.25;

double framesOf(const planet::TraceFile& file) {
    const auto range = file.frames();
    return range && range->last >= range->first ? static_cast<double>(range->last - range->first) + 1 : 1;
}

// Returns a function that counts its calls, of which about `calls` come, and reports a part of the progress.
std::function<bool()> partOf(double from, double share, double calls,
                             const std::function<bool(double)>& goOn) {
    return [=, &goOn, done = 0.0]() mutable {
        done += 1;
        return !goOn || goOn(from + share * std::min(done / std::max(calls, 1.0), 1.0));
    };
}

std::string textOf(const planet::TraceComparison& found, const planet::TraceFrameDifference& each) {
    std::string text = fmt::format("{} {}", each.frameA, each.frameB);
    for (const std::uint64_t id : each.nodesA) text += ' ' + tracedName(found.descriptionA, id);
    for (const std::uint64_t id : each.nodesB) text += ' ' + tracedName(found.descriptionB, id);
    return text;
}

}  // namespace

Result<TraceCompared> compareTraceFiles(const TraceCompareRequest& request,
                                        const std::function<bool(double)>& goOn) {
    Result<planet::TraceFile> a = planet::TraceFile::open(request.fileA);
    if (!a) return tl::unexpected(a.error());
    Result<planet::TraceFile> b = planet::TraceFile::open(request.fileB);
    if (!b) return tl::unexpected(b.error());
    auto found = planet::compareTraces(*a, *b, {.match = request.match},
                                       partOf(0, compareShare, std::max(framesOf(*a), framesOf(*b)), goOn));
    if (!found) return tl::unexpected(found.error());
    const auto reportOf = [&](planet::TraceFile& file, double from) {
        return planet::reportOfTrace(
            file, request.budgetMs, request.faults,
            partOf(from, reportShare, static_cast<double>(file.blocks().size()), goOn));
    };
    auto reportA = reportOf(*a, compareShare);
    if (!reportA) return tl::unexpected(reportA.error());
    auto reportB = reportOf(*b, compareShare + reportShare);
    if (!reportB) return tl::unexpected(reportB.error());
    TraceCompared compared{.request = request,
                           .found = *std::move(found),
                           .reportA = *std::move(reportA),
                           .reportB = *std::move(reportB)};
    for (const planet::TraceFrameDifference& each : compared.found.differences)
        compared.texts.push_back(textOf(compared.found, each));
    return compared;
}

std::string whyNothingCompared(const TraceCompared& compared) {
    const planet::TraceComparison& found = compared.found;
    if (found.frames > found.skippedFrames) return {};
    const std::string name = compared.request.fileB.filename().string();
    if (found.frames > 0)
        return fmt::format("{}: every frame that both traces have lost events in one of the two.", name);
    if (found.match == planet::TraceMatch::Number)
        return fmt::format("{}: no frame has the same number as one of the open trace.", name);
    return fmt::format("{}: no frame has the same time as one of the open trace. Match frames by number.",
                       name);
}

TraceCompareJob::TraceCompareJob(TraceCompareRequest request)
    : job_([this, request = std::move(request)](const std::stop_token& stop) {
          return compareTraceFiles(request, [&](double share) {
              progress_ = share;
              return !stop.stop_requested();
          });
      }) {}

void startTraceCompare(TraceCompareRun& run, const TraceCompareRequest& request, const Log& log) {
    if (request.fileA.empty() || run.job) return;
    ++run.runs;
    run.request = request;
    run.problem.clear();
    run.isCancelled = false;
    log.info("Comparing {} with {}", request.fileA.filename().string(), request.fileB.filename().string());
    run.job = std::make_unique<TraceCompareJob>(request);
}

void advanceTraceCompare(TraceCompareRun& run, const Log& log) {
    if (!run.job) return;
    std::optional<Result<TraceCompared>> result = run.job->takeResult();
    if (!result) return;
    run.job.reset();
    if (*result) {
        run.result = **std::move(result);
        run.problem = whyNothingCompared(*run.result);
        log.info("Compared {} frames, {} differ", run.result->found.frames,
                 run.result->found.framesThatDiffer);
    } else {
        run.isCancelled = result->error().kind == planet::ErrorKind::Cancelled;
        run.problem = run.isCancelled ? "The comparison was cancelled." : result->error().message;
    }
    if (!run.problem.empty()) log.write(run.isCancelled ? LogLevel::Warning : LogLevel::Error, run.problem);
}

}  // namespace worldy
