#include "app/measure/comparison_job.h"

#include <utility>

namespace worldy {

ComparisonJob::ComparisonJob(ComparisonPlan plan) : thread_([this, plan = std::move(plan)] { run(plan); }) {}

ComparisonJob::~ComparisonJob() {
    cancelled_ = true;
    thread_.join();
}

void ComparisonJob::run(const ComparisonPlan& plan) {
    planet::Result<ComparedPair> result = compareOverFlight(plan, [this](double share) {
        progress_ = share;
        return !cancelled_.load();
    });
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
}

std::optional<planet::Result<ComparedPair>> ComparisonJob::takeResult() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

}  // namespace worldy
