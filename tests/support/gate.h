// Holds threads up until it is opened, so that a test decides what is still on its way.
#pragma once

#include <condition_variable>
#include <mutex>

namespace planet {

class Gate {
public:
    // Waits while the gate is shut.
    void pass() {
        std::unique_lock lock(mutex_);
        ++arrivals_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return open_; });
    }
    void open() { set(true); }
    void shut() { set(false); }
    // Waits until so many have come to the gate since it was made, whether or not they got through.
    void waitForArrivals(int count) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return arrivals_ >= count; });
    }

private:
    void set(bool open) {
        {
            const std::lock_guard lock(mutex_);
            open_ = open;
        }
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = false;
    int arrivals_ = 0;
};

}  // namespace planet
