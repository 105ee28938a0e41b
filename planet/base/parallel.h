// Runs work on oneTBB's threads. Internal to the library.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace planet {

// After take(), a thread sees everything that another thread did before give(). oneTBB already orders its
// tasks, but in its own binary, where the thread sanitizer cannot see it.
class Handover {
public:
    void give() { turn_.fetch_add(1, std::memory_order_release); }
    void take() const { static_cast<void>(turn_.load(std::memory_order_acquire)); }

private:
    std::atomic<unsigned> turn_ = 0;
};

// Runs work as a stage of a pipeline, between take() and give(). The thread sanitizer cannot see that oneTBB
// reuses the memory of a stage, so it must not check the reads of the stage; it checks the work.
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

// One value for each thread that asks for it. oneTBB's own allocator would reuse memory where the thread sanitizer cannot
// see it.
template <class T>
using PerThread = tbb::enumerable_thread_specific<T, std::allocator<T>>;

// Calls body(index) for each index below count, in parallel, and returns when all calls are done. A call
// should take longer than 1 µs. This is a pipeline because tbb::parallel_for is compiled into its caller,
// where the thread sanitizer sees the accesses but not their order.
template <class Body>
void parallelFor(std::size_t count, const Body& body) {
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

// Does the same on at most `threads` threads, including the caller's.
template <class Body>
void parallelFor(int threads, std::size_t count, const Body& body) {
    tbb::task_arena(threads).execute([&] { parallelFor(count, body); });
}

// Runs a pipeline on at most `threads` threads, including the caller's. `places` pieces of work are under way at most, each in
// a place of its own, [0, places). begin(place) prepares one there, and returns false at the end; work(place) does it; end(place)
// takes it over. begin and end are called in order, one at a time; work in parallel.
template <class Begin, class Work, class End>
void parallelInOrder(int threads, std::size_t places, const Begin& begin, const Work& work, const End& end) {
    std::size_t begun = 0;
    const auto beginNext = [&](tbb::flow_control& control) {
        const std::size_t place = begun % places;
        if (begin(place))
            ++begun;
        else
            control.stop();
        return place;
    };
    const auto workOn = [&](std::size_t place) {
        work(place);
        return place;
    };
    using tbb::filter_mode;
    Handover handover;
    handover.give();
    tbb::task_arena(threads).execute([&] {
        tbb::parallel_pipeline(
            places,
            tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, Stage(handover, beginNext)) &
                tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, Stage(handover, workOn)) &
                tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, Stage(handover, end)));
    });
    handover.take();
}

}  // namespace planet
