#include "app/trace/trace_document.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

namespace worldy {

namespace {

using planet::Result;
using planet::TraceEvent;
using namespace std::chrono_literals;

// Frames that are kept hold at most so many nodes together: some 70 MB.
constexpr std::size_t keptNodes = 200'000;
// A frame that is at most this many frames ahead is reached by decoding on, not by seeking.
constexpr std::uint64_t nearFrames = 300;
constexpr auto liveFramePause = 10ms;
constexpr auto liveHistoryPause = 200ms;
constexpr auto leastPublishPause = 100ms;
// Making a history takes at most this share of the time.
constexpr int publishShare = 10;

std::size_t nodesOf(const TracedFrame& frame) {
    std::size_t nodes = 1;
    for (const TracedView& view : frame.views) nodes += view.nodes.size();
    return nodes;
}

// Reads frames in any order, and keeps those that it decoded on the way.
class FrameReader {
public:
    explicit FrameReader(planet::TraceFile file) : file_(std::move(file)) {}

    // Lists new blocks. Returns the number of the last frame; 0: there is none.
    Result<std::uint64_t> refresh() {
        if (const auto blocks = file_.refresh(); !blocks) return tl::unexpected(blocks.error());
        return file_.frames().value_or(planet::TraceFrameRange{}).last;
    }

    // Returns the first frame at or after one, or the last one; null if the file has none. grows: whether a block that is not
    // whole may still be.
    Result<std::shared_ptr<const TracedFrame>> read(std::uint64_t frame, bool grows) {
        if (const auto kept = frames_.find(frame); kept != frames_.end()) return kept->second;
        frame_ = frame;
        const planet::TraceDecoder::Sink sink = [&](const TraceEvent& event) { take(event); };
        if (std::exchange(seeks_, false) || last_ == 0 || frame <= last_ || frame - last_ > nearFrames) {
            // The frame before tells the switches.
            last_ = 0;
            if (const auto found = file_.seek(frame > 1 ? frame - 1 : frame, sink); !found)
                return tl::unexpected(found.error());
        }
        for (;;) {
            // A kept frame after this one is not the next one until the decoder has passed this one.
            const auto found = frames_.lower_bound(frame);
            if (found != frames_.end() && (found->first == frame || last_ >= frame)) return found->second;
            Result<bool> more = file_.next(sink);
            if (more && !*more && !grows) {
                more = file_.nextCut(sink);
                if (more && *more) seeks_ = true;
            }
            if (!more) {
                last_ = 0;
                return tl::unexpected(more.error());
            }
            if (!*more) break;
        }
        if (!newest_ && last_ != 0 && frames_.empty()) return std::shared_ptr<const TracedFrame>();
        return newest_;
    }

private:
    void take(const TraceEvent& event) {
        if (!state_.add(event)) return;
        builder_.add(state_);
        last_ = state_.frame().number;
        const std::uint64_t lastOfBlocks = file_.frames().value_or(planet::TraceFrameRange{}).last;
        const bool isLastBlock = last_ + framesOfLastBlock() > lastOfBlocks;
        if (last_ < frame_ && !isLastBlock) return;
        newest_ = builder_.build(state_);
        if (last_ >= frame_) keep(newest_);
    }

    std::uint64_t framesOfLastBlock() const {
        const auto& blocks = file_.blocks();
        const auto last = std::find_if(blocks.rbegin(), blocks.rend(), [](const planet::TraceBlock& block) {
            return block.header.frames > 0;
        });
        return last == blocks.rend() ? 0 : last->header.frames + 1;
    }

    // Keeps a frame if there is room beside those that are ahead of the one asked for.
    void keep(const std::shared_ptr<const TracedFrame>& frame) {
        const std::size_t nodes = nodesOf(*frame);
        const auto drop = [&](auto which) {
            nodes_ -= nodesOf(*which->second);
            frames_.erase(which);
        };
        while (!frames_.empty() && nodes_ + nodes > keptNodes && frames_.begin()->first < frame_)
            drop(frames_.begin());
        while (!frames_.empty() && nodes_ + nodes > keptNodes && frames_.rbegin()->first > last_)
            drop(std::prev(frames_.end()));
        if (!frames_.empty() && nodes_ + nodes > keptNodes) return;
        if (frames_.try_emplace(frame->frame.number, frame).second) nodes_ += nodes;
    }

    planet::TraceFile file_;
    planet::TraceState state_;
    TracedFrameBuilder builder_;
    std::uint64_t frame_ = 0;                    // asked for
    std::uint64_t last_ = 0;                     // decoded; 0: none since the last seek
    bool seeks_ = false;                         // before the next frame, because a cut block was decoded
    std::shared_ptr<const TracedFrame> newest_;  // the last frame of the file, if it was decoded
    std::map<std::uint64_t, std::shared_ptr<const TracedFrame>> frames_;
    std::size_t nodes_ = 0;  // of frames_
};

}  // namespace

bool isTraceFile(const std::filesystem::path& file) {
    constexpr std::string_view magic = "LODTRACE";
    std::array<char, magic.size()> begin{};
    std::ifstream stream(file, std::ios::binary);
    return stream.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()) == magic;
}

TraceDocument::TraceDocument(std::filesystem::path file, bool grows)
    : file_(std::move(file)),
      grows_(grows),
      historyThread_([this](const std::stop_token& stop) { readHistory(stop); }),
      frameThread_([this](const std::stop_token& stop) { readFrames(stop); }) {}

void TraceDocument::setGrows(bool grows) {
    const std::lock_guard lock(mutex_);
    grows_ = grows;
    changed_.notify_all();
}

void TraceDocument::show(std::uint64_t frame) {
    const std::lock_guard lock(mutex_);
    if (wanted_.request != 0 && !wanted_.newest && wanted_.frame == frame) return;
    wanted_ = {frame, false, wanted_.request + 1};
    changed_.notify_all();
}

void TraceDocument::showNewest() {
    const std::lock_guard lock(mutex_);
    if (wanted_.newest) return;
    wanted_ = {0, true, wanted_.request + 1};
    changed_.notify_all();
}

std::shared_ptr<const TracedFrame> TraceDocument::frame() const {
    const std::lock_guard lock(mutex_);
    return frame_;
}

std::shared_ptr<const TraceHistory> TraceDocument::history() const {
    const std::lock_guard lock(mutex_);
    return history_;
}

bool TraceDocument::isBusy() const {
    const std::lock_guard lock(mutex_);
    return answered_ != wanted_.request && problem_.empty();
}

std::string TraceDocument::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

bool TraceDocument::grows() const {
    const std::lock_guard lock(mutex_);
    return grows_;
}

TraceDocument::Wanted TraceDocument::wanted() const {
    const std::lock_guard lock(mutex_);
    return wanted_;
}

void TraceDocument::publish(std::shared_ptr<const TracedFrame> frame, std::uint64_t request) {
    const std::lock_guard lock(mutex_);
    if (frame) frame_ = std::move(frame);
    answered_ = request;
}

void TraceDocument::publish(std::shared_ptr<const TraceHistory> history) {
    const std::lock_guard lock(mutex_);
    history_ = std::move(history);
}

void TraceDocument::fail(const std::string& problem) {
    const std::lock_guard lock(mutex_);
    if (problem_.empty()) problem_ = problem;
}

// Waits for a new request, or a little for a growing file.
bool TraceDocument::pause(const std::stop_token& stop, std::uint64_t request) {
    std::unique_lock lock(mutex_);
    const auto isNew = [&] { return wanted_.request != request; };
    if (wanted_.newest && grows_)
        changed_.wait_for(lock, stop, liveFramePause, isNew);
    else
        changed_.wait(lock, stop, isNew);
    return !stop.stop_requested();
}

void TraceDocument::readFrames(const std::stop_token& stop) {
    Result<planet::TraceFile> file = planet::TraceFile::open(file_);
    if (!file) return fail(file.error().message);
    FrameReader reader(std::move(*file));
    Wanted asked = wanted();
    std::uint64_t shown = 0;
    do {
        asked = wanted();
        if (asked.request == 0) continue;
        const Result<std::uint64_t> last = reader.refresh();
        if (!last) return fail(last.error().message);
        const std::uint64_t frame = asked.newest ? *last : asked.frame;
        if (asked.newest && frame == shown) {
            publish(std::shared_ptr<const TracedFrame>(), asked.request);
            continue;
        }
        Result<std::shared_ptr<const TracedFrame>> read = reader.read(frame, grows());
        if (!read) {
            fail(read.error().message);
            publish(std::shared_ptr<const TracedFrame>(), asked.request);
            continue;
        }
        shown = asked.newest ? frame : 0;
        publish(std::move(*read), asked.request);
    } while (pause(stop, asked.request));
}

void TraceDocument::readHistory(const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    Result<planet::TraceFile> file = planet::TraceFile::open(file_);
    if (!file) return fail(file.error().message);
    planet::TraceState state;
    TraceHistorian historian;
    bool isNew = false;
    const planet::TraceDecoder::Sink sink = [&](const TraceEvent& event) {
        if (!state.add(event)) return;
        historian.add(state);
        isNew = true;
    };
    if (const auto begun = file->seek(0, sink); !begun) return fail(begun.error().message);
    Clock::time_point next = Clock::now() + leastPublishPause;
    while (!stop.stop_requested()) {
        const bool grows = this->grows();
        if (grows) {
            if (const auto blocks = file->refresh(); !blocks) return fail(blocks.error().message);
        }
        Result<bool> more = file->next(sink);
        if (more && !*more && !grows) {
            // Refreshed after grows was read: what the engine wrote before it ended is read, too.
            if (const auto blocks = file->refresh(); !blocks) return fail(blocks.error().message);
            if (file->problem()) fail(*file->problem());
            more = file->next(sink);
            if (more && !*more) more = file->nextCut(sink);
        }
        if (!more) fail(more.error().message);
        const bool isAtEnd = !more || !*more;
        const bool isOver = isAtEnd && (!grows || !more);
        if (isOver || (isNew && Clock::now() >= next)) {
            const Clock::time_point begin = Clock::now();
            publish(historian.history(state, isOver));
            next = Clock::now() +
                   std::max<Clock::duration>(publishShare * (Clock::now() - begin), leastPublishPause);
            isNew = false;
        }
        if (isOver) return;
        if (!isAtEnd) continue;
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, stop, liveHistoryPause, [&] { return !grows_; });
    }
}

}  // namespace worldy
