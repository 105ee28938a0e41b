// A thread with its own OpenGL context, for work that would delay a frame. Programs, textures and buffers are
// shared between both contexts; vertex arrays, framebuffers and all state are not.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace planet::gl {

// A context that shares its objects with the drawing context. The worker calls both functions on its own
// thread; the context must not be current on another one, and must outlive the worker.
struct SharedContext {
    std::function<bool()> makeCurrent;  // false: the driver allows no second context
    std::function<void()> release;
};

enum class Urgency { Now, Later };

// Thread-safe.
class GlWorker {
public:
    explicit GlWorker(SharedContext context);
    GlWorker(const GlWorker&) = delete;
    GlWorker& operator=(const GlWorker&) = delete;
    // Waits for the running job. Jobs that have not begun are dropped.
    ~GlWorker();

    // Queues a job. Urgent jobs run before the others; jobs of equal urgency run in order of arrival. A job
    // calls glFinish to make its results visible to other contexts.
    void add(std::function<void()> job, Urgency urgency);

    // Returns false once the context could not be made current; no job runs after that.
    bool works() const { return works_; }

private:
    void run(const SharedContext& context);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> now_, later_;
    bool ending_ = false;
    std::atomic<bool> works_{true};
    std::thread thread_;  // last, because it uses all other members
};

}  // namespace planet::gl
