// The arithmetic of plots and tables: axes, buckets, rates. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace worldy {

// The top of an axis: the smallest of 1, 2 and 5 times a power of ten that is no less than a value; 1 where
// that is not over 0 or no number.
double roundedTop(double largest);

// A number for an axis or a legend: three significant digits at most, "0.25", "12.5", "1230", "12.3 k".
std::string axisText(double value);

// One sample for each column of a plot: the index of the largest value in each span of columnS seconds, in
// order; columns without samples are left out. Columns start at multiples of columnS, so that a plot that
// moves on keeps its shape. Times ascend; both spans have the same length; columnS > 0.
std::vector<std::size_t> peakOfColumns(std::span<const float> timesS, std::span<const float> values,
                                       float columnS);

// Sums at each index over several rows of the same length.
std::vector<float> summed(std::span<const std::span<const float>> rows);

// Where a value stands on an axis from lowest to highest, [0, 1]; beyond the ends it stands at them. On a
// logarithmic one both ends are over 0.
double linearPosition(double value, double lowest, double highest);
double logarithmicPosition(double value, double lowest, double highest);
// The value at a position.
double logarithmicValue(double position, double lowest, double highest);

// A logarithmic axis between round numbers.
struct LogAxis {
    double lowest = 1;
    double highest = 10;
    std::vector<double> ticks{1, 10};  // ascending, the ends among them

    double position(double value) const { return logarithmicPosition(value, lowest, highest); }
};
// From the last round number not over the least of some values, all over 0, to the first one not under the
// most; [1, 10] for none.
LogAxis logAxisOver(std::span<const double> values);

// How many of the positions in [0, 1] fall into each of so many equal buckets; the last one holds 1 too.
std::vector<float> bucketCounts(std::span<const float> positions, std::size_t buckets);

// How fast a total grew at each sample, per second, over the windowS seconds before it (or as much of it as
// there is); 0 at the first one. A total that falls, since it was set back, counts as no growth. Times
// ascend.
std::vector<float> growthPerS(std::span<const float> timesS, std::span<const double> totals, double windowS);

}  // namespace worldy
