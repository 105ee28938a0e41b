#include "planet/bake/delta_ranks.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "planet/base/percentile.h"

namespace planet {

namespace {

// The bits of values that are at least 0 have the order of the values.
std::uint32_t bitsOf(float value) {
    return std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 becomes 0
}
std::size_t upperOf(std::uint32_t bits) {
    return bits >> 16;
}
std::size_t lowerOf(std::uint32_t bits) {
    return bits & 0xffffu;
}

// Returns the first place at which at least `rank` values have been counted, and takes the values before it off the rank.
template <class Counts>
std::size_t placeOf(const Counts& counts, std::uint64_t& rank) {
    std::size_t place = 0;
    for (; place + 1 < counts.size() && counts[place] < rank; ++place) rank -= counts[place];
    return place;
}

}  // namespace

void DeltaRanks::add(float value) {
    if (!isMany_.load(std::memory_order_acquire)) {
        const std::lock_guard lock(mutex_);
        if (!isMany_.load(std::memory_order_relaxed)) {
            few_.push_back(value);
            if (few_.size() <= rangeCount) return;
            ranges_ = Counts(rangeCount);
            for (const float earlier : few_) ++ranges_[upperOf(bitsOf(earlier))];
            few_ = {};
            isMany_.store(true, std::memory_order_release);
            return;
        }
    }
    ranges_[upperOf(bitsOf(value))].fetch_add(1, std::memory_order_relaxed);
}

bool DeltaRanks::needsSecondPass() {
    if (!isMany_) return false;
    std::uint64_t count = 0;
    for (const auto& range : ranges_) count += range;
    for (std::size_t i = 0; i < shareCount; ++i) {
        const double rank = std::ceil(std::clamp(shares_[i], 0.0, 1.0) * static_cast<double>(count));
        targets_[i].rank = std::max<std::uint64_t>(static_cast<std::uint64_t>(rank), 1);
        targets_[i].range = placeOf(ranges_, targets_[i].rank);
        values_[i] = Counts(rangeCount);
    }
    return true;
}

void DeltaRanks::addAgain(float value) {
    const std::uint32_t bits = bitsOf(value);
    for (std::size_t i = 0; i < shareCount; ++i) {
        if (!values_[i].empty() && upperOf(bits) == targets_[i].range)
            values_[i][lowerOf(bits)].fetch_add(1, std::memory_order_relaxed);
    }
}

float DeltaRanks::percentile(std::size_t share) const {
    if (!isMany_) return percentileOf(std::vector(few_), shares_[share]);
    const Target& target = targets_[share];
    std::uint64_t rank = target.rank;
    const std::size_t lower = placeOf(values_[share], rank);
    return std::bit_cast<float>(static_cast<std::uint32_t>(target.range << 16 | lower));
}

}  // namespace planet
