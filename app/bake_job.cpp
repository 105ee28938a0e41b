#include "app/bake_job.h"

#include <utility>

#include "planet/height_source.h"

namespace worldy {

BakeJob::BakeJob(std::filesystem::path source, planet::HeightSourceSettings sourceSettings,
                 planet::BakeSettings settings, std::filesystem::path output)
    : thread_([this, source = std::move(source), sourceSettings = std::move(sourceSettings),
               settings = std::move(settings),
               output = std::move(output)] { run(source, sourceSettings, settings, output); }) {}

BakeJob::~BakeJob() {
    cancel();
    thread_.join();
}

void BakeJob::run(const std::filesystem::path& source, const planet::HeightSourceSettings& sourceSettings,
                  const planet::BakeSettings& settings, const std::filesystem::path& output) {
    const auto onProgress = [this](const planet::BakeProgress& progress) {
        const std::lock_guard lock(mutex_);
        progress_ = progress;
        return !cancelled_.load();
    };
    planet::Result<planet::BakeReport> result =
        planet::openHeightSource(source, sourceSettings).and_then([&](const planet::HeightSource& heights) {
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

EstimateJob::EstimateJob(std::filesystem::path source, planet::HeightSourceSettings sourceSettings,
                         planet::BakeSettings settings)
    : thread_([this, source = std::move(source), sourceSettings = std::move(sourceSettings),
               settings = std::move(settings)] {
          const auto goOn = [this] { return !cancelled_.load(); };
          planet::Result<planet::BakeEstimate> result =
              planet::openHeightSource(source, sourceSettings)
                  .and_then([&](const planet::HeightSource& heights) {
                      return planet::estimateBake(heights, settings, goOn);
                  });
          const std::lock_guard lock(mutex_);
          result_ = std::move(result);
      }) {}

EstimateJob::~EstimateJob() {
    cancel();
    thread_.join();
}

std::optional<planet::Result<planet::BakeEstimate>> EstimateJob::takeResult() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

}  // namespace worldy
