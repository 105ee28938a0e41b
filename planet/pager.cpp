#include "planet/pager.h"

#include <fmt/format.h>

#include <cassert>
#include <exception>

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

// Reading may allocate a lot and may run code that the caller supplied; neither may end the program.
Result<SiblingBlock> loadSafely(const LoadChildren& load, const PagingRequest& request) {
    try {
        return load(request.parent, request.location, *request.parentHeights);
    } catch (const std::exception& problem) {
        return ioError(fmt::format("children of chunk {}: {}", toString(request.parent), problem.what()));
    }
}

}  // namespace

Pager::Pager(LoadChildren load, int threads) : load_(std::move(load)) {
    assert(load_ && threads >= 1);
    for (int i = 0; i < threads; ++i) {
        loaders_.emplace_back([this](const std::stop_token& stop) { runLoader(stop); });
    }
}

Pager::~Pager() {
    // All are told before the first is joined, so that they end side by side.
    for (std::jthread& loader : loaders_) loader.request_stop();
}

void Pager::runLoader(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (true) {
        workArrived_.wait(lock, stop, [&] { return queue_.count(PagingType::PageIn) > 0; });
        if (stop.stop_requested()) return;
        PagingRequest request = *queue_.popBest(PagingType::PageIn);
        ++loading_;
        lock.unlock();
        const Clock::time_point start = Clock::now();
        Result<SiblingBlock> children = loadSafely(load_, request);
        const std::chrono::duration<double> taken = Clock::now() - start;
        lock.lock();
        --loading_;
        finished_.push_back({std::move(request), std::move(children), taken.count()});
        loadFinished_.notify_all();
    }
}

std::optional<FinishedLoad> Pager::takeFinished() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) return std::nullopt;
    FinishedLoad load = std::move(finished_.front());
    finished_.pop_front();
    return load;
}

bool Pager::waitForFinished(Clock::time_point until) {
    std::unique_lock lock(mutex_);
    loadFinished_.wait_until(lock, until, [&] { return !finished_.empty() || statusLocked().idle(); });
    return !finished_.empty();
}

PagerStatus Pager::status() const {
    const std::lock_guard lock(mutex_);
    return statusLocked();
}

PagerStatus Pager::statusLocked() const {
    return {static_cast<std::uint32_t>(queue_.count(PagingType::PageIn)), loading_,
            static_cast<std::uint32_t>(finished_.size())};
}

}  // namespace planet
