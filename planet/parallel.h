// Work shared among oneTBB's threads. Internal to the library.
#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>

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

// Calls body(index) for each index below count, several at once, and returns when all are done. Each is to
// take longer than a microsecond. A pipeline, since tbb::parallel_for is compiled into its caller, where the
// thread sanitizer sees what it does and not how it is ordered.
template <class Body>
void forEachInParallel(std::size_t count, const Body& body) {
    std::size_t next = 0;
    Handover handover;
    const auto input = [&](tbb::flow_control& control) {
        handover.take();
        const std::size_t index = next;
        if (next == count)
            control.stop();
        else
            ++next;
        handover.give();
        return index;
    };
    const auto work = [&](std::size_t index) {
        handover.take();
        body(index);
        handover.give();
    };
    handover.give();
    const auto underWay = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) * 2;
    tbb::parallel_pipeline(underWay,
                           tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, input) &
                               tbb::make_filter<std::size_t, void>(tbb::filter_mode::parallel, work));
    handover.take();
}

}  // namespace planet
