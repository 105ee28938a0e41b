#include "planet/pager.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <exception>

namespace planet {

namespace {

// Reading may allocate a lot and may run code that the caller supplied; neither may end the program.
Result<SiblingBlock> loadSafely(const LoadChildren& load, const PagingRequest& request) {
    try {
        return load(request.parent, request.location, *request.parentHeights);
    } catch (const std::exception& problem) {
        return ioError(fmt::format("children of chunk {}: {}", toString(request.parent), problem.what()));
    }
}

Result<SiblingBlock> failedOnPurpose(const ChunkId& parent, std::uint32_t seed) {
    return ioError(fmt::format("{}: read failed on purpose (bad disk, seed {})", toString(parent), seed));
}

}  // namespace

Pager::Pager(LoadChildren load, int threads) : load_(std::move(load)) {
    assert(load_);
    setThreads(threads);
}

Pager::~Pager() {
    // All are told before the first is joined, so that they end side by side.
    for (std::jthread& thread : threads_) thread.request_stop();
}

void Pager::setThreads(int threads) {
    assert(threads >= 1 && threads <= maxLoaderThreads);
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    loadersWanted_ = static_cast<std::size_t>(threads);
    for (std::size_t i = 0; i < loadersWanted_; ++i) {
        if (loaders_[i].running) continue;  // one that was about to go stays
        loaders_[i].running = true;
        // The thread that was here before has nothing left to do, so joining it takes no time.
        threads_[i] = std::jthread([this, i](const std::stop_token& stop) { runLoader(i, stop); });
    }
}

void Pager::setPaused(bool paused) {
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    if (paused_ == paused) return;
    paused_ = paused;
    letThrough_ = 0;
}

void Pager::loadOne() {
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    if (paused_ && letThrough_ < queue_.count(PagingType::PageIn)) ++letThrough_;
}

void Pager::setBadDisk(const BadDiskSettings& settings) {
    const Wake wake{badDiskChanged_};
    const std::lock_guard lock(mutex_);
    if (badDisk_ == settings) return;
    badDisk_ = settings;
    ++badDiskVersion_;
    attempts_.clear();
}

void Pager::forgetAttempts() {
    const std::lock_guard lock(mutex_);
    attempts_.clear();
}

void Pager::runLoader(std::size_t index, const std::stop_token& stop) {
    Lock lock(mutex_);
    while (true) {
        workArrived_.wait(lock, stop, [&] { return index >= loadersWanted_ || mayTake(); });
        if (stop.stop_requested() || index >= loadersWanted_) break;
        serve(index, stop, lock);
    }
    loaders_[index].running = false;
}

bool Pager::mayTake() const {
    return queue_.count(PagingType::PageIn) > 0 && (!paused_ || letThrough_ > 0);
}

PagingRequest Pager::take() {
    if (paused_) --letThrough_;
    if (!badDisk_.shuffledOrder) return *queue_.popBest(PagingType::PageIn);
    return *queue_.popFirst(PagingType::PageIn,
                            [&](const ChunkId& parent) { return shuffledPlace(badDisk_, parent); });
}

// Takes a request and sees it through. Locked before and after.
void Pager::serve(std::size_t index, const std::stop_token& stop, Lock& lock) {
    PagingRequest request = take();
    const Reading reading{request.parent, request.priority, request.location.size, Clock::now()};
    loaders_[index].reading = reading;
    const bool fails = sitOutBadDisk(reading, stop, lock);
    Result<SiblingBlock> children;
    if (fails) {
        children = failedOnPurpose(request.parent, badDisk_.seed);
    } else {
        lock.unlock();
        children = loadSafely(load_, request);
        lock.lock();
    }
    loaders_[index].reading.reset();
    const std::chrono::duration<double> taken = Clock::now() - reading.since;
    finished_.push_back({std::move(request), std::move(children), taken.count(), fails ? 0 : reading.bytes});
    loadFinished_.notify_all();
}

// Waits as long as the bad disk says, and by its new word when that changes. True if the read fails.
bool Pager::sitOutBadDisk(const Reading& reading, const std::stop_token& stop, Lock& lock) {
    while (isTrouble(badDisk_) && !stop.stop_requested()) {
        const std::uint32_t attempt = attempts_[reading.parent]++;
        const DiskFault fault = diskFault(badDisk_, reading.parent, attempt, reading.bytes);
        const auto until = reading.since + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double>(fault.waitS));
        const std::uint64_t version = badDiskVersion_;
        if (!badDiskChanged_.wait_until(lock, stop, until, [&] { return badDiskVersion_ != version; })) {
            return fault.fails;
        }
    }
    return false;
}

std::optional<FinishedLoad> Pager::takeFinished() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) return std::nullopt;
    FinishedLoad load = std::move(finished_.front());
    finished_.pop_front();
    return load;
}

bool Pager::waitForFinished(Clock::time_point until) {
    Lock lock(mutex_);
    loadFinished_.wait_until(lock, until, [&] { return !finished_.empty() || statusLocked().atRest(); });
    return !finished_.empty();
}

PagerStatus Pager::status() const {
    const std::lock_guard lock(mutex_);
    return statusLocked();
}

PagerStatus Pager::statusLocked() const {
    const auto loading = std::count_if(loaders_.begin(), loaders_.end(),
                                       [](const Loader& loader) { return loader.reading.has_value(); });
    return {static_cast<std::uint32_t>(queue_.count(PagingType::PageIn)), static_cast<std::uint32_t>(loading),
            static_cast<std::uint32_t>(finished_.size()), paused_ && letThrough_ == 0};
}

std::vector<LoadInProgress> Pager::loadingNow() const {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    std::vector<LoadInProgress> all;
    for (const Loader& loader : loaders_) {
        if (!loader.reading) continue;
        const std::chrono::duration<double> taken = now - loader.reading->since;
        all.push_back(
            {loader.reading->parent, loader.reading->priority, loader.reading->bytes, taken.count()});
    }
    std::sort(all.begin(), all.end(), [](const LoadInProgress& a, const LoadInProgress& b) {
        return a.seconds != b.seconds ? a.seconds > b.seconds : a.parent < b.parent;
    });
    return all;
}

}  // namespace planet
