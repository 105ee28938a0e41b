// Work shared among oneTBB's threads. Internal to the library.
#pragma once

#include <tbb/parallel_for.h>

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

// Calls body(index) for each index below count, several at once, and returns when all are done.
template <class Body>
void forEachInParallel(std::size_t count, const Body& body) {
    Handover handover;
    handover.give();
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t index) {
        handover.take();
        body(index);
        handover.give();
    });
    handover.take();
}

}  // namespace planet
