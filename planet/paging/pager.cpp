#include "planet/paging/pager.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <limits>
#include <utility>

#include "planet/spans/span_recorder.h"

namespace planet {

namespace {

// Loads a block and turns exceptions into Errors: reading may run out of memory, and the caller's code may
// throw.
Result<LoadedBlock> loadSafely(const BlockLoaders& load, const PagingRequest& request) {
    const SpanScope span(request.kind == BlockKind::Normals ? "derive" : "load", request.block());
    const auto asLoaded = [](auto&& block) { return LoadedBlock(std::forward<decltype(block)>(block)); };
    try {
        if (request.kind == BlockKind::Colours)
            return load.colours(request.parent, request.location).map(asLoaded);
        if (request.kind == BlockKind::Normals) return load.normals(request.parent).map(asLoaded);
        return load.chunks(request.parent, request.location, *request.parentHeights).map(asLoaded);
    } catch (const std::exception& problem) {
        return ioError(fmt::format("children of chunk {}: {}", toString(request.block()), problem.what()));
    }
}

Result<LoadedBlock> failedOnPurpose(const BlockId& block, std::uint32_t seed,
                                    ErrorKind kind = ErrorKind::Io) {
    if (kind == ErrorKind::BadInput) return badInput(fmt::format("{}: recorded as corrupt", toString(block)));
    return ioError(fmt::format("{}: injected read failure (seed {})", toString(block), seed));
}

std::optional<ErrorKind> failureOf(const DiskFault& fault) {
    return fault.fails ? std::optional(ErrorKind::Io) : std::nullopt;
}

}  // namespace

Pager::Pager(BlockLoaders load, int threads) : load_(std::move(load)) {
    assert(load_.chunks);
    setThreads(threads);
}

Pager::~Pager() {
    // Stops all threads before joining the first one, so that they stop in parallel.
    for (std::jthread& thread : threads_) thread.request_stop();
}

void Pager::setThreads(int threads) {
    assert(threads >= 1 && threads <= maxLoaderThreads);
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    loadersWanted_ = static_cast<std::size_t>(threads);
    const VirtualLoaders loaders{*this};
    for (std::size_t i = 0; i < loadersWanted_; ++i) {
        if (loaders_[i].running) continue;  // a loader that has not stopped yet stays
        loaders_[i].running = true;
        // The previous thread at this index has ended, so joining it does not block.
        threads_[i] = std::jthread([this, i](const std::stop_token& stop) { runLoader(i, stop); });
    }
}

void Pager::setPaused(bool paused) {
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    if (paused_ == paused) return;
    paused_ = paused;
    letThrough_ = 0;
    startVirtualReads();
}

void Pager::loadOne() {
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    if (paused_ && letThrough_ < queue_.count(PagingType::PageIn)) ++letThrough_;
    startVirtualReads();
}

void Pager::setPrefetchShare(double share) {
    assert(share > 0 && share <= 1);
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    prefetchShare_ = share;
}

void Pager::setBadDisk(const BadDiskSettings& settings) {
    const Wake wake{badDiskChanged_};
    const std::lock_guard lock(mutex_);
    if (badDisk_ == settings) return;
    badDisk_ = settings;
    ++badDiskVersion_;
    attempts_.clear();
    if (time_ != PagingTime::Simulated) return;
    for (VirtualReading& reading : virtualReadings_) {
        const DiskFault fault = nextFault(reading.request);
        reading.failure = failureOf(fault);
        reading.endS = std::max(reading.sinceS + fault.waitS, nowS_);
    }
}

void Pager::forgetAttempts() {
    const std::lock_guard lock(mutex_);
    attempts_.clear();
}

void Pager::runLoader(std::size_t index, const std::stop_token& stop) {
    nameSpanThread("loader", static_cast<int>(index) + 1);
    Lock lock(mutex_);
    const auto isReady = [&] { return index >= loadersWanted_ || (time_ == PagingTime::Clock && mayTake()); };
    while (true) {
        bool isWoken = true;
        if (const std::optional<double> atS = nextPrefetchAtS(); atS && time_ == PagingTime::Clock) {
            const auto wait =
                std::chrono::ceil<Clock::duration>(std::chrono::duration<double>(*atS - timeS()));
            isWoken = workArrived_.wait_for(lock, stop, wait, isReady);
        } else {
            workArrived_.wait(lock, stop, isReady);
        }
        if (stop.stop_requested() || index >= loadersWanted_) break;
        if (isWoken) serve(index, stop, lock);
    }
    loaders_[index].running = false;
}

double Pager::timeS() const {
    if (time_ != PagingTime::Clock) return nowS_;
    return std::chrono::duration<double>(Clock::now() - startedAt_).count();
}

// Returns the loaders that prefetches may occupy on average.
double Pager::prefetchLoaders() const {
    return prefetchShare_ * static_cast<double>(loadersWanted_);
}

bool Pager::hasLoaderForPrefetch() const {
    return prefetching_ < static_cast<std::size_t>(std::max(prefetchLoaders(), 1.0));
}

// Returns the time at which the best request, a prefetch, may begin; nothing if it is no prefetch or waits for
// something else.
std::optional<double> Pager::nextPrefetchAtS() const {
    const PagingRequest* best = queue_.best(PagingType::PageIn);
    if (!best || !best->isPrefetch() || !hasLoaderForPrefetch() || (paused_ && letThrough_ == 0))
        return std::nullopt;
    return std::max(nextPrefetchS_, timeS());
}

// sinceS: when its read began.
void Pager::endPrefetch(const PagingRequest& request, double sinceS) {
    if (!request.isPrefetch()) return;
    --prefetching_;
    nextPrefetchS_ = std::max(nextPrefetchS_, sinceS) + (timeS() - sinceS) / prefetchLoaders();
}

bool Pager::mayTake() const {
    const PagingRequest* best = queue_.best(PagingType::PageIn);
    if (!best || (paused_ && letThrough_ == 0)) return false;
    return !best->isPrefetch() || (hasLoaderForPrefetch() && timeS() >= nextPrefetchS_);
}

PagingRequest Pager::takeNext() {
    if (paused_) --letThrough_;
    PagingRequest request =
        badDisk_.shuffledOrder
            ? *queue_.popFirst(PagingType::PageIn,
                               [&](const BlockId& block) { return shuffledPlace(badDisk_, block); })
            : *queue_.popBest(PagingType::PageIn);
    taken_.push_back(request.block());
    prefetching_ += request.isPrefetch();
    return request;
}

DiskFault Pager::nextFault(const PagingRequest& request) {
    if (!isTrouble(badDisk_)) return {};
    return diskFault(badDisk_, request.block(), attempts_[request.block()]++, request.location.size);
}

// Takes and serves one request. The lock is held on entry and return.
void Pager::serve(std::size_t index, const std::stop_token& stop, Lock& lock) {
    const std::uint64_t epoch = epoch_;
    PagingRequest request = takeNext();
    const Reading reading{request, Clock::now()};
    loaders_[index].reading = reading;
    const bool fails = isTrouble(badDisk_) && waitForInjectedDelay(reading, stop, lock);
    Result<LoadedBlock> block;
    if (fails) {
        block = failedOnPurpose(request.block(), badDisk_.seed);
    } else if (epoch == epoch_) {
        lock.unlock();
        block = loadSafely(load_, request);
        lock.lock();
    }
    if (epoch != epoch_) return;  // abandoned
    loaders_[index].reading.reset();
    const std::chrono::duration<double> taken = Clock::now() - reading.since;
    endPrefetch(request, std::chrono::duration<double>(reading.since - startedAt_).count());
    const std::uint32_t bytes = fails ? 0 : request.location.size;
    finished_.push_back({std::move(request), std::move(block), taken.count(), bytes});
    if (hasEnoughFinished()) loadFinished_.notify_all();
}

// Waits as long as the injected fault says, even if the settings change meanwhile. Returns true if the read
// fails.
bool Pager::waitForInjectedDelay(const Reading& reading, const std::stop_token& stop, Lock& lock) {
    const SpanScope span("injected delay", reading.request.block());
    const std::uint64_t epoch = epoch_;
    while (isTrouble(badDisk_) && !stop.stop_requested() && epoch == epoch_) {
        const DiskFault fault = nextFault(reading.request);
        const auto until = reading.since + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double>(fault.waitS));
        const std::uint64_t version = badDiskVersion_;
        if (!badDiskChanged_.wait_until(lock, stop, until,
                                        [&] { return badDiskVersion_ != version || epoch_ != epoch; })) {
            return fault.fails;
        }
    }
    return false;
}

std::vector<PagingRequest> Pager::setTime(PagingTime time) {
    const Wake wakeWaiting{badDiskChanged_};
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    if (time == time_) return {};
    time_ = time;
    std::vector<PagingRequest> givenUp = giveUpReads();
    startVirtualReads();
    return givenUp;
}

std::vector<PagingRequest> Pager::abandonReads() {
    const Wake wakeWaiting{badDiskChanged_};
    const Wake wake{workArrived_};
    const std::lock_guard lock(mutex_);
    std::vector<PagingRequest> givenUp = giveUpReads();
    startVirtualReads();
    return givenUp;
}

std::vector<PagingRequest> Pager::giveUpReads() {
    std::vector<PagingRequest> givenUp;
    for (; ownedLoads() > 0; ++nextHandedOver_)
        givenUp.push_back(std::move(handedOver_[nextHandedOver_].request));
    for (FinishedLoad& load : finished_) givenUp.push_back(std::move(load.request));
    for (VirtualReading& reading : virtuallyFinished_) givenUp.push_back(std::move(reading.request));
    for (VirtualReading& reading : virtualReadings_) givenUp.push_back(std::move(reading.request));
    for (Loader& loader : loaders_) {
        if (loader.reading) givenUp.push_back(std::move(loader.reading->request));
        loader.reading.reset();
    }
    handedOver_.clear();
    nextHandedOver_ = 0;
    finished_.clear();
    virtuallyFinished_.clear();
    virtualReadings_.clear();
    taken_.clear();
    nowS_ = 0;
    prefetching_ = 0;
    nextPrefetchS_ = 0;
    startedAt_ = Clock::now();
    letThrough_ = 0;
    ++epoch_;
    return givenUp;
}

PagingTime Pager::time() const {
    const std::lock_guard lock(mutex_);
    return time_;
}

void Pager::startVirtualReads() {
    if (time_ != PagingTime::Simulated) return;
    while (virtualReadings_.size() < loadersWanted_ && mayTake()) {
        PagingRequest request = takeNext();
        const DiskFault fault = nextFault(request);
        virtualReadings_.push_back({std::move(request), nowS_, nowS_ + fault.waitS, failureOf(fault)});
    }
}

// Returns the read that ends first; among equals, the one taken first. There must be one.
std::size_t Pager::nextVirtualEnd() const {
    const auto next =
        std::min_element(virtualReadings_.begin(), virtualReadings_.end(),
                         [](const VirtualReading& a, const VirtualReading& b) { return a.endS < b.endS; });
    return static_cast<std::size_t>(next - virtualReadings_.begin());
}

void Pager::endVirtualRead(std::size_t index) {
    const auto at = virtualReadings_.begin() + static_cast<std::ptrdiff_t>(index);
    at->endS = nowS_;
    endPrefetch(at->request, at->sinceS);
    virtuallyFinished_.push_back(std::move(*at));
    virtualReadings_.erase(at);
}

void Pager::advance(double seconds) {
    assert(seconds >= 0);
    const std::lock_guard lock(mutex_);
    assert(time_ != PagingTime::Clock);
    const double untilS = nowS_ + seconds;
    while (time_ == PagingTime::Simulated) {
        // A prefetch that waits for its share begins between the ends of reads.
        constexpr double never = std::numeric_limits<double>::infinity();
        const bool hasLoader = virtualReadings_.size() < loadersWanted_;
        const double prefetchS = hasLoader ? nextPrefetchAtS().value_or(never) : never;
        const double endS = virtualReadings_.empty() ? never : virtualReadings_[nextVirtualEnd()].endS;
        if (std::min(prefetchS, endS) > untilS) break;
        if (prefetchS < endS) {
            nowS_ = prefetchS;
        } else {
            nowS_ = std::max(nowS_, endS);
            endVirtualRead(nextVirtualEnd());
        }
        startVirtualReads();
    }
    nowS_ = untilS;
}

std::optional<double> Pager::untilNextEnd() const {
    const std::lock_guard lock(mutex_);
    if (time_ != PagingTime::Simulated || virtualReadings_.empty()) return std::nullopt;
    return std::max(virtualReadings_[nextVirtualEnd()].endS - nowS_, 0.0);
}

bool Pager::take(const BlockId& block) {
    const std::lock_guard lock(mutex_);
    assert(time_ == PagingTime::Recorded);
    const PagingRequest* queued = queue_.find(block);
    if (!queued || queued->type != PagingType::PageIn) return false;
    virtualReadings_.push_back({*queue_.pop(block), nowS_, nowS_});
    prefetching_ += virtualReadings_.back().request.isPrefetch();
    taken_.push_back(block);
    return true;
}

bool Pager::finish(const BlockId& block, std::optional<ErrorKind> failure, bool last) {
    const std::lock_guard lock(mutex_);
    assert(time_ == PagingTime::Recorded);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < virtualReadings_.size() && (last || !found); ++i) {
        if (virtualReadings_[i].request.block() == block) found = i;
    }
    if (!found) return false;
    virtualReadings_[*found].failure = failure;
    endVirtualRead(*found);
    return true;
}

std::vector<BlockId> Pager::takeTaken(const PagingQueue& lockedQueue) {
    assert(&lockedQueue == &queue_);
    static_cast<void>(lockedQueue);
    return std::exchange(taken_, {});
}

// Reads the block of the first virtual read that has ended.
std::optional<FinishedLoad> Pager::readFinished(Lock& lock) {
    if (virtuallyFinished_.empty()) return std::nullopt;
    VirtualReading reading = std::move(virtuallyFinished_.front());
    virtuallyFinished_.pop_front();
    const std::uint32_t seed = badDisk_.seed;
    lock.unlock();
    FinishedLoad load;
    load.block = reading.failure ? failedOnPurpose(reading.request.block(), seed, *reading.failure)
                                 : loadSafely(load_, reading.request);
    load.seconds = reading.endS - reading.sinceS;
    load.bytes = reading.failure ? 0 : reading.request.location.size;
    load.request = std::move(reading.request);
    return load;
}

std::optional<FinishedLoad> Pager::takeFinished() {
    if (nextHandedOver_ == handedOver_.size()) {
        Lock lock(mutex_);
        if (time_ != PagingTime::Clock) return readFinished(lock);
        handedOver_.clear();
        nextHandedOver_ = 0;
        handedOver_.swap(finished_);
    }
    if (handedOver_.empty()) return std::nullopt;
    return std::move(handedOver_[nextHandedOver_++]);
}

std::size_t Pager::ownedLoads() const {
    return handedOver_.size() - nextHandedOver_;
}

bool Pager::waitForFinished(Clock::time_point until, std::size_t count) {
    assert(count >= 1);
    Lock lock(mutex_);
    awaited_ = count;
    ownedInWait_ = ownedLoads();
    loadFinished_.wait_until(lock, until, [this] { return hasEnoughFinished(); });
    return !finished_.empty() || ownedLoads() > 0;
}

bool Pager::hasEnoughFinished() const {
    const std::size_t finished = ownedInWait_ + finished_.size();
    if (finished >= awaited_) return true;
    if (mayTake()) return false;
    const PagerStatus status = statusLocked();
    return status.atRest() || (finished > 0 && status.loading == 0);
}

PagerStatus Pager::status() const {
    const std::lock_guard lock(mutex_);
    PagerStatus status = statusLocked();
    status.finished += static_cast<std::uint32_t>(ownedLoads());
    return status;
}

PagerStatus Pager::statusLocked() const {
    const auto loading = std::count_if(loaders_.begin(), loaders_.end(),
                                       [](const Loader& loader) { return loader.reading.has_value(); });
    return {static_cast<std::uint32_t>(queue_.count(PagingType::PageIn)),
            static_cast<std::uint32_t>(static_cast<std::size_t>(loading) + virtualReadings_.size()),
            static_cast<std::uint32_t>(finished_.size() + virtuallyFinished_.size()),
            paused_ && letThrough_ == 0};
}

std::vector<LoadInProgress> Pager::loadingNow() const {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    std::vector<LoadInProgress> all;
    for (const Loader& loader : loaders_) {
        if (!loader.reading) continue;
        const std::chrono::duration<double> taken = now - loader.reading->since;
        const PagingRequest& request = loader.reading->request;
        all.push_back({request.parent, request.kind, request.isPrefetch(), request.priority,
                       request.location.size, taken.count()});
    }
    for (const VirtualReading& reading : virtualReadings_) {
        const PagingRequest& request = reading.request;
        all.push_back({request.parent, request.kind, request.isPrefetch(), request.priority,
                       request.location.size, nowS_ - reading.sinceS});
    }
    std::sort(all.begin(), all.end(), [](const LoadInProgress& a, const LoadInProgress& b) {
        return a.seconds != b.seconds ? a.seconds > b.seconds : a.parent < b.parent;
    });
    return all;
}

}  // namespace planet
