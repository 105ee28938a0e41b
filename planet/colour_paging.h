// What tiles of colour stay resident, and what makes room: the colours' share of a Planet's paging. Inside
// the library only.
//
// Slots come in fours, one four for each block of tiles. Each page-in that is queued or being read is
// promised a four, without saying which: freeBlocks.size() >= promised. A tile that goes is no longer drawn
// in the very step that drops it, since what is drawn finds its tiles afresh in every frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "planet/colour_select.h"
#include "planet/colour_tree.h"
#include "planet/pager.h"
#include "planet/paging_queue.h"
#include "planet/planet.h"

namespace planet {

// What several views together say of a block.
struct MergedRequest {
    NodeIndex parent = noNode;
    ChunkId parentId;
    float priority = 0;  // the largest of what follows
    std::array<float, maxViews> viewPriority{};
};

struct ColourPaging {
    ColourTree tree;
    ColourFormat format = ColourFormat::Bc1;
    std::array<ColourTileData, faceCount> roots;  // kept, so that they can be shown again
    std::uint32_t tileCapacity = 0;               // slots of the pool of tiles, the roots' six included
    std::vector<std::uint32_t> freeBlocks;        // first slots of fours
    std::size_t promised = 0;                     // page-ins that will want slots
    std::vector<ColourChange> changes;
    ColourPagingCounters counters;
    bool roomToCome =
        false;  // in the last step something had to wait for a block to be out of use long enough

    bool hasColours() const { return tree.leafLevel >= 0; }

    // Begins with the roots alone, in a pool of so many slots; whatever was resident is gone.
    void begin(std::uint32_t capacity);

    // Marks what views have looked at in a frame.
    void use(const std::vector<NodeIndex>& touched, std::uint64_t frame);

    // Puts page-ins for what is wanted, the most wanted first, into the queue, as far as there is room. Those
    // that are pending have been renewed.
    using Note = std::function<void(const PagingRequest& request, PagingOutcome outcome)>;
    struct Asking {
        std::uint64_t frame;
        double nowS;
        std::uint64_t& nextTicket;
        const Note& note;
        std::vector<BlockId>* requested;  // where they are told of too; null: nowhere
    };
    void request(PagingQueue& queue, const std::vector<MergedRequest>& wanted,
                 const std::vector<MergedRequest>& splits, const Asking& asking);

    // Undoes what request did for a page-in that no loader has taken, or whose read comes to nothing.
    void withdraw(const ChunkId& parent);

    // Makes a block resident that was read.
    void finish(const ChunkId& parent, ColourBlock&& tiles, std::uint64_t frame);
    // Makes a checker pattern resident in place of a block that could not be read.
    void fail(const ChunkId& parent, std::uint64_t frame);
    // Drops those patterns, so that their blocks are asked for again.
    void retryFailed();
    void count();

private:
    bool promiseRoom(PagingQueue& queue, const MergedRequest& wanted,
                     const std::vector<MergedRequest>& splits, const Asking& asking);
    bool evictUnused(const Asking& asking);
    bool evictLessWanted(float priority, const std::vector<MergedRequest>& splits, const Asking& asking);
    bool mayBeEvicted(NodeIndex parent) const;
    void evict(NodeIndex parent, const Asking& asking);
    void remove(NodeIndex parent);
};

// The tiles that a share of a budget pays for: the roots' six and then whole blocks, no more than there are
// or than `most`. The Error says what the least is: enough that the finest level can be reached in one place.
Result<std::uint32_t> tilesFor(const ColourPyramid& colour, std::size_t budgetBytes, std::uint32_t most);

}  // namespace planet
