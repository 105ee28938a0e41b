// Work shared among oneTBB's threads. Internal to the library.
#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <utility>

namespace planet {

// What one thread did before give() is seen by another after take(). oneTBB orders its tasks so already, but
// by means inside its binary that the thread sanitizer does not see; so it is said once more where it does.
class Handover {
public:
    void give() { turn_.fetch_add(1, std::memory_order_release); }
    void take() const { static_cast<void>(turn_.load(std::memory_order_acquire)); }

private:
    std::atomic<unsigned> turn_ = 0;
};

// Work as a stage of a pipeline: after take(), and give() follows it. oneTBB keeps a stage in memory that it
// uses anew unseen by the thread sanitizer; so reading the stage is not looked at, what it calls is.
template <class Work>
class Stage {
public:
    Stage(Handover& handover, const Work& work) : handover_(&handover), work_(&work) {}

    template <class Input>
    __attribute__((no_sanitize("thread"))) auto operator()(Input&& input) const {
        return call(*handover_, *work_, std::forward<Input>(input));
    }

private:
    struct Turn {
        explicit Turn(Handover& handover) : handover_(handover) { handover_.take(); }
        ~Turn() { handover_.give(); }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        Handover& handover_;
    };

    template <class Input>
    static auto call(Handover& handover, const Work& work, Input&& input) {
        const Turn turn(handover);
        return work(std::forward<Input>(input));
    }

    Handover* handover_;
    const Work* work_;
};

// Calls body(index) for each index below count, several at once, and returns when all are done. Each is to
// take longer than a microsecond. A pipeline, since tbb::parallel_for is compiled into its caller, where the
// thread sanitizer sees what it does and not how it is ordered.
template <class Body>
void forEachInParallel(std::size_t count, const Body& body) {
    std::size_t next = 0;
    const auto nextIndex = [&](tbb::flow_control& control) {
        const std::size_t index = next;
        if (next == count)
            control.stop();
        else
            ++next;
        return index;
    };
    Handover handover;
    handover.give();
    const auto underWay = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) * 2;
    tbb::parallel_pipeline(
        underWay,
        tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, Stage(handover, nextIndex)) &
            tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, Stage(handover, body)));
    handover.take();
}

}  // namespace planet
