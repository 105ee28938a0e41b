// The stored heights of a grid, in steps of a planet's quantum (planet_shape.h).
//
// Most grids fit into 16 bits: their steps are multiples of a power of two, in a range of 65,536 of those
// multiples. Such a grid takes 2 bytes a sample; any other takes 4. Consumers read a StepsView, which gives a step
// by its index in either case.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace planet {

// A range of T in memory, const or not. It asks for members only: the concepts of std::ranges would ask whether views of
// steps are made of steps.
template <class Range, class T>
concept RangeInMemory = requires(const Range& range) {
    requires std::same_as<std::remove_cvref_t<decltype(*range.data())>, T>;
    { range.size() } -> std::convertible_to<std::size_t>;
};

// A non-owning view of steps. A view of 16-bit numbers n has the steps base + scale * n.
class StepsView {
public:
    class Iterator;

    StepsView() = default;
    template <RangeInMemory<std::int16_t> Range>
    StepsView(const Range& steps)  // implicit, as of std::span
        : StepsView(std::span<const std::int16_t>(steps), 0, 1) {}
    template <RangeInMemory<std::int32_t> Range>
    StepsView(const Range& steps) : wide_(steps.data()), size_(steps.size()) {}
    StepsView(std::span<const std::int16_t> narrow, std::int32_t base, std::int32_t scale)
        : narrow_(narrow.data()), size_(narrow.size()), base_(base), scale_(scale) {}

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    std::int32_t operator[](std::size_t i) const {
        return wide_ != nullptr ? wide_[i] : base_ + scale_ * narrow_[i];
    }
    Iterator begin() const;
    Iterator end() const;

    // offset + count: at most size().
    StepsView subspan(std::size_t offset, std::size_t count) const;
    // Returns the steps as they lie in memory if they are 16-bit numbers themselves; otherwise nothing.
    std::span<const std::int16_t> plain() const;
    bool isWide() const { return wide_ != nullptr; }  // 4 bytes a step
    // Return the 16-bit numbers, unless the view is wide, and what makes steps of them.
    std::span<const std::int16_t> narrow() const { return {narrow_, isWide() ? 0 : size_}; }
    std::int32_t base() const { return base_; }
    std::int32_t scale() const { return scale_; }
    // out: size() steps.
    void copyTo(std::span<std::int32_t> out) const;
    std::vector<std::int32_t> toVector() const;

    friend bool operator==(const StepsView& a, const StepsView& b);

private:
    const std::int16_t* narrow_ = nullptr;
    const std::int32_t* wide_ = nullptr;
    std::size_t size_ = 0;
    std::int32_t base_ = 0;
    std::int32_t scale_ = 1;
};

class StepsView::Iterator {
public:
    using iterator_concept = std::random_access_iterator_tag;
    using iterator_category = std::input_iterator_tag;  // a step is computed, so there is no reference to it
    using value_type = std::int32_t;
    using difference_type = std::ptrdiff_t;

    Iterator() = default;
    Iterator(const StepsView& steps, difference_type at) : steps_(steps), at_(at) {}

    std::int32_t operator*() const { return steps_[static_cast<std::size_t>(at_)]; }
    std::int32_t operator[](difference_type n) const { return *(*this + n); }
    Iterator& operator+=(difference_type n) {
        at_ += n;
        return *this;
    }
    Iterator& operator-=(difference_type n) { return *this += -n; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator operator++(int) { return {steps_, at_++}; }
    Iterator operator--(int) { return {steps_, at_--}; }
    friend Iterator operator+(Iterator a, difference_type n) { return a += n; }
    friend Iterator operator+(difference_type n, Iterator a) { return a += n; }
    friend Iterator operator-(Iterator a, difference_type n) { return a -= n; }
    friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.at_ - b.at_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }
    friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.at_ <=> b.at_; }

private:
    StepsView steps_;
    difference_type at_ = 0;
};

inline StepsView::Iterator StepsView::begin() const {
    return {*this, 0};
}
inline StepsView::Iterator StepsView::end() const {
    return {*this, static_cast<std::ptrdiff_t>(size_)};
}

// Owns the steps of a grid. Cannot be changed.
class Steps {
public:
    Steps() = default;
    // Copies steps of 16 bits as they are.
    template <RangeInMemory<std::int16_t> Range>
    Steps(const Range& steps)  // implicit, so that grids of 16-bit steps need no conversion
        : Steps(std::span<const std::int16_t>(steps), 0, 1) {}
    // Copies the steps base + scale * n of 16-bit numbers n. scale: > 0.
    Steps(std::span<const std::int16_t> narrow, std::int32_t base, std::int32_t scale);
    // Copies such steps of a square of a larger grid. narrow: from the square's first step to at least its last one.
    // rowApart: from one row to the next, >= side.
    Steps(std::span<const std::int16_t> narrow, std::size_t rowApart, std::size_t side, std::int32_t base,
          std::int32_t scale);
    // Copies steps, in 2 bytes each if they fit.
    explicit Steps(std::span<const std::int32_t> steps);

    Steps(const Steps& other);
    Steps(Steps&&) noexcept = default;
    Steps& operator=(const Steps& other) { return *this = Steps(other); }
    Steps& operator=(Steps&&) noexcept = default;
    ~Steps() = default;

    operator StepsView() const { return view(); }
    StepsView view() const;
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    std::size_t bytes() const;  // of the memory for the steps
    std::int32_t operator[](std::size_t i) const { return view()[i]; }
    StepsView::Iterator begin() const { return view().begin(); }
    StepsView::Iterator end() const { return view().end(); }

    friend bool operator==(const Steps& a, const Steps& b) { return a.view() == b.view(); }

private:
    Steps(const void* from, std::size_t count, std::int32_t base, std::int32_t scale);

    std::unique_ptr<std::byte[]> memory_;
    std::uint32_t size_ = 0;
    std::int32_t base_ = 0;
    std::int32_t scale_ = 1;  // 0: the memory holds 32-bit steps
};

// Returns the lowest and the highest of some steps, of which there must be one.
std::pair<std::int32_t, std::int32_t> lowestAndHighest(const StepsView& steps);

}  // namespace planet
