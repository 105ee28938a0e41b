// A hash table of chunk ids, for lists that are rebuilt each frame. It uses open addressing and is at most
// half full, so that filling it is fast. One thread at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "planet/sphere/chunk_id.h"

namespace planet {

class ChunkTable {
public:
    // mostChunks: the largest number of distinct chunks.
    explicit ChunkTable(std::size_t mostChunks)
        : entries_(std::bit_ceil(std::max<std::size_t>(mostChunks, 1) * 2)),
          shift_(64 - std::countr_zero(entries_.size())) {}

    void add(const ChunkId& id, std::uint32_t value) {
        const std::uint64_t key = keyOf(id);
        entries_[placeOf(key)] = {key, value};
    }

    // Returns the value that was added with the chunk; null if there is none.
    const std::uint32_t* find(const ChunkId& id) const {
        const Entry& entry = entries_[placeOf(keyOf(id))];
        return entry.key == noKey ? nullptr : &entry.value;
    }
    // Returns the value of the finest added chunk that is this one or an ancestor. No added chunk may be
    // coarser than coarsestLevel.
    const std::uint32_t* findHolder(ChunkId id, int coarsestLevel) const {
        const std::uint32_t* found = find(id);
        while (!found && id.level > coarsestLevel) {
            id = parentOf(id);
            found = find(id);
        }
        return found;
    }
    bool contains(const ChunkId& id) const { return find(id) != nullptr; }

private:
    static constexpr std::uint64_t noKey = ~std::uint64_t{0};
    struct Entry {
        std::uint64_t key = noKey;
        std::uint32_t value = 0;
    };

    // Returns the slot of the key, or the empty slot where it would go.
    std::size_t placeOf(std::uint64_t key) const {
        auto place = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> shift_);
        while (entries_[place].key != noKey && entries_[place].key != key) {
            place = (place + 1) & (entries_.size() - 1);
        }
        return place;
    }

    std::vector<Entry> entries_;
    int shift_;
};

}  // namespace planet
