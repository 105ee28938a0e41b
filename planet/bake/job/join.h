// Puts the finished units of a job together into its output, on all ranks together.
//
// Each rank has a run of units that lie together in the output, of about as many bytes as the others'. It merges the chunks
// above its units as far as it can. The subtrees that are left go up a tree of ranks, in as many steps as the number of ranks
// has bits. Then the sizes of all blocks are known: a sum over the ranks says where each begins, and each writes its own
// part. At last come the chunks that were held back (subtree_merging.h), level by level; each rank searches for the tight
// metrics of its share of them.
//
// A rank reads what others have written after they have all agreed on it. So the file system must show to every rank what
// another has written, once its call has returned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planet/bake/job/job_plan.h"
#include "planet/bake/job/spool.h"
#include "planet/bake/job/team.h"
#include "planet/bake/subtree_merging.h"
#include "planet/base/file_calls.h"
#include "planet/base/open_file.h"
#include "planet/base/result.h"

namespace planet {

// The files of finished units, which are opened when they are needed. One thread.
class SpoolFiles {
public:
    SpoolFiles(std::filesystem::path folder, std::uint64_t job, FileCalls calls)
        : folder_(std::move(folder)), job_(job), calls_(std::move(calls)) {}

    Result<const SpoolReader*> at(std::uint32_t file);

private:
    std::filesystem::path folder_;
    std::uint64_t job_;
    FileCalls calls_;
    std::unordered_map<std::uint32_t, SpoolReader> open_;
};

struct Join {
    Team& team;
    const JobPlan& plan;
    SpoolFiles& spool;
    std::span<const SpoolEntry> units;  // by unit, all of them
    const OpenFile& output;             // of this rank
    int threads = 1;
    std::function<bool()> goOn;  // false cancels; one thread at a time
    std::uint64_t bytesWritten = 0;
};

struct JoinedHeights {
    std::vector<DeferredChunk> roots;  // of the faces, in their order; only on rank 0
    std::uint64_t end = 0;             // of the blocks in the file
};

// Writes all blocks of heights but those of the roots, from an offset. All ranks call it together, and have the same
// outcome.
Result<JoinedHeights> joinHeights(Join& join, std::uint64_t offset);

struct JoinedColours {
    ColourPyramid pyramid;
    std::uint64_t end = 0;
};
Result<JoinedColours> joinColours(Join& join, std::uint64_t offset);

// Returns the first unit of each rank's share, and the end: count + 1 ascending numbers.
std::vector<std::size_t> sharesOf(std::span<const SpoolEntry> units, int ranks);

}  // namespace planet
