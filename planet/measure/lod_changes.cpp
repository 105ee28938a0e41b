#include "planet/measure/lod_changes.h"

#include <algorithm>

#include "planet/tree/chunk_table.h"

namespace planet {

namespace {

ChunkTable tableOf(const std::vector<ChunkId>& ids) {
    ChunkTable table(ids.size());
    for (const ChunkId& id : ids) table.add(id, 0);
    return table;
}

std::vector<ChunkId> missingFrom(const ChunkTable& table, const std::vector<ChunkId>& ids) {
    std::vector<ChunkId> missing;
    for (const ChunkId& id : ids) {
        if (!table.contains(id)) missing.push_back(id);
    }
    return missing;
}

// Returns whether one of the drawn chunks is this chunk or its ancestor.
bool coversOne(const ChunkTable& drawn, ChunkId id) {
    while (!drawn.contains(id)) {
        if (id.level == 0) return false;
        id = parentOf(id);
    }
    return true;
}

}  // namespace

void LodChanges::add(const Selection& selection, double timeS) {
    if (timeS < nowS_) clear();
    nowS_ = timeS;
    forgetOld();
    std::vector<ChunkId> splits;
    splits.reserve(selection.splits.size());
    for (const ChildrenRequest& split : selection.splits) splits.push_back(split.parentId);
    std::vector<ChunkId> drawn;
    drawn.reserve(selection.draw.size());
    for (const DrawItem& item : selection.draw) drawn.push_back(item.id);
    if (splits != splits_) {
        // A chunk that becomes split was drawn before, itself or as part of a coarser one; otherwise it was
        // out of view.
        if (const auto begun = missingFrom(tableOf(splits_), splits); !begun.empty()) {
            const ChunkTable drawnBefore = tableOf(drawn_);
            for (const ChunkId& id : begun) {
                if (coversOne(drawnBefore, id)) note(id, LodChangeType::Split);
            }
        }
        if (const auto ended = missingFrom(tableOf(splits), splits_); !ended.empty()) {
            const ChunkTable drawnNow = tableOf(drawn);
            for (const ChunkId& id : ended) {
                if (coversOne(drawnNow, id)) note(id, LodChangeType::Merge);
            }
        }
    }
    splits_ = std::move(splits);
    drawn_ = std::move(drawn);
}

void LodChanges::clear() {
    *this = {};
}

void LodChanges::note(const ChunkId& chunk, LodChangeType type) {
    LodChange change{nowS_, chunk, type, false};
    const auto [last, isFirst] = last_.try_emplace(chunk, change);
    if (!isFirst) {
        change.thrash = last->second.type != type && nowS_ - last->second.timeS < thrashWithinS;
        last->second = change;
    }
    thrashTotal_ += change.thrash;
    recent_.push_back(change);
}

void LodChanges::forgetOld() {
    while (!recent_.empty() && nowS_ - recent_.front().timeS > keptS) {
        const LodChange& oldest = recent_.front();
        const auto last = last_.find(oldest.chunk);
        if (last != last_.end() && last->second.timeS == oldest.timeS) last_.erase(last);
        recent_.pop_front();
    }
}

double LodChanges::perS(LodChangeType type) const {
    std::size_t count = 0;
    for (auto change = recent_.rbegin(); change != recent_.rend() && nowS_ - change->timeS < 1; ++change) {
        count += change->type == type;
    }
    return static_cast<double>(count);
}

double LodChanges::splitsPerS() const {
    return perS(LodChangeType::Split);
}

double LodChanges::mergesPerS() const {
    return perS(LodChangeType::Merge);
}

std::size_t LodChanges::thrashRecent() const {
    return static_cast<std::size_t>(
        std::count_if(recent_.begin(), recent_.end(), [](const LodChange& change) { return change.thrash; }));
}

}  // namespace planet
