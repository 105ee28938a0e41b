#include "planet/bake/job/job_schedule.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <vector>

#include "planet/bake/job/unit_feed.h"

namespace planet {

namespace {

// A rank that bakes: when it will have baked its share, and what it bakes then.
struct Busy {
    double untilS = 0;
    UnitRange next;
    bool operator>(const Busy& other) const { return untilS > other.untilS; }
};

}  // namespace

JobSchedule scheduleJob(const JobCosts& costs, const Cluster& cluster) {
    const auto threads = static_cast<double>(cluster.threads);
    double workS = 0;
    double bytes = 0;
    for (const UnitCost& unit : costs.units) {
        workS += unit.seconds;
        bytes += static_cast<double>(unit.bytes);
    }
    const auto secondsOf = [&](const UnitRange& range) {
        double seconds = 0;
        for (const UnitCost& unit : costs.units.subspan(static_cast<std::size_t>(range.first),
                                                        static_cast<std::size_t>(range.count)))
            seconds += unit.seconds;
        return seconds / threads;
    };
    UnitShares shares({{0, costs.units.size()}}, cluster.ranks);
    std::priority_queue<Busy, std::vector<Busy>, std::greater<>> ranks;
    // Each rank asks for its next share when it begins one.
    std::vector<UnitRange> first(static_cast<std::size_t>(cluster.ranks));
    for (UnitRange& share : first) share = shares.next();
    for (const UnitRange& share : first) ranks.push({cluster.answerS + secondsOf(share), shares.next()});
    double busyS = 0;
    double bakeS = 0;
    while (!ranks.empty()) {
        const Busy rank = ranks.top();
        ranks.pop();
        bakeS = std::max(bakeS, rank.untilS);
        if (rank.next.count == 0) {
            busyS += rank.untilS;
            continue;
        }
        ranks.push({rank.untilS + secondsOf(rank.next), shares.next()});
    }
    JobSchedule schedule;
    schedule.openS = costs.openS + costs.surveyS / (cluster.ranks * threads);
    schedule.idleS = bakeS - busyS / cluster.ranks;
    const double spoolS = std::max(0.0, bytes / cluster.bytesPerS - bakeS);
    schedule.bakeS = bakeS + spoolS;
    const double mergeS = costs.joinS / (cluster.ranks * threads);
    const double copyS = 2 * bytes / cluster.bytesPerS;
    schedule.joinS = mergeS + copyS;
    schedule.bytesS = spoolS + copyS;
    schedule.totalS = schedule.openS + schedule.bakeS + schedule.joinS;
    schedule.efficiency =
        schedule.totalS > 0 ? workS / (schedule.totalS * static_cast<double>(cluster.ranks) * threads) : 1;
    return schedule;
}

}  // namespace planet
