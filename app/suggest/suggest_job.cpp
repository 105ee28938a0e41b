#include "app/suggest/suggest_job.h"

#include <tbb/task_arena.h>

#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "app/base/job.h"
#include "app/suggest/suggest_run.h"
#include "planet/base/result.h"

namespace worldy {

SuggestJob::SuggestJob(SuggestRequest request) {
    job_.emplace([this, request = std::move(request)](const std::stop_token& stop) {
        const SuggestWatcher watcher{.progress =
                                         [&](const SuggestProgress& progress) {
                                             const std::lock_guard lock(mutex_);
                                             progress_ = progress;
                                             return !stop.stop_requested();
                                         },
                                     .tried =
                                         [&](const SuggestTrial& trial) {
                                             const std::lock_guard lock(mutex_);
                                             trials_.push_back(trial);
                                         }};
        planet::Result<SuggestOutcome> outcome = planet::cancelled();
        // This thread takes part in the arena, so the GL calls stay on this thread.
        tbb::task_arena(backgroundThreads()).execute([&] { outcome = runSuggest(request, watcher); });
        return outcome;
    });
}

SuggestProgress SuggestJob::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

std::vector<SuggestTrial> SuggestJob::takeTrials() {
    const std::lock_guard lock(mutex_);
    return std::exchange(trials_, {});
}

}  // namespace worldy
