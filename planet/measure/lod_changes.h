// How what is drawn changes from frame to frame: splits, merges, and chunks that flip back and forth. Plain
// data fed with one selection a frame; no clock. One thread at a time.
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
    ChunkId chunk;  // that was replaced by its children, or took their place
    LodChangeType type = LodChangeType::Split;
    bool thrash = false;  // the same chunk changed the other way less than a second before
};

class LodChanges {
public:
    // Compares with the selection before. A chunk that is culled or comes into view is no change of level; of
    // a jump over several levels each chunk that is split now and was not, or the reverse, is one. A time
    // before the last one forgets everything first.
    void add(const Selection& selection, double timeS);
    // Forgets everything: for another planet.
    void clear();

    // Of the last keptS seconds, oldest first; of one frame splits first.
    const std::deque<LodChange>& recent() const { return recent_; }
    double splitsPerS() const;  // over the last second
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
    std::unordered_map<ChunkId, LodChange> last_;  // of each chunk in recent_
    std::vector<ChunkId> splits_;                  // of the selection before
    std::vector<ChunkId> drawn_;
    double nowS_ = 0;
    std::uint64_t thrashTotal_ = 0;
};

}  // namespace planet
