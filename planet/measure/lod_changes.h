// Counts the changes of the drawn chunks from frame to frame: splits, merges, and chunks that flip back and
// forth. Takes one selection per frame and reads no clock. One thread at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "planet/select/lod_types.h"

namespace planet {

enum class LodChangeType : std::uint8_t { Split, Merge };

struct LodChange {
    double timeS = 0;
    ChunkId chunk;  // replaced by its children, or replacing them
    LodChangeType type = LodChangeType::Split;
    bool thrash = false;  // the same chunk changed in the other direction less than 1 s before
};

class LodChanges {
public:
    // Compares the selection with the previous one. A chunk that is culled or comes into view is no change of
    // level. A jump over several levels counts every chunk that begins or ends to be split. A time before the
    // last one clears everything first.
    void add(const Selection& selection, double timeS);
    // Clears everything, for another planet.
    void clear();

    // Returns the changes of the last keptS seconds, oldest first; splits come first in a frame.
    const std::deque<LodChange>& recent() const { return recent_; }
    double splitsPerS() const;  // in the last second
    double mergesPerS() const;
    std::uint64_t thrashTotal() const { return thrashTotal_; }
    std::size_t thrashRecent() const;  // in the last keptS seconds

    static constexpr double keptS = 10;
    static constexpr double thrashWithinS = 1;

private:
    void note(const ChunkId& chunk, LodChangeType type);
    void forgetOld();
    double perS(LodChangeType type) const;

    std::deque<LodChange> recent_;
    std::unordered_map<ChunkId, LodChange> last_;  // by chunk, of recent_
    std::vector<ChunkId> splits_;                  // of the previous selection
    std::vector<ChunkId> drawn_;
    double nowS_ = 0;
    std::uint64_t thrashTotal_ = 0;
};

}  // namespace planet
