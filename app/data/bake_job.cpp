#include "app/data/bake_job.h"

#include <functional>
#include <span>
#include <utility>

#include "app/data/write_check.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"

namespace worldy {

namespace {

using planet::Result;

Result<planet::BakeEstimate> estimate(const std::filesystem::path& source,
                                      const planet::HeightSourceSettings& sourceSettings,
                                      const planet::BakeSettings& settings,
                                      const std::filesystem::path& colour,
                                      const std::function<bool()>& goOn) {
    const Result<planet::HeightSource> heights = planet::openHeightSource(source, sourceSettings);
    if (!heights) return tl::unexpected(heights.error());
    if (colour.empty()) return planet::estimateBake(*heights, settings, goOn);
    const Result<planet::ColourSource> colours = planet::openColourSource(colour);
    if (!colours) return tl::unexpected(colours.error());
    return planet::estimateBake(*heights, settings, goOn, &*colours);
}

// The same source, that keeps the first Error of its own: a bake's may be about anything.
planet::ColourSource watched(const planet::ColourSource& source, std::mutex& mutex, std::string& problem) {
    planet::ColourSource same = source;
    same.sample = [&source, &mutex, &problem](const planet::SampleTile& tile, std::span<glm::vec3> out) {
        Result<void> sampled = source.sample(tile, out);
        if (sampled) return sampled;
        const std::lock_guard lock(mutex);
        if (problem.empty()) problem = sampled.error().message;
        return sampled;
    };
    return same;
}

}  // namespace

Result<planet::BakeReport> bakeWithColour(const planet::HeightSource& heights,
                                          const planet::BakeSettings& settings,
                                          const std::filesystem::path& output,
                                          const planet::BakeProgressCallback& goOn, const JobColour& colour,
                                          std::string& colourProblem) {
    if (colour.image.empty()) return planet::bake(heights, settings, output, goOn);
    const Result<planet::ColourSource> opened = planet::openColourSource(colour.image);
    std::string problem = opened ? std::string() : opened.error().message;
    if (opened) {
        std::mutex mutex;
        const planet::ColourSource source = watched(*opened, mutex, problem);
        Result<planet::BakeReport> report = planet::bake(heights, settings, output, goOn, &source);
        if (report || problem.empty() || !colour.mayFail) return report;
    }
    if (!colour.mayFail) return tl::unexpected(opened.error());
    Result<planet::BakeReport> report = planet::bake(heights, settings, output, goOn);
    if (report) colourProblem = problem;
    return report;
}

BakeJob::BakeJob(std::filesystem::path source, planet::HeightSourceSettings sourceSettings,
                 planet::BakeSettings settings, std::filesystem::path output, JobColour colour)
    : thread_([this, source = std::move(source), sourceSettings = std::move(sourceSettings),
               settings = std::move(settings), output = std::move(output),
               colour = std::move(colour)] { run(source, sourceSettings, settings, output, colour); }) {}

BakeJob::~BakeJob() {
    cancel();
    thread_.join();
}

void BakeJob::run(const std::filesystem::path& source, const planet::HeightSourceSettings& sourceSettings,
                  const planet::BakeSettings& settings, const std::filesystem::path& output,
                  const JobColour& colour) {
    const auto onProgress = [this](const planet::BakeProgress& progress) {
        const std::lock_guard lock(mutex_);
        progress_ = progress;
        return !cancelled_.load();
    };
    std::string colourProblem;
    CommandFiles files;
    addSource(files, source);
    addSource(files, colour.image);
    files.outputs = {{output, OutputKind::ChunkFile}};
    planet::Result<planet::BakeReport> result =
        checkNotInputs(files)
            .and_then([&] { return planet::openHeightSource(source, sourceSettings); })
            .and_then([&](const planet::HeightSource& heights) {
                return bakeWithColour(heights, settings, output, onProgress, colour, colourProblem);
            });
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
    colourProblem_ = std::move(colourProblem);
}

std::string BakeJob::colourProblem() const {
    const std::lock_guard lock(mutex_);
    return colourProblem_;
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
                         planet::BakeSettings settings, std::filesystem::path colour)
    : thread_([this, source = std::move(source), sourceSettings = std::move(sourceSettings),
               settings = std::move(settings), colour = std::move(colour)] {
          const auto goOn = [this] { return !cancelled_.load(); };
          planet::Result<planet::BakeEstimate> result =
              estimate(source, sourceSettings, settings, colour, goOn);
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
