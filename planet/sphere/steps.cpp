#include "planet/sphere/steps.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>

namespace planet {

namespace {

using Short = std::numeric_limits<std::int16_t>;

template <class Number>
std::pair<std::int32_t, std::int32_t> extremesOf(const Number* steps, std::size_t count) {
    Number lowest = steps[0];
    Number highest = steps[0];
    for (std::size_t i = 1; i < count; ++i) {
        lowest = std::min(lowest, steps[i]);
        highest = std::max(highest, steps[i]);
    }
    return {lowest, highest};
}

// Returns whether the distances of all steps from the lowest one are multiples of a power of two.
bool areMultiples(std::span<const std::int32_t> steps, std::int32_t lowest, std::int32_t scale) {
    std::uint32_t bits = 0;
    for (const std::int32_t step : steps)
        bits |= static_cast<std::uint32_t>(step) - static_cast<std::uint32_t>(lowest);
    return (bits & (static_cast<std::uint32_t>(scale) - 1)) == 0;
}

}  // namespace

StepsView StepsView::subspan(std::size_t offset, std::size_t count) const {
    assert(offset <= size_ && count <= size_ - offset);
    if (wide_ != nullptr) return std::span(wide_ + offset, count);
    return {std::span(narrow_ + offset, count), base_, scale_};
}

std::span<const std::int16_t> StepsView::plain() const {
    if (wide_ != nullptr || base_ != 0 || scale_ != 1) return {};
    return {narrow_, size_};
}

void StepsView::copyTo(std::span<std::int32_t> out) const {
    assert(out.size() == size_);
    if (wide_ != nullptr) {
        std::copy_n(wide_, size_, out.begin());
        return;
    }
    for (std::size_t i = 0; i < size_; ++i) out[i] = base_ + scale_ * narrow_[i];
}

std::vector<std::int32_t> StepsView::toVector() const {
    std::vector<std::int32_t> steps(size_);
    copyTo(steps);
    return steps;
}

bool operator==(const StepsView& a, const StepsView& b) {
    return std::ranges::equal(a, b);
}

Steps::Steps(const void* from, std::size_t count, std::int32_t base, std::int32_t scale)
    : size_(static_cast<std::uint32_t>(count)), base_(base), scale_(scale) {
    if (count == 0) return;
    memory_ = std::make_unique_for_overwrite<std::byte[]>(bytes());
    std::memcpy(memory_.get(), from, bytes());
}

Steps::Steps(std::span<const std::int16_t> narrow, std::int32_t base, std::int32_t scale)
    : Steps(narrow.data(), narrow.size(), base, scale) {
    assert(scale > 0);
}

Steps::Steps(std::span<const std::int16_t> narrow, std::size_t rowApart, std::size_t side, std::int32_t base,
             std::int32_t scale)
    : size_(static_cast<std::uint32_t>(side * side)), base_(base), scale_(scale) {
    assert(scale > 0 && side > 0 && rowApart >= side && narrow.size() >= (side - 1) * rowApart + side);
    memory_ = std::make_unique_for_overwrite<std::byte[]>(bytes());
    const std::size_t rowBytes = side * sizeof(std::int16_t);
    for (std::size_t row = 0; row < side; ++row)
        std::memcpy(memory_.get() + row * rowBytes, narrow.data() + row * rowApart, rowBytes);
}

Steps::Steps(std::span<const std::int32_t> steps) {
    if (steps.empty()) return;
    const auto [lowest, highest] = extremesOf(steps.data(), steps.size());
    if (lowest >= Short::min() && highest <= Short::max()) {
        const std::vector<std::int16_t> narrow(steps.begin(), steps.end());
        *this = Steps(narrow, 0, 1);
        return;
    }
    constexpr std::int64_t mostRange = 1 << 25;  // far more than that of a planet
    const std::int64_t range = std::int64_t{highest} - lowest;
    // The smallest power of two of which 16 bits hold enough multiples.
    const auto scale = static_cast<std::int32_t>(
        std::bit_ceil(static_cast<std::uint32_t>(std::min(range, mostRange) >> 16) + 1));
    if (range > mostRange || !areMultiples(steps, lowest, scale)) {
        *this = Steps(steps.data(), steps.size(), 0, 0);
        return;
    }
    const std::int32_t base = lowest - scale * Short::min();
    std::vector<std::int16_t> narrow(steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i)
        narrow[i] = static_cast<std::int16_t>((steps[i] - base) / scale);
    *this = Steps(narrow, base, scale);
}

Steps::Steps(const Steps& other) : Steps(other.memory_.get(), other.size_, other.base_, other.scale_) {}

std::size_t Steps::bytes() const {
    return std::size_t{size_} * (scale_ == 0 ? sizeof(std::int32_t) : sizeof(std::int16_t));
}

StepsView Steps::view() const {
    if (scale_ == 0) return std::span(reinterpret_cast<const std::int32_t*>(memory_.get()), size_);
    return {std::span(reinterpret_cast<const std::int16_t*>(memory_.get()), size_), base_, scale_};
}

std::pair<std::int32_t, std::int32_t> lowestAndHighest(const StepsView& steps) {
    assert(!steps.empty());
    if (const auto narrow = steps.narrow(); !narrow.empty()) {
        const auto [lowest, highest] = extremesOf(narrow.data(), narrow.size());
        return {steps.base() + steps.scale() * lowest, steps.base() + steps.scale() * highest};
    }
    std::int32_t lowest = steps[0];
    std::int32_t highest = steps[0];
    for (std::size_t i = 1; i < steps.size(); ++i) {
        lowest = std::min(lowest, steps[i]);
        highest = std::max(highest, steps[i]);
    }
    return {lowest, highest};
}

}  // namespace planet
