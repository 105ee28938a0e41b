#include "app/bench/bench_parts.h"

#include <algorithm>

#include "app/base/stopwatch.h"
#include "planet/base/percentile.h"

namespace worldy {

Spread spreadOf(std::vector<double> values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double minimum = *least;
    const double maximum = *most;
    return {planet::percentileOf(values, 0.5), minimum, maximum};
}

std::vector<double> ratios(const std::vector<double>& of, const std::vector<double>& to) {
    std::vector<double> result;
    for (std::size_t i = 0; i < of.size(); ++i) result.push_back(of[i] / to[i]);
    return result;
}

std::vector<std::vector<double>> timeInTurn(std::span<const std::function<void()>> jobs, int rounds) {
    std::vector<std::vector<double>> ms(jobs.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t job = 0; job < jobs.size(); ++job) {
            const Stopwatch watch;
            jobs[job]();
            ms[job].push_back(watch.elapsedMs());
        }
    }
    return ms;
}

}  // namespace worldy
