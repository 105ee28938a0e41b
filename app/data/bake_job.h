// A bake and the estimate of a bake on threads of their own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "app/base/job.h"
#include "app/data/bake_request.h"
#include "app/data/bake_task.h"
#include "app/data/source_jobs.h"
#include "planet/bake/bake.h"
#include "planet/bake/bake_estimate.h"
#include "planet/bake/job/unit_feed.h"
#include "planet/source/height_source.h"

namespace worldy {

// Bakes into a file, with colours if an image is given. goOn receives the progress; returning false cancels.
// If an image that may fail is unreadable, colourProblem is set to the reason.
planet::Result<planet::BakeReport> bakeWithColour(const planet::HeightSource& heights,
                                                  const planet::BakeSettings& settings,
                                                  const std::filesystem::path& output,
                                                  const planet::BakeProgressCallback& goOn,
                                                  const JobColour& colour, std::string& colourProblem);

// Bakes of up to this many samples, which take a few seconds, have no first look.
inline constexpr std::uint64_t mostWithoutFirstLook = 8'000'000;

// All calls come from one thread. The destructor cancels and waits for the end of the bake.
class BakeJob {
public:
    explicit BakeJob(BakeTask task);

    planet::JobProgress progress() const;  // without units if it runs here
    // Returns true once, when the first look is baked.
    bool takeFirstLook();
    void cancel() { job_.cancel(); }
    bool cancelling() const { return job_.cancelling(); }
    std::optional<planet::Result<planet::BakeReport>> takeResult() { return job_.takeResult(); }
    // Returns why a finished bake lacks the colours that it was asked for; otherwise empty.
    std::string colourProblem() const;
    // Returns the layers of the source, once it is open; null before that.
    SharedLayers layers() const;

private:
    planet::Result<planet::BakeReport> run(const std::stop_token& stop, BakeTask task);
    planet::Result<planet::BakeReport> bakeOpened(const std::stop_token& stop, const BakeTask& task,
                                                  const planet::HeightSource& heights);

    mutable std::mutex mutex_;
    bool firstLookIsBaked_ = false;                // guarded by mutex_
    planet::JobProgress progress_;                 // guarded by mutex_
    std::string colourProblem_;                    // guarded by mutex_
    SharedLayers layers_;                          // guarded by mutex_
    Job<planet::Result<planet::BakeReport>> job_;  // last: it uses the other members
};

class EstimateJob : public Job<planet::Result<planet::BakeEstimate>> {
public:
    explicit EstimateJob(BakeRequest request);
};

}  // namespace worldy
