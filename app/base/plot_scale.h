// The arithmetic of plots and tables: axes, buckets, rates. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace worldy {

// Returns the top of an axis: the smallest of 1, 2 and 5 times a power of ten that is at least `largest`; 1
// if `largest` is not a positive finite number.
double roundedTop(double largest);

// Returns a number for an axis or a legend with about three digits: "0.25", "12.5", "1230", "12.3 k".
std::string axisText(double value);

// Returns the index of the largest value in each column of columnS seconds, in order, without empty columns.
// Columns start at multiples of columnS, so a scrolling plot keeps its shape. Times ascend; both spans have
// the same length; columnS > 0.
std::vector<std::size_t> peakOfColumns(std::span<const float> timesS, std::span<const float> values,
                                       float columnS);

// Returns the sum at each index over several rows of the same length.
std::vector<float> summed(std::span<const std::span<const float>> rows);

// Return the position of a value on an axis from lowest to highest, clamped to [0, 1]. Both ends of a
// logarithmic axis are > 0.
double linearPosition(double value, double lowest, double highest);
double logarithmicPosition(double value, double lowest, double highest);
// Returns the value at a position.
double logarithmicValue(double position, double lowest, double highest);

// A logarithmic axis between round numbers.
struct LogAxis {
    double lowest = 1;
    double highest = 10;
    std::vector<double> ticks{1, 10};  // ascending, including both ends

    double position(double value) const { return logarithmicPosition(value, lowest, highest); }
};
// Returns an axis over some values, all > 0, from the last round number <= the smallest to the first round
// number >= the largest; [1, 10] for no values.
LogAxis logAxisOver(std::span<const double> values);

// Returns how many of the positions in [0, 1] fall into each of several equal buckets. The last bucket
// includes 1.
std::vector<float> bucketCounts(std::span<const float> positions, std::size_t buckets);

// Returns the growth of a total per second at each sample, over the windowS seconds before it or as many as
// there are; 0 at the first sample. A decrease, which means that the counter was reset, counts as 0. Times
// ascend.
std::vector<float> growthPerS(std::span<const float> timesS, std::span<const double> totals, double windowS);

}  // namespace worldy
