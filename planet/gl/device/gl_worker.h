// A thread with an OpenGL context of its own, for work that would hold up a frame. Programs, textures and
// buffers are shared between both contexts; vertex arrays, framebuffers and all state are not.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace planet::gl {

// A context that shares its objects with the one that draws. Both functions are called on the worker's
// thread, and the context must not be current anywhere else. It has to outlive the worker.
struct SharedContext {
    std::function<bool()> makeCurrent;  // false: this driver does not let a second thread have a context
    std::function<void()> release;
};

enum class Urgency { Now, Later };

// Any thread may call it.
class GlWorker {
public:
    explicit GlWorker(SharedContext context);
    GlWorker(const GlWorker&) = delete;
    GlWorker& operator=(const GlWorker&) = delete;
    // Waits for the job that runs. The jobs that have not begun are dropped.
    ~GlWorker();

    // Jobs that are needed now run before the others; otherwise they run in the order in which they came. A
    // job makes what it has drawn visible to other contexts by glFinish.
    void add(std::function<void()> job, Urgency urgency);

    // False once the context could not be made current: jobs are not run then.
    bool works() const { return works_; }

private:
    void run(const SharedContext& context);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> now_, later_;
    bool ending_ = false;
    std::atomic<bool> works_{true};
    std::thread thread_;  // last: it uses all the others
};

}  // namespace planet::gl
