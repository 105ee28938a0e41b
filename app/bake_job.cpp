#include "app/bake_job.h"

#include <utility>

#include "planet/height_source.h"

namespace worldy {

BakeJob::BakeJob(std::filesystem::path source, planet::BakeSettings settings, std::filesystem::path output)
    : thread_([this, source = std::move(source), settings = std::move(settings), output = std::move(output)] {
          run(source, settings, output);
      }) {}

BakeJob::~BakeJob() {
    cancel();
    thread_.join();
}

void BakeJob::run(const std::filesystem::path& source, const planet::BakeSettings& settings,
                  const std::filesystem::path& output) {
    const auto onProgress = [this](const planet::BakeProgress& progress) {
        const std::lock_guard lock(mutex_);
        progress_ = progress;
        return !cancelled_.load();
    };
    planet::Result<planet::BakeReport> result =
        planet::openHeightSource(source, {}).and_then([&](const planet::HeightSource& heights) {
            return planet::bake(heights, settings, output, onProgress);
        });
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
}

planet::BakeProgress BakeJob::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

void BakeJob::cancel() {
    cancelled_ = true;
}

bool BakeJob::cancelling() const {
    return cancelled_;
}

std::optional<planet::Result<planet::BakeReport>> BakeJob::takeResult() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

}  // namespace worldy
