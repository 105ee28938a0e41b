// A survey on a thread of its own.
#pragma once

#include <mutex>
#include <optional>

#include "app/base/job.h"
#include "app/measure/atlas_survey.h"
#include "planet/base/result.h"
#include "planet/measure/atlas_run.h"

namespace worldy {

// All calls come from one thread. The destructor cancels and waits for the end, which takes a fraction of a second.
class AtlasJob {
public:
    explicit AtlasJob(AtlasRequest request);

    void cancel() { job_->cancel(); }
    bool cancelling() const { return job_->cancelling(); }
    // Returns nothing while the tree is read.
    std::optional<planet::AtlasProgress> progress() const;
    // Returns the result once.
    std::optional<planet::Result<AtlasOutcome>> takeResult() { return job_->takeResult(); }

private:
    mutable std::mutex mutex_;
    std::optional<planet::AtlasProgress> progress_;         // guarded by mutex_
    std::optional<Job<planet::Result<AtlasOutcome>>> job_;  // always set; last: it uses the other members
};

}  // namespace worldy
