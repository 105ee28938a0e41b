// Predicts how long a job takes on more ranks than there are, from what the units of a real job have cost: it hands them
// out as a job does (unit_feed.h) to ranks that are numbers only. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <span>

namespace planet {

// The costs of a real job.
struct UnitCost {
    double seconds = 0;  // of one thread
    std::uint64_t bytes = 0;
};
struct JobCosts {
    std::span<const UnitCost> units;  // in their order
    double openS = 0;                 // opening the source and planning, which each rank does for itself
    double surveyS = 0;  // of one thread, to read the source for its range, which the ranks share
    double joinS = 0;    // of one thread, to put all units together, without reading and writing
};

// The machines.
struct Cluster {
    int ranks = 1;
    int threads = 1;         // of a rank
    double bytesPerS = 1e9;  // of the file system, shared by all ranks; > 0
    double answerS = 0.001;  // from asking for units to having them
};

// The seconds from the beginning to the end. All but bakeS is what keeps the efficiency below 1.
struct JobSchedule {
    double totalS = 0;
    double openS = 0;  // with the share of the survey
    double bakeS = 0;  // until the last rank has no more units
    double idleS = 0;  // of bakeS, in which a rank had no units, on average
    double joinS = 0;
    double bytesS = 0;      // of bakeS and joinS, in which they waited for the file system
    double efficiency = 0;  // the share of all threads' time that bakes units, (0, 1]
};

// Units are written once to be kept, read once and written once to the output.
JobSchedule scheduleJob(const JobCosts& costs, const Cluster& cluster);

}  // namespace planet
