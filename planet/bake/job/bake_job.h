// Bakes a planet on several ranks together (ranks.h): the same bytes as bake() makes, with any number of ranks and threads,
// in any order.
//
// Each rank opens the source itself. They must have the same program, source and settings, and share a file system, which
// holds the output and, beside it, a folder of finished units (spool.h). The units are handed out by demand
// (unit_feed.h), and at the end all ranks put them together (join.h). If the job fails, the finished units stay, and a job
// with `resume` goes on with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planet/bake/bake_report.h"
#include "planet/bake/bake_settings.h"
#include "planet/bake/job/ranks.h"
#include "planet/bake/job/spool.h"
#include "planet/bake/job/unit_feed.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source_types.h"

namespace planet {

struct JobSettings {
    BakeSettings bake;      // threads: of each rank. An earlier bake to copy from is an Error.
    bool resume = false;    // goes on with the finished units of an earlier job, if there are any
    std::string program{};  // its version and build, which must be the same on all ranks
};

struct RankReport {
    std::string name;  // "rank 3 on node17"
    int threads = 0;
    std::uint64_t units = 0;
    std::uint64_t samples = 0;
    double bakeS = 0;  // until it had no more units
    double joinS = 0;  // to put the units together
    double waitS = 0;  // of both, for other ranks
    std::uint64_t spooledBytes = 0;
    std::uint64_t writtenBytes = 0;     // to the output
    std::uint64_t peakMemoryBytes = 0;  // resident, of the process
};

struct JobReport {
    BakeReport bake;
    std::uint64_t units = 0;
    std::uint64_t resumedUnits = 0;    // of an earlier job
    double planS = 0;                  // to divide the bake into units, which each rank does
    std::vector<RankReport> ranks;     // in their order
    std::vector<SpoolEntry> finished;  // by unit: what each cost, for predictions (job_schedule.h)
};

// All ranks call it together with the same arguments. Returns the report on rank 0, and an empty one on the others. The
// same Error comes to all ranks, and names the rank that has it. Writes the output atomically, as bake() does.
Result<JobReport> bakeJob(Ranks& ranks, const HeightSource& source, const JobSettings& settings,
                          const std::filesystem::path& output, const JobProgressCallback& progress = {},
                          const ColourSource* colour = nullptr);

}  // namespace planet
