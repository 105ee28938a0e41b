#include "planet/gl/device/gl_worker.h"

#include <utility>

namespace planet::gl {

GlWorker::GlWorker(SharedContext context) : thread_([this, context = std::move(context)] { run(context); }) {}

GlWorker::~GlWorker() {
    {
        const std::scoped_lock lock(mutex_);
        ending_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void GlWorker::add(std::function<void()> job, Urgency urgency) {
    {
        const std::scoped_lock lock(mutex_);
        (urgency == Urgency::Now ? now_ : later_).push_back(std::move(job));
    }
    changed_.notify_one();
}

void GlWorker::run(const SharedContext& context) {
    works_ = context.makeCurrent();
    if (!works_) return;
    while (true) {
        std::function<void()> job;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ending_ || !now_.empty() || !later_.empty(); });
            if (ending_) break;
            std::deque<std::function<void()>>& jobs = now_.empty() ? later_ : now_;
            job = std::move(jobs.front());
            jobs.pop_front();
        }
        job();
    }
    context.release();
}

}  // namespace planet::gl
