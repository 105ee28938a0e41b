#include "planet/bake/job/unit_feed.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "planet/base/little_endian.h"
#include "planet/base/stopwatch.h"

namespace planet {

namespace {

enum class Note : std::uint8_t {
    // To the leader.
    Ask,      // more units are wanted
    Counts,   // u64 units, u64 samples
    Stopped,  // the rank has failed, or is cancelled
    Ended,    // the rank has nothing more to do, and sends nothing more
    // From the leader.
    Share,  // u64 first, u64 count
    Stop    // the job has failed, or is cancelled
};

void sendNote(Ranks& ranks, int to, Note note, std::uint64_t first = 0, std::uint64_t second = 0) {
    std::vector<std::byte> bytes;
    ByteWriter out(bytes);
    out.put(static_cast<std::uint8_t>(note));
    out.put(first);
    out.put(second);
    ranks.send(to, bytes);
}

constexpr int leaderRank = 0;
// A network's latency is below it, and 1000 wakes a second take about a hundredth of a core.
constexpr std::chrono::milliseconds pollInterval{1};
constexpr double reportIntervalS = 0.2;

// The leader's side. Only rank 0 uses it.
class Leader {
public:
    Leader(Team& team, const UnitWork& work)
        : ranks_(team.ranks()),
          work_(work),
          shares_(work.left, team.count()),
          samples_(static_cast<std::size_t>(team.count())),
          units_(samples_.size()) {}

    void take(int from, Note note, std::uint64_t first, std::uint64_t second) {
        const auto rank = static_cast<std::size_t>(from);
        if (note == Note::Ask) {
            const UnitRange share = stopped_ ? UnitRange{} : shares_.next();
            sendNote(ranks_, from, Note::Share, share.first, share.count);
        } else if (note == Note::Counts) {
            units_[rank] = first;
            samples_[rank] = second;
        } else if (note == Note::Stopped) {
            stop();
        } else if (note == Note::Ended) {
            ++ended_;
        }
    }

    void stop() {
        if (std::exchange(stopped_, true)) return;
        for (int rank = 0; rank < ranks_.count(); ++rank) sendNote(ranks_, rank, Note::Stop);
    }

    bool allHaveEnded() const { return ended_ == ranks_.count(); }

    JobProgress progress() const {
        JobProgress progress;
        std::uint64_t done = 0;
        std::uint64_t units = 0;
        for (std::size_t rank = 0; rank < samples_.size(); ++rank) {
            done += samples_[rank];
            units += units_[rank];
        }
        std::uint64_t unitsLeft = 0;
        for (const UnitRange& range : work_.left) unitsLeft += range.count;
        const auto slowest = std::ranges::min_element(samples_);
        const double elapsedS = stopwatch_.elapsedS();
        const double rate = elapsedS > 0 ? static_cast<double>(done) / elapsedS : 0;
        const std::uint64_t left = work_.samplesLeft - std::min(done, work_.samplesLeft);
        progress.bake = {work_.samplesTotal - left, work_.samplesTotal, elapsedS, rate,
                         rate > 0 ? static_cast<double>(left) / rate : 0};
        progress.unitsDone = work_.unitsTotal - unitsLeft + units;
        progress.unitsTotal = work_.unitsTotal;
        progress.ranks = ranks_.count();
        progress.slowestRank = static_cast<int>(slowest - samples_.begin());
        progress.slowestSamplesPerS = elapsedS > 0 ? static_cast<double>(*slowest) / elapsedS : 0;
        return progress;
    }

private:
    Ranks& ranks_;
    const UnitWork& work_;
    UnitShares shares_;
    std::vector<std::uint64_t> samples_;  // by rank
    std::vector<std::uint64_t> units_;
    int ended_ = 0;
    bool stopped_ = false;
    Stopwatch stopwatch_;
};

}  // namespace

UnitShares::UnitShares(std::vector<UnitRange> left, int ranks)
    : left_(std::move(left)), ranks_(static_cast<std::uint64_t>(ranks)) {
    std::ranges::reverse(left_);
    for (const UnitRange& range : left_) count_ += range.count;
}

UnitRange UnitShares::next() {
    if (left_.empty()) return {};
    // A quarter of what would be a fair share of the rest (guided self-scheduling: Polychronopoulos and Kuck 1987).
    const std::uint64_t wanted = std::max<std::uint64_t>(1, count_ / (4 * ranks_));
    UnitRange& range = left_.back();
    const UnitRange share{range.first, std::min(wanted, range.count)};
    range = {range.first + share.count, range.count - share.count};
    count_ -= share.count;
    if (range.count == 0) left_.pop_back();
    return share;
}

std::optional<std::uint64_t> UnitFeed::next() {
    std::unique_lock lock(mutex_);
    if (now_.count == 0) now_ = std::exchange(then_, {});
    if (now_.count == 0 && !ended_ && !stopped_) {
        const Stopwatch stopwatch;
        changed_.wait(lock, [&] { return then_.count > 0 || ended_ || stopped_; });
        waitedS_ += stopwatch.elapsedS();
        now_ = std::exchange(then_, {});
    }
    if (stopped_ || now_.count == 0) return std::nullopt;
    --now_.count;
    return now_.first++;
}

double UnitFeed::waitedS() const {
    const std::lock_guard lock(mutex_);
    return waitedS_;
}

bool UnitFeed::wantsMore() const {
    const std::lock_guard lock(mutex_);
    return then_.count == 0 && !ended_ && !stopped_;
}

void UnitFeed::give(const UnitRange& units) {
    const std::lock_guard lock(mutex_);
    then_ = units;
    if (units.count == 0) ended_ = true;
    changed_.notify_all();
}

void UnitFeed::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

bool UnitFeed::hasStopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
}

Result<void> bakeUnits(Team& team, const UnitWork& work, UnitFeed& feed, const UnitCounts& counts,
                       const std::function<Result<void>()>& bake, const JobProgressCallback& progress) {
    Ranks& ranks = team.ranks();
    std::optional<Leader> leader;
    if (team.rank() == leaderRank) leader.emplace(team, work);
    Result<void> outcome;
    std::atomic<bool> hasEnded = false;
    std::thread worker([&] {
        outcome = bake();
        hasEnded.store(true, std::memory_order_release);
    });
    bool isCancelled = false;
    bool asked = false;
    bool saidEnded = false;
    Stopwatch sinceReport;
    const auto tellCounts = [&] {
        sendNote(ranks, leaderRank, Note::Counts, counts.units.load(), counts.samples.load());
    };
    const auto report = [&] {
        if (!saidEnded) tellCounts();
        if (!isCancelled && progress && !progress(leader ? leader->progress() : JobProgress{})) {
            isCancelled = true;
            feed.stop();
            if (!saidEnded) sendNote(ranks, leaderRank, Note::Stopped);
            if (leader) leader->stop();
        }
    };
    while (!saidEnded || (leader && !leader->allHaveEnded())) {
        const std::optional<RankMessage> message = ranks.receive();
        if (message) {
            ByteReader in(message->bytes);
            const auto note = static_cast<Note>(in.get<std::uint8_t>());
            const auto first = in.get<std::uint64_t>();
            const auto second = in.get<std::uint64_t>();
            if (note == Note::Share) {
                asked = false;
                feed.give({first, second});
            } else if (note == Note::Stop) {
                feed.stop();
            } else {
                leader->take(message->from, note, first, second);
            }
            continue;
        }
        if (!saidEnded && !asked && feed.wantsMore()) {
            sendNote(ranks, leaderRank, Note::Ask);
            asked = true;
        }
        // The answer to the last question comes before the end, so that no message is left over.
        if (!saidEnded && !asked && hasEnded.load(std::memory_order_acquire)) {
            if (!outcome) sendNote(ranks, leaderRank, Note::Stopped);
            tellCounts();
            sendNote(ranks, leaderRank, Note::Ended);
            saidEnded = true;
        }
        if (sinceReport.elapsedS() > reportIntervalS) {
            sinceReport = {};
            report();
        }
        std::this_thread::sleep_for(pollInterval);
    }
    worker.join();
    if (leader && outcome && !isCancelled) report();
    if (outcome && isCancelled) return cancelled();
    return outcome;
}

}  // namespace planet
