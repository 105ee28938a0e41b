#include "app/trace/trace_what_if_job.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planet/trace/trace_index.h"

namespace worldy {

namespace {

using planet::Result;

constexpr float noValue = std::numeric_limits<float>::quiet_NaN();

// The search reads the trace up to three times, and the rows once.
constexpr double readsOfSearch = 3;

// Returns the larger value. NaN stands for no value.
float larger(float a, float b) {
    return std::fmax(a, b);
}

void addPoint(TracedValues& values) {
    for (std::vector<float>& each : values) each.push_back(noValue);
}

void addToLast(TracedValues& values, const planet::TraceSelection& selection) {
    const auto add = [&](TracedQuantity quantity, double value) {
        float& last = values[static_cast<std::size_t>(quantity)].back();
        last = larger(last, static_cast<float>(value));
    };
    add(TracedQuantity::Drawn, static_cast<double>(selection.drawn.size()));
    add(TracedQuantity::Triangles, static_cast<double>(selection.triangles));
    add(TracedQuantity::Bytes, static_cast<double>(selection.bytes));
    add(TracedQuantity::ErrorPx, selection.worstErrorPx);
    add(TracedQuantity::Switches, static_cast<double>(selection.splits + selection.merges));
    add(TracedQuantity::Unknown, static_cast<double>(selection.unknown));
}

// Keeps every other value.
template <class T>
void keepEven(std::vector<T>& values) {
    for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
    values.resize((values.size() + 1) / 2);
}

void mergePairs(TracedValues& values) {
    for (std::vector<float>& each : values) {
        for (std::size_t i = 0; i + 1 < each.size(); i += 2) each[i] = larger(each[i], each[i + 1]);
        keepEven(each);
    }
}

void mergePairs(TraceWhatIfSeries& series) {
    keepEven(series.frames);
    keepEven(series.timesS);
    mergePairs(series.engine);
    mergePairs(series.own);
    for (TracedValues& row : series.rows) mergePairs(row);
    series.framesInPoint *= 2;
}

// Counts the blocks that are read.
class Progress {
public:
    Progress(const planet::TraceFile& file, bool searches, const std::function<bool(double)>& goOn)
        : blocks_(static_cast<double>(std::max<std::size_t>(file.blocks().size(), 1)) *
                  (searches ? 1 + readsOfSearch : 1)),
          goOn_(goOn) {}

    bool goOn() {
        read_ += 1;
        return !goOn_ || goOn_(std::min(read_ / blocks_, 1.0));
    }

private:
    double blocks_;
    double read_ = 0;
    const std::function<bool(double)>& goOn_;
};

}  // namespace

void TraceWhatIfRecorder::beginFrame(const planet::TraceFrame& frame, View& view) const {
    TraceWhatIfSeries& series = view.series;
    if (!series.frames.empty() && view.framesInLast < series.framesInPoint) {
        ++view.framesInLast;
        return;
    }
    if (series.frames.size() >= maxTraceWhatIfPoints) mergePairs(series);
    if (series.frames.empty()) view.firstS = frame.timeS;
    const auto timeS = static_cast<float>(frame.timeS - view.firstS);
    const float lastS = series.timesS.empty() ? 0 : series.timesS.back();
    series.frames.push_back(frame.number);
    // An engine's clock may go back or be no number.
    series.timesS.push_back(timeS >= lastS && std::isfinite(timeS) ? timeS : lastS);
    addPoint(series.engine);
    addPoint(series.own);
    for (TracedValues& row : series.rows) addPoint(row);
    view.framesInLast = 1;
}

void TraceWhatIfRecorder::add(const planet::TraceState& state, int view, int row,
                              const planet::TraceSelection& selection) {
    auto found = std::ranges::find(views_, view, [](const View& each) { return each.series.view; });
    if (found == views_.end()) {
        View& made = views_.emplace_back();
        made.series.view = view;
        made.series.rows.resize(rows_);
        found = std::prev(views_.end());
    }
    TraceWhatIfSeries& series = found->series;
    // The engine's own selection comes first in each frame.
    if (row == -2) beginFrame(state.frame(), *found);
    TracedValues& values = row == -2   ? series.engine
                           : row == -1 ? series.own
                                       : series.rows[static_cast<std::size_t>(row)];
    addToLast(values, selection);
}

std::vector<TraceWhatIfSeries> TraceWhatIfRecorder::finish() {
    std::vector<TraceWhatIfSeries> series;
    for (View& view : views_) series.push_back(std::move(view.series));
    std::ranges::sort(series, {}, &TraceWhatIfSeries::view);
    return series;
}

Result<TraceWhatIfResult> runTraceWhatIf(const std::filesystem::path& file, const TraceWhatIfRequest& request,
                                         const std::function<bool(double)>& goOn) {
    Result<planet::TraceFile> trace = planet::TraceFile::open(file);
    if (!trace) return tl::unexpected(trace.error());
    Progress progress(*trace, request.goal.has_value(), goOn);
    const auto goesOn = [&] { return progress.goOn(); };
    TraceWhatIfRecorder recorder(request.settings.size());
    const auto watch = [&](const planet::TraceState& state, int view, int row,
                           const planet::TraceSelection& selection) {
        recorder.add(state, view, row, selection);
    };
    Result<planet::TraceWhatIfReport> report = planet::whatIfOfTrace(*trace, request.settings, goesOn, watch);
    if (!report) return tl::unexpected(report.error());
    TraceWhatIfResult result{.file = file, .request = request, .report = *std::move(report)};
    result.series = recorder.finish();
    for (const planet::TraceWhatIfView& view : result.report.views)
        result.fronts.push_back({planet::traceFront(view.rows, planet::TraceCost::Bytes),
                                 planet::traceFront(view.rows, planet::TraceCost::Triangles)});
    if (!request.goal || result.report.isDamaged) return result;
    const planet::TraceSelectorSettings settings =
        request.settings.empty() ? planet::TraceSelectorSettings{} : request.settings.front();
    const auto found = planet::suggestTraceTau(*trace, settings, *request.goal, goesOn);
    if (!found) return tl::unexpected(found.error());
    result.suggestion = *found;
    return result;
}

TraceWhatIfJob::TraceWhatIfJob(std::filesystem::path file, TraceWhatIfRequest request)
    : job_([this, file = std::move(file), request = std::move(request)](const std::stop_token& stop) {
          return runTraceWhatIf(file, request, [&](double share) {
              progress_ = share;
              return !stop.stop_requested();
          });
      }) {}

}  // namespace worldy
