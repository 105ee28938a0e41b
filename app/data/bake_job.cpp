#include "app/data/bake_job.h"

#include <functional>
#include <mutex>
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

// Returns the source with a sampling function that keeps the source's first Error, to tell it from the bake's
// other Errors.
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
    : job_([this, source = std::move(source), sourceSettings = std::move(sourceSettings),
            settings = std::move(settings), output = std::move(output),
            colour = std::move(colour)](const std::stop_token& stop) {
          return run(stop, source, sourceSettings, settings, output, colour);
      }) {}

Result<planet::BakeReport> BakeJob::run(const std::stop_token& stop, const std::filesystem::path& source,
                                        const planet::HeightSourceSettings& sourceSettings,
                                        const planet::BakeSettings& settings,
                                        const std::filesystem::path& output, const JobColour& colour) {
    const auto onProgress = [&](const planet::BakeProgress& progress) {
        const std::lock_guard lock(mutex_);
        progress_ = progress;
        return !stop.stop_requested();
    };
    std::string colourProblem;
    CommandFiles files;
    addSource(files, source);
    addSource(files, colour.image);
    files.outputs = {{output, OutputKind::ChunkFile}};
    Result<planet::BakeReport> result =
        checkNotInputs(files)
            .and_then([&] { return planet::openHeightSource(source, sourceSettings); })
            .and_then([&](const planet::HeightSource& heights) {
                {
                    const std::lock_guard lock(mutex_);
                    layers_ = heights.layers;
                }
                return bakeWithColour(heights, settings, output, onProgress, colour, colourProblem);
            });
    const std::lock_guard lock(mutex_);
    colourProblem_ = std::move(colourProblem);
    return result;
}

std::string BakeJob::colourProblem() const {
    const std::lock_guard lock(mutex_);
    return colourProblem_;
}

SharedLayers BakeJob::layers() const {
    const std::lock_guard lock(mutex_);
    return layers_;
}

planet::BakeProgress BakeJob::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

EstimateJob::EstimateJob(std::filesystem::path source, planet::HeightSourceSettings sourceSettings,
                         planet::BakeSettings settings, std::filesystem::path colour)
    : Job([source = std::move(source), sourceSettings = std::move(sourceSettings),
           settings = std::move(settings), colour = std::move(colour)](const std::stop_token& stop) {
          return estimate(source, sourceSettings, settings, colour, [&] { return !stop.stop_requested(); });
      }) {}

}  // namespace worldy
