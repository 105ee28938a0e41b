// Selects again over a whole trace with other settings, on a thread of its own (planet/trace/trace_what_if.h).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "app/trace/trace_what_if_request.h"
#include "planet/base/result.h"

namespace worldy {

// The cost, the error and the changes of a selection in a frame.
enum class TracedQuantity : std::uint8_t {
    Drawn,      // nodes
    Triangles,  // of nodes that told them
    Bytes,      // that the view needs
    ErrorPx,    // the largest one of a drawn node; NaN if none is known
    Switches,   // splits and merges
    Unknown,    // nodes that are drawn because children or errors are not known
};
inline constexpr std::size_t tracedQuantityCount = 6;

// A selection over the flight: by quantity, one value for each point.
using TracedValues = std::array<std::vector<float>, tracedQuantityCount>;

// The selections of a view over the flight. Each point is the largest values of some frames that follow each other.
struct TraceWhatIfSeries {
    int view = 0;
    std::uint64_t framesInPoint = 1;
    std::vector<std::uint64_t> frames{};  // the first frame of each point
    std::vector<float> timesS{};          // engine's clock, from 0 in the first point on, never descending
    TracedValues engine{};                // what the engine drew
    TracedValues own{};                   // its own settings; NaN in frames without τ
    std::vector<TracedValues> rows{};     // in the order of the settings
};
inline constexpr std::size_t maxTraceWhatIfPoints = 2048;  // more are merged, two and two; even

// Which rows are on the Pareto front of the largest error and a cost, by row.
struct TraceWhatIfFronts {
    std::vector<bool> bytes{};
    std::vector<bool> triangles{};
};

struct TraceWhatIfResult {
    std::filesystem::path file{};
    TraceWhatIfRequest request{};
    planet::TraceWhatIfReport report{};       // with its problem if the trace is damaged or cut off
    std::vector<TraceWhatIfSeries> series{};  // the views of the report, in its order
    std::vector<TraceWhatIfFronts> fronts{};  // the same
    std::optional<planet::TraceTauSuggestion> suggestion{};  // for request.goal; none if the trace is damaged
};

// Takes the selections of a trace's frames, in order. One thread at a time.
class TraceWhatIfRecorder {
public:
    // rows: the number of settings.
    explicit TraceWhatIfRecorder(std::size_t rows) : rows_(rows) {}

    // Takes a selection; the arguments are those of planet::TraceWhatIf::Watch.
    void add(const planet::TraceState& state, int view, int row, const planet::TraceSelection& selection);
    // Returns the series by ascending view. Call it once.
    std::vector<TraceWhatIfSeries> finish();

private:
    struct View {
        TraceWhatIfSeries series;
        std::uint64_t framesInLast = 0;  // in the last point
        double firstS = 0;
    };
    void beginFrame(const planet::TraceFrame& frame, View& view) const;

    std::size_t rows_;
    std::vector<View> views_;
};

// Reads the trace, which may still grow: what is there now counts. goOn gets the progress in [0, 1]; returning false ends
// with an Error of the kind Cancelled. The Error names the file. A damaged trace gives a result of what came before.
planet::Result<TraceWhatIfResult> runTraceWhatIf(const std::filesystem::path& file,
                                                 const TraceWhatIfRequest& request,
                                                 const std::function<bool(double)>& goOn);

// All calls come from one thread. The destructor cancels and waits for the current block of the trace.
class TraceWhatIfJob {
public:
    TraceWhatIfJob(std::filesystem::path file, TraceWhatIfRequest request);

    double progress() const { return progress_; }  // [0, 1]
    void cancel() { job_.cancel(); }
    bool cancelling() const { return job_.cancelling(); }
    // Returns the result once, when there is one.
    std::optional<planet::Result<TraceWhatIfResult>> takeResult() { return job_.takeResult(); }

private:
    std::atomic<double> progress_{0};
    Job<planet::Result<TraceWhatIfResult>> job_;  // last: it uses progress_
};

}  // namespace worldy
