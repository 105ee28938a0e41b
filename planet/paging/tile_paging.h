// What tiles of colours or of normals stay resident, and what makes room: their share of a Planet's paging.
// Inside the library only.
//
// Slots come in fours, one four for each block of tiles. Each page-in that is queued or being read is
// promised a four, without saying which: freeBlocks.size() >= promised. A tile that goes is no longer drawn
// in the very step that drops it, since what is drawn finds its tiles afresh in every frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "planet/paging/block_failures.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_queue.h"
#include "planet/paging/paging_types.h"
#include "planet/select/tile_select.h"
#include "planet/tree/tile_tree.h"

namespace planet {

// What several views together say of a block.
struct MergedRequest {
    NodeIndex parent = noNode;
    ChunkId parentId;
    float priority = 0;  // the largest of what follows
    std::array<float, maxViews> viewPriority{};
};

struct TilePaging {
    BlockKind kind = BlockKind::Colours;
    int leafLevel = -1;  // of the pyramid; -1: the planet has none
    // Of colours: a block that has failed for good is resident as this. Of normals none: it stays away.
    std::optional<ColourFormat> checkers;
    // Kept, so that they can be shown again. One without texels could not be had.
    std::array<TileData, faceCount> roots;
    TileTree tree;                          // empty where there is no room for any
    std::uint32_t tileCapacity = 0;         // slots of the pool of tiles, the roots' six included; 0: off
    std::vector<std::uint32_t> freeBlocks;  // first slots of fours
    std::size_t promised = 0;               // page-ins that will want slots
    std::uint64_t oldestTicketKept = 1;     // loads of older ones are thrown away
    std::vector<TileChange> changes;
    TilePagingCounters counters;
    bool roomToCome =
        false;  // in the last step something had to wait for a block to be out of use long enough
    BlockFailures failures;

    bool isOn() const { return tileCapacity > 0; }

    // Evicts every block and begins with the roots alone, in a pool of so many slots; with nothing where
    // capacity is 0. Failures are kept.
    void begin(std::uint32_t capacity, double sinceAnewS);

    // Marks what views have looked at in a frame.
    void use(const std::vector<NodeIndex>& touched, std::uint64_t frame);

    // Puts page-ins for what is wanted, the most wanted first, into the queue, as far as there is room. Those
    // that are pending have been renewed.
    using Note = std::function<void(const PagingRequest& request, PagingOutcome outcome)>;
    struct Asking {
        std::uint64_t frame;
        double nowS;
        double sinceAnewS;
        std::uint64_t& nextTicket;
        const Note& note;
        std::vector<BlockId>* requested;  // where they are told of too; null: nowhere
    };
    void request(PagingQueue& queue, const std::vector<MergedRequest>& wanted,
                 const std::vector<MergedRequest>& splits, const Asking& asking);

    // Undoes what request did for a page-in that no loader has taken, or whose read comes to nothing.
    void withdraw(const ChunkId& parent);

    // Makes a block resident that was read.
    void finish(const ChunkId& parent, TileBlock&& tiles, std::uint64_t frame, double sinceAnewS);
    // A block could not be read. Where that is for good, makes a checker pattern resident in its place, or
    // nothing, and returns true.
    bool fail(const ChunkId& parent, Error error, std::uint64_t frame, double sinceAnewS,
              const RetryRules& rules);
    // Drops those patterns, so that such blocks are asked for again; all, or one.
    void retryAll();
    void retryOne(const ChunkId& parent);
    void count();

private:
    bool promiseRoom(PagingQueue& queue, const MergedRequest& wanted,
                     const std::vector<MergedRequest>& splits, const Asking& asking);
    bool evictUnused(const Asking& asking);
    bool evictLessWanted(const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                         const Asking& asking);
    bool mayBeEvicted(NodeIndex parent) const;
    void evict(NodeIndex parent, const Asking& asking);
    void remove(NodeIndex parent);
    void addResident(const ChunkId& parent, TileBlock&& tiles, std::uint64_t frame, double sinceAnewS);
    void showCheckers(const ChunkId& parent, std::uint64_t frame, double sinceAnewS);
    void retry(NodeIndex node);
};

// The tiles that a share of a budget pays for: the roots' six and then whole blocks, no more than there are
// or than `most`. The Error says what the least is: enough that the finest level can be reached in one place.
struct TilePyramid {
    const char* name = "";  // "colour tiles"
    int leafLevel = 0;
    std::size_t tileBytes = 0;
};
Result<std::uint32_t> tilesFor(const TilePyramid& pyramid, std::size_t budgetBytes, std::uint32_t most);

}  // namespace planet
