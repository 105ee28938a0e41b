// Hands out the units of a job by demand: rank 0 leads, and each rank asks for more while it works. A leader was chosen
// over a shared counter (MPI_Fetch_and_op), because that needs the rank that holds the counter to call MPI all the time on
// networks without remote memory access, and cannot give large shares first and small ones at the end.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "planet/bake/bake_report.h"
#include "planet/bake/job/team.h"

namespace planet {

struct UnitRange {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    bool operator==(const UnitRange&) const = default;
};

// Cuts what is left of a job's units into shares: large ones first, which lie together on the planet, and small ones at
// the end, so that all ranks end at the same time. One thread.
class UnitShares {
public:
    // left: the units that have to be baked, ascending.
    UnitShares(std::vector<UnitRange> left, int ranks);

    UnitRange next();  // none at the end

private:
    std::vector<UnitRange> left_;  // the next one last
    std::uint64_t count_ = 0;
    std::uint64_t ranks_;
};

// The work that a rank has done, for the progress of the job. Its working thread writes it.
struct UnitCounts {
    std::atomic<std::uint64_t> units = 0;
    std::atomic<std::uint64_t> samples = 0;
};

struct JobProgress {
    BakeProgress bake;  // of all ranks; on a rank other than 0, all zero
    std::uint64_t unitsDone = 0;
    std::uint64_t unitsTotal = 0;
    int ranks = 1;
    int slowestRank = 0;  // the one that has done the fewest samples
    double slowestSamplesPerS = 0;
};
// Called by the thread that bakes the job, a few times per second, on every rank. Returning false on any of them cancels
// the job.
using JobProgressCallback = std::function<bool(const JobProgress&)>;

// The units that a rank has yet to bake: the link between the thread that talks to the leader and the one that works.
class UnitFeed {
public:
    // Returns the next unit; waits for the leader. None at the end, or when the job stops.
    std::optional<std::uint64_t> next();
    // Returns how long next() has waited.
    double waitedS() const;

    // For the thread that talks to the leader.
    bool wantsMore() const;
    void give(const UnitRange& units);  // none: there are no more
    void stop();
    bool hasStopped() const;  // any thread

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    UnitRange now_;
    UnitRange then_;  // asked for while `now_` is baked
    bool ended_ = false;
    bool stopped_ = false;
    double waitedS_ = 0;
};

// The work that is left in a job.
struct UnitWork {
    std::vector<UnitRange> left;
    std::uint64_t unitsTotal = 0;
    std::uint64_t samplesTotal = 0;
    std::uint64_t samplesLeft = 0;
};

// Runs `bake` on a thread of its own, which bakes the units of the feed, on all ranks together, until all are done or one
// has failed or was cancelled. Returns the outcome of this rank.
Result<void> bakeUnits(Team& team, const UnitWork& work, UnitFeed& feed, const UnitCounts& counts,
                       const std::function<Result<void>()>& bake, const JobProgressCallback& progress);

}  // namespace planet
