// A suggestion on a thread of its own, with its own GL context.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "app/base/job.h"
#include "app/suggest/suggest_run.h"
#include "app/suggest/suggest_search.h"
#include "planet/base/result.h"

namespace worldy {

// All calls come from one thread. The destructor cancels and waits for the end, which takes a fraction of a second.
class SuggestJob {
public:
    explicit SuggestJob(SuggestRequest request);

    void cancel() { job_->cancel(); }
    bool cancelling() const { return job_->cancelling(); }
    SuggestProgress progress() const;
    // Returns the new trials since the last call.
    std::vector<SuggestTrial> takeTrials();
    // Returns the result once. Take trials after it once more.
    std::optional<planet::Result<SuggestOutcome>> takeResult() { return job_->takeResult(); }

private:
    mutable std::mutex mutex_;
    SuggestProgress progress_;                                // guarded by mutex_
    std::vector<SuggestTrial> trials_;                        // guarded by mutex_
    std::optional<Job<planet::Result<SuggestOutcome>>> job_;  // always set; last: it uses the other members
};

}  // namespace worldy
